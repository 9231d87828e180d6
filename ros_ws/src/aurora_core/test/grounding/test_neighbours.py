# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs at one height keep apart on their routes, not only where they start."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations, pairwise
from math import inf

import numpy as np
import pytest
import shapely

from aurora_core.grounding.neighbours import Neighbours
from aurora_core.grounding.patterns import begun_at, pattern_points
from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.map_model import MapModel
from aurora_core.mission.plan import MissionPlan
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.quantities.waypoints import pattern_centre
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode, Pattern

Ground = Callable[[str], GroundedScenario]
Way = tuple[tuple[float, float], ...]


@pytest.fixture
def grounded(
    read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> Ground:
    """Ground a prompt on the downtown map."""

    def of(prompt: str) -> GroundedScenario:
        found = ground(read_prompt(prompt, 'downtown'), 'downtown')
        assert isinstance(found, GroundedScenario), found
        return found

    return of


def _route(way: Way, height_m: float = 50.0) -> MissionPlan:
    return MissionPlan(
        id='m',
        mode=MissionMode.NAVIGATE,
        altitude_m=height_m,
        waypoints=tuple((x, y, height_m) for x, y in way),
        speed_mps=8.0,
    )


def _ways(found: GroundedScenario) -> list[np.ndarray]:
    return [np.array(uav.missions[0].waypoints)[:, :2] for uav in found.uavs]


def _gap_m(one: np.ndarray, other: np.ndarray, speed_mps: float = 8.0) -> float:
    """Return how near two get that fly two routes from one moment on."""
    flown = []
    for way in (one, other):
        marks = np.concatenate(
            ([0.0], np.cumsum([np.linalg.norm(b - a) for a, b in pairwise(way)]))
        )
        at = np.arange(0.0, 80.0, 0.1) * speed_mps
        flown.append(np.column_stack([np.interp(at, marks, way[:, k]) for k in (0, 1)]))
    return float(np.linalg.norm(flown[0] - flown[1], axis=1).min())


@pytest.mark.parametrize('where', ['', ' over the streets'])
def test_lines_at_one_height_are_flown_apart(grounded: Ground, where: str) -> None:
    found = grounded(f'Four drones fly a 200 m line{where} at 50 m, at least 15 m apart.')
    ways = _ways(found)
    assert [shapely.LineString(way).length for way in ways] == pytest.approx([200.0] * 4)
    assert min(_gap_m(a, b) for a, b in combinations(ways, 2)) >= 15.0


@pytest.mark.parametrize(
    'route',
    ['orbit the park at 60 m with a radius of 60 m', 'patrol a rectangle around the park at 60 m'],
)
def test_routes_round_one_place_are_flown_one_after_the_other(
    grounded: Ground, route: str
) -> None:
    ways = _ways(grounded(f'Three drones {route}, at least 15 m apart.'))
    assert min(_gap_m(a, b) for a, b in combinations(ways, 2)) >= 15.0
    # All of them stay round the place that is named.
    centres = np.array([pattern_centre(tuple((*p, 60.0) for p in way.tolist())) for way in ways])
    assert np.ptp(centres, axis=0).max() <= 1e-6


def test_who_hovers_over_one_building_keeps_what_is_asked_and_stays_over_it(
    grounded: Ground,
) -> None:
    found = grounded('Three drones hover over City Hall at 60 m, at least 14 m apart.')
    points = np.array([uav.missions[0].hover_point for uav in found.uavs])[:, :2]
    assert min(float(np.linalg.norm(a - b)) for a, b in combinations(points, 2)) >= 14.0
    assert max(np.linalg.norm(points - points.mean(axis=0), axis=1)) <= 10.0


def test_who_hovers_beside_a_route_is_over_its_place_all_the_same(
    grounded: Ground, map_of: Callable[[str], MapModel]
) -> None:
    found = grounded(
        'One drone flies a 150 m line over the main road at 50 m. Another drone hovers over the '
        'intersection at 50 m.'
    )
    route, hover = (uav.missions[0] for uav in found.uavs)
    assert hover.hover_point is not None
    x, y, _ = hover.hover_point
    line = shapely.LineString([point[:2] for point in route.waypoints])
    assert line.distance(shapely.Point(x, y)) >= 9.99
    middle = MapPlaces(map_of('downtown')).point('intersection', (x, y))
    assert np.hypot(x - middle[0], y - middle[1]) <= 10.0


def test_a_single_route_stays_where_it_was(grounded: Ground) -> None:
    alone = _ways(grounded('A drone flies a 200 m line at 50 m.'))[0]
    first = _ways(grounded('Two drones fly a 200 m line at 50 m.'))[0]
    assert alone.tolist() == first.tolist()


def test_how_near_others_get() -> None:
    line = _route(((0.0, 0.0), (100.0, 0.0)))
    beside = _route(((0.0, 12.0), (100.0, 12.0)))
    across = _route(((50.0, -50.0), (50.0, 50.0)))
    above = _route(((0.0, 0.0), (100.0, 0.0)), 61.0)

    def gap_m(*routes: MissionPlan, points: tuple[tuple[float, float, float], ...] = ()) -> float:
        others = Neighbours(points=points, routes=routes, apart_m=10.0, layer_m=10.0)
        return others.gap_m(line)

    assert gap_m() == inf
    assert gap_m(above) == inf
    assert gap_m(beside) == pytest.approx(12.0)
    assert gap_m(across) < 3.0  # both are in the middle at the same time
    assert gap_m(line) == pytest.approx(0.0)
    assert gap_m(points=((50.0, 7.0, 50.0),)) == pytest.approx(7.0)
    assert gap_m(points=((50.0, 7.0, 61.0),)) == inf


@pytest.mark.parametrize('share', [0.0, 0.25, 0.5, 0.9])
@pytest.mark.parametrize('pattern', [Pattern.RECTANGLE, Pattern.ORBIT])
def test_a_closed_pattern_begun_elsewhere_is_the_same_one(pattern: Pattern, share: float) -> None:
    points = pattern_points(pattern, length_m=100.0, width_m=60.0, radius_m=40.0, waypoint_count=4)
    assert points is not None
    turned = begun_at(points, share)
    assert turned[0] == turned[-1]
    assert sorted(turned[:-1]) == sorted(points[:-1])
    legs = {frozenset(leg) for leg in pairwise(points)}
    assert {frozenset(leg) for leg in pairwise(turned)} == legs


def test_an_odd_number_of_waypoints_is_about_its_place(
    grounded: Ground, map_of: Callable[[str], MapModel]
) -> None:
    found = grounded('A drone flies 3 waypoints at 50 m and 8 m/s over Meadow Park.')
    (uav,) = found.uavs
    x, y = pattern_centre(uav.missions[0].waypoints)
    park_x, park_y = MapPlaces(map_of('downtown')).itself('landmark:Meadow Park', (0.0, 0.0))
    assert np.hypot(x - park_x, y - park_y) < 1.0


def test_two_on_one_way_fly_beside_each_other(grounded: Ground) -> None:
    way = 'flies from City Hall to Union Station at 70 m.'
    found = grounded(f'A drone {way} Another drone {way}')
    first, second = _ways(found)
    assert _gap_m(first, second) > 7.5
