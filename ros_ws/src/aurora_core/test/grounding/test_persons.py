# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Persons stand on sidewalks, cross at crosswalks, and go when somebody watches."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import pytest
import shapely

from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario, ReleaseOn
from aurora_core.spec.scenario import ScenarioSpec

Ground = Callable[[str], tuple[GroundedScenario, MapModel]]


@pytest.fixture
def grounded(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_of: Callable[[str], MapModel],
) -> Ground:
    """Ground a prompt on the downtown map."""

    def of(prompt: str) -> tuple[GroundedScenario, MapModel]:
        found = ground(read_prompt(prompt, 'downtown'), 'downtown')
        assert isinstance(found, GroundedScenario), found
        return found, map_of('downtown')

    return of


def _persons(found: GroundedScenario) -> list[GroundedAgent]:
    return [a for a in found.agents if a.is_person]


@pytest.mark.parametrize(
    'prompt',
    [
        'A pedestrian walks on the sidewalk at 1.4 m/s; a drone tracks the pedestrian at 20 m.',
        'Three pedestrians walk on the sidewalk.',
        'A pedestrian waits at the crosswalk while a bus drives.',
        'A drone hovers over the crosswalk at 30 m; a pedestrian crosses at the crosswalk.',
        'A pedestrian stands near City Hall.',
    ],
)
def test_everybody_stands_on_a_sidewalk(grounded: Ground, prompt: str) -> None:
    found, the_map = grounded(prompt)
    persons = _persons(found)
    assert persons
    assert found.unsupported == ()
    for person in persons:
        lane = the_map.network.lane(person.lane_id)
        assert lane.allows == {'pedestrian'}
        assert lane.edge_id == person.edges[0]
        spot = shapely.Point(person.x_m, person.y_m)
        assert the_map.network.sidewalk_area.buffer(0.1).contains(spot)
        assert person.route_xy_m[0] == pytest.approx((person.x_m, person.y_m))
    assert len({(p.x_m, p.y_m) for p in persons}) == len(persons)


def test_who_crosses_goes_from_kerb_to_kerb_ahead_of_the_car(grounded: Ground) -> None:
    found, the_map = grounded('A pedestrian crosses at the crosswalk ahead; the ego car drives.')
    (person,) = _persons(found)
    (ego,) = (a for a in found.agents if not a.is_person)
    way = shapely.LineString(person.route_xy_m)
    assert way.crosses(shapely.LineString(ego.route_xy_m))
    anchor = the_map.network.position_on_lane(found.anchor_lane, found.anchor_position_m)[:2]
    middle = MapPlaces(the_map).point('crosswalk', anchor)
    assert way.distance(shapely.Point(middle)) < 2.0


def test_a_stated_distance_is_kept_along_the_street(grounded: Ground) -> None:
    found, _ = grounded('A pedestrian stands 30 m ahead of the ego car.')
    (person,) = _persons(found)
    (ego,) = (a for a in found.agents if not a.is_person)
    along = (person.x_m - ego.x_m) * ego.heading_x + (person.y_m - ego.y_m) * ego.heading_y
    assert along == pytest.approx(30.0, abs=1.0)
    assert dist((person.x_m, person.y_m), (ego.x_m, ego.y_m)) < 40.0


@pytest.mark.parametrize(
    ('prompt', 'release'),
    [
        ('A drone tracks a pedestrian, who walks on the sidewalk.', ReleaseOn.CAPTURED),
        ('A pedestrian walks on the sidewalk.', ReleaseOn.START),
        ('A pedestrian waits at the crosswalk.', ReleaseOn.NEVER),
        ('A pedestrian waits for 10 s and then crosses.', ReleaseOn.NEVER),
    ],
)
def test_when_a_person_goes(grounded: Ground, prompt: str, release: ReleaseOn) -> None:
    (person,) = _persons(grounded(prompt)[0])
    assert person.release is release


@pytest.mark.parametrize(
    'when', ['after 20 s', 'when the ego car comes within 30 m', 'when the drone alerts the ego']
)
def test_who_crosses_at_some_moment_walks_up_to_the_kerb_first(
    grounded: Ground, when: str
) -> None:
    """From where he stands at the end of the sidewalk it takes 2 s to the carriageway."""
    found, the_map = grounded(f'A pedestrian crosses the road {when}. A drone tracks the ego car.')
    (person,) = _persons(found)
    assert person.release is ReleaseOn.START
    assert person.halt_xy_m is not None
    to_road_m = the_map.network.carriageway.distance(shapely.Point(person.halt_xy_m))
    assert 0.0 < to_road_m < 0.5 < dist((person.x_m, person.y_m), person.halt_xy_m)


@pytest.mark.parametrize(
    ('words', 'place'),
    [
        ('toward the crosswalk at 1 m/s', 'crosswalk'),
        ('to the crosswalk and crosses the road', 'crosswalk'),
        ('to the crosswalk for 30 seconds', 'crosswalk'),
        ('to the intersection', 'intersection'),
        ('to City Hall', 'landmark:City Hall'),
    ],
)
def test_who_walks_to_a_place_comes_from_elsewhere(
    grounded: Ground, tolerances: Tolerances, words: str, place: str
) -> None:
    found, the_map = grounded(f'A pedestrian walks {words}. A drone tracks the pedestrian.')
    (person,) = _persons(found)
    anchor = the_map.network.position_on_lane(found.anchor_lane, found.anchor_position_m)[:2]
    goal = MapPlaces(the_map).point(place, anchor)
    begins_m = dist((person.x_m, person.y_m), goal)
    nearest_m = shapely.LineString(person.route_xy_m).distance(shapely.Point(goal))
    assert nearest_m < tolerances.arrival_m
    assert begins_m > nearest_m + tolerances.approach_m + 1.0


def test_who_walks_beside_a_car_stays_on_one_sidewalk(grounded: Ground) -> None:
    found, the_map = grounded('A pedestrian walks beside the ego car. A drone tracks the car.')
    (person,) = _persons(found)
    (ego,) = (a for a in found.agents if not a.is_person)
    assert len(person.edges) == 1
    assert the_map.network.lane(person.lane_id).arc_length_m - person.lane_position_m > 50.0
    assert dist((person.x_m, person.y_m), (ego.x_m, ego.y_m)) < 8.0


def test_two_who_cross_do_not_touch_round_the_corner(grounded: Ground) -> None:
    first, second = _persons(grounded('Two pedestrians cross the road at the crosswalk.')[0])
    assert dist((first.x_m, first.y_m), (second.x_m, second.y_m)) > 1.5


@pytest.mark.parametrize('of', ['van', 'truck'])
def test_who_steps_out_from_behind_a_parked_vehicle_crosses_right_there(
    grounded: Ground, of: str
) -> None:
    found, the_map = grounded(
        f'The ego car drives at 6 m/s. A {of} is parked at the roadside. A pedestrian stands '
        f'behind the {of}. When the ego comes within 30 m of the pedestrian, the pedestrian '
        'crosses the street. A drone hovers over the ego.'
    )
    parked, person = found.agents[1:]
    way = shapely.LineString(person.way_xy_m)
    assert way.coords[0] == (person.x_m, person.y_m)
    assert person.route_xy_m == person.way_xy_m
    assert person.release is ReleaseOn.EVENT
    # He waits at the kerb, which is left of the middle of the sidewalk.
    to_road_m = the_map.network.carriageway.distance(shapely.Point(person.x_m, person.y_m))
    assert 0.0 < to_road_m < 0.2
    sidewalk = the_map.network.lane(person.lane_id)
    middle = sidewalk.line.at(person.lane_position_m)[:2]
    assert dist(middle, (person.x_m, person.y_m)) == pytest.approx(person.lateral_m, abs=1e-3)
    # Right behind it, and from one sidewalk to the other over the whole carriageway.
    hx, hy = parked.heading_x, parked.heading_y
    behind_m = hx * (parked.x_m - person.x_m) + hy * (parked.y_m - person.y_m)
    assert parked.length_m / 2.0 + 1.0 < behind_m < parked.length_m / 2.0 + 3.0
    box = shapely.LineString(
        [(parked.x_m + k * hx, parked.y_m + k * hy) for k in (-behind_m + 1.0, 0.0)]
    ).buffer(parked.width_m / 2.0, cap_style='flat')
    assert not way.intersects(box)
    road = the_map.network.carriageway
    assert way.intersection(road).length > 6.0
    assert not any(road.contains(shapely.Point(end)) for end in way.coords)


def test_who_crosses_by_a_car_that_drives_takes_the_crosswalk(grounded: Ground) -> None:
    found, _ = grounded(
        'The ego car drives. A pedestrian waits ahead of it and crosses when it comes near.'
    )
    assert all(person.way_xy_m == () and len(person.edges) == 2 for person in _persons(found))


def test_a_distance_to_the_side_of_a_vehicle_is_kept_where_the_sidewalk_allows_it(
    grounded: Ground,
) -> None:
    found, _ = grounded('A pedestrian waits 8 m to the right of a van. The van waits.')
    assert found.unsupported == ()
    (person,) = _persons(found)
    (van,) = (a for a in found.agents if not a.is_person)
    away_m = dist((person.x_m, person.y_m), (van.x_m, van.y_m))
    assert away_m == pytest.approx(8.0, abs=1.5)
    left_m = van.heading_x * (person.y_m - van.y_m) - van.heading_y * (person.x_m - van.x_m)
    assert left_m < -van.width_m / 2.0


def test_who_walks_and_crosses_goes_on_far_enough_to_have_walked(
    grounded: Ground, tolerances: Tolerances
) -> None:
    found, the_map = grounded(
        'A pedestrian walks on the sidewalk and crosses the street after 20 seconds. A drone '
        'tracks the pedestrian at 40 m.'
    )
    (person,) = _persons(found)
    assert person.arrival_position_m is not None
    lanes = [the_map.network.lane(f'{edge}_0').arc_length_m for edge in person.edges]
    before_m = Polyline(person.route_xy_m).length_m - lanes[-1]
    assert before_m + person.arrival_position_m >= tolerances.drive_distance_m + 1.0


@pytest.mark.parametrize('at_s', [12, 25])
def test_who_walks_and_crosses_at_a_stated_time_walks_until_then(
    grounded: Ground, at_s: int
) -> None:
    found, the_map = grounded(
        f'A pedestrian walks on the sidewalk and crosses the street after {at_s} seconds. A drone '
        'tracks the pedestrian at 40 m.'
    )
    (person,) = _persons(found)
    assert person.release is ReleaseOn.START
    assert person.halt_xy_m is not None
    assert person.drive_speed_mps is not None
    way_m = dist((person.x_m, person.y_m), person.halt_xy_m)
    sidewalk_m = the_map.network.lane(person.lane_id).arc_length_m
    # He is there before it is time, but no earlier than the sidewalk lets him.
    assert way_m < person.drive_speed_mps * at_s
    assert way_m > min(0.8 * person.drive_speed_mps * at_s, 0.9 * sidewalk_m)


def test_who_is_at_a_landmark_and_ahead_of_a_vehicle_is_both(grounded: Ground) -> None:
    found, the_map = grounded(
        'A pedestrian waits near City Hall 30 m ahead of the ego car. The ego car drives.'
    )
    (person,) = _persons(found)
    ego = next(a for a in found.agents if a.id == 'ego')
    hall = MapPlaces(the_map).point('landmark:City Hall', (0.0, 0.0))
    assert dist((person.x_m, person.y_m), hall) <= 50.0
    assert (person.x_m - ego.x_m) * ego.heading_x + (
        person.y_m - ego.y_m
    ) * ego.heading_y == pytest.approx(30.0, abs=1.0)


@pytest.mark.parametrize(
    ('rests', 'place', 'stands_s'),
    [
        ('walks to the crosswalk and waits there', 'crosswalk', None),
        ('walks to the crosswalk and waits there for 10 s', 'crosswalk', 10.0),
        ('walks along the sidewalk and stops at the crosswalk', 'crosswalk', None),
        ('walks to City Hall and stops there', 'landmark:City Hall', None),
        ('walks to City Hall, waits there for 8 s and then walks on', 'landmark:City Hall', 8.0),
    ],
)
def test_who_walks_to_a_place_and_rests_there_comes_from_where_that_shows(
    grounded: Ground, tolerances: Tolerances, rests: str, place: str, stands_s: float | None
) -> None:
    found, the_map = grounded(f'A pedestrian {rests}. A drone tracks the pedestrian at 25 m.')
    (person,) = _persons(found)
    anchor = the_map.network.position_on_lane(found.anchor_lane, found.anchor_position_m)[:2]
    assert person.halt_xy_m is not None
    assert person.stop_s == stands_s
    assert dist(person.halt_xy_m, MapPlaces(the_map).point(place, anchor)) < tolerances.arrival_m
    way = Polyline(person.route_xy_m)
    halts_m, aside_m = way.project(*person.halt_xy_m)
    assert aside_m == pytest.approx(0.0, abs=0.01)
    assert tolerances.drive_distance_m + 1.0 < halts_m < tolerances.drive_distance_m + 10.0
    # Who stays does not go on, who rests for a while has somewhere to go.
    left_m = way.length_m - halts_m
    assert left_m > 20.0 if stands_s is not None else person.release is ReleaseOn.CAPTURED


@pytest.mark.parametrize(
    ('words', 'stands_s'),
    [
        ('stops there for 10 s and then crosses', None),
        ('waits there for 10 s and then crosses', 10.0),
        ('stops there and then crosses', None),
    ],
)
def test_who_rests_before_he_crosses_walks_up_to_the_kerb(
    grounded: Ground, words: str, stands_s: float | None
) -> None:
    """Where an event lets him cross, that says how long he stands; he never halts on the road."""
    found, the_map = grounded(
        f'A pedestrian walks to the crosswalk, {words}. A drone tracks the pedestrian at 25 m.'
    )
    (person,) = _persons(found)
    assert person.release is ReleaseOn.CAPTURED
    assert person.stop_s == stands_s
    assert person.halt_xy_m is not None
    assert 5.0 < dist((person.x_m, person.y_m), person.halt_xy_m) < 30.0
    assert not the_map.network.carriageway.contains(shapely.Point(person.halt_xy_m))
    assert shapely.LineString(person.route_xy_m).intersection(the_map.network.carriageway).length


def test_who_stops_because_of_something_does_not_stop_at_a_place_by_itself(
    grounded: Ground,
) -> None:
    found, _ = grounded(
        'A pedestrian walks along the sidewalk and stops at the crosswalk when the drone warns '
        'him.'
    )
    (person,) = _persons(found)
    assert person.halt_xy_m is None
