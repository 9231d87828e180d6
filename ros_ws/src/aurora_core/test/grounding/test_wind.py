# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The wind of a run is the one that is named, and meets the flight as it is to."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, degrees, hypot
from typing import Any

import pytest

from aurora_core.knowledge.limits import Limits, Tolerances, hover_drift_limit_m
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.planning.complete import complete
from aurora_core.quantities.waypoints import longest_leg
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import RelativeWind

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Make = Callable[..., Parameter]
HOVER = 'A drone hovers over City Hall at 50 m.'
ROUTE = 'A drone patrols a rectangle of 100 m by 60 m at 60 m.'
TRACK = 'A drone tracks a van at 40 m.'


@pytest.fixture
def blown(read_prompt: Read, ground: Ground, limits: Limits) -> Callable[..., GroundedScenario]:
    """Ground a prompt with something said of its wind."""

    def grounded(prompt: str, seed: int = 1, **asked: Any) -> GroundedScenario:
        spec = read_prompt(prompt, 'downtown')
        world = spec.world.model_copy(update=asked)
        found = ground(
            complete(spec.model_copy(update={'world': world}), limits), 'downtown', seed
        )
        assert isinstance(found, GroundedScenario)
        return found

    return grounded


def _wind(found: GroundedScenario) -> tuple[float, float]:
    return found.wind_mean_east_mps, found.wind_mean_north_mps


def _off_deg(found: GroundedScenario, course: tuple[float, float]) -> float:
    (east, north), (x, y) = _wind(found), course
    return degrees(atan2(abs(x * north - y * east), x * east + y * north))


Blown = Callable[..., GroundedScenario]


def test_without_a_name_it_is_the_one_of_the_weather(blown: Blown, limits: Limits) -> None:
    assert _wind(blown(HOVER)) == (0.0, 0.0)
    rain = blown('In rain a drone hovers over City Hall at 50 m.')
    assert _wind(rain) == (limits.wind_mean_mps['rain'], 0.0)


@pytest.mark.parametrize(
    ('from_deg', 'east', 'north'), [(270.0, 6.0, 0.0), (0.0, 0.0, -6.0), (90.0, -6.0, 0.0)]
)
def test_it_blows_from_where_it_is_said(
    blown: Blown, parameter: Make, from_deg: float, east: float, north: float
) -> None:
    found = blown(HOVER, wind_mps=parameter(6.0, 'm/s'), wind_from_deg=parameter(from_deg, 'deg'))
    assert _wind(found) == pytest.approx((east, north), abs=1e-9)
    assert found.wind_gust_mps == 0.0


def test_gusts_exceed_the_mean_wind_by_what_is_stated(blown: Blown, parameter: Make) -> None:
    found = blown(HOVER, wind_mps=parameter(5.0, 'm/s'), gust_mps=parameter(8.0, 'm/s'))
    assert found.wind_gust_mps == pytest.approx(3.0)
    up_to = parameter(8.0, 'm/s', bound=Bound.AT_MOST)
    assert blown(HOVER, gust_mps=up_to).wind_gust_mps == pytest.approx(8.0)


def test_gusts_stay_those_of_the_weather(blown: Blown, parameter: Make, limits: Limits) -> None:
    found = blown('In rain a drone hovers over City Hall at 50 m.', wind_mps=parameter(8.0, 'm/s'))
    assert hypot(*_wind(found)) == pytest.approx(8.0)
    assert found.wind_gust_mps == limits.wind_gust_mps['rain']


def test_what_is_left_open_is_drawn_by_the_seed(blown: Blown, parameter: Make) -> None:
    winds = {seed: _wind(blown(HOVER, seed, wind_mps=parameter(6.0, 'm/s'))) for seed in (1, 2, 3)}
    assert len(set(winds.values())) == 3
    assert [hypot(*wind) for wind in winds.values()] == pytest.approx([6.0, 6.0, 6.0])
    assert winds[1] == _wind(blown(HOVER, 1, wind_mps=parameter(6.0, 'm/s')))


@pytest.mark.parametrize(
    ('wind', 'off_deg'),
    [
        (RelativeWind.TAILWIND, 0.0),
        (RelativeWind.CROSSWIND, 90.0),
        (RelativeWind.HEADWIND, 180.0),
    ],
)
def test_it_meets_the_longest_leg_and_the_way_of_a_target(
    blown: Blown, wind: RelativeWind, off_deg: float
) -> None:
    route = blown(ROUTE, wind=wind)
    a, b = longest_leg(route.uavs[0].missions[0].waypoints)
    assert hypot(b[0] - a[0], b[1] - a[1]) == pytest.approx(100.0)
    assert _off_deg(route, (b[0] - a[0], b[1] - a[1])) == pytest.approx(off_deg, abs=1e-5)
    track = blown(TRACK, wind=wind)
    (van,) = track.agents
    assert _off_deg(track, (van.heading_x, van.heading_y)) == pytest.approx(off_deg, abs=1e-5)


def test_a_crosswind_is_from_either_side(blown: Blown) -> None:
    winds = {_wind(blown(ROUTE, seed, wind=RelativeWind.CROSSWIND)) for seed in range(1, 9)}
    (first, second) = sorted(winds)
    assert first == pytest.approx((-second[0], -second[1]))


def test_a_speed_that_is_not_said_is_the_one_of_the_weather_else_5_mps(
    blown: Blown, parameter: Make
) -> None:
    assert hypot(*_wind(blown(HOVER, wind_from_deg=parameter(0.0, 'deg')))) == pytest.approx(5.0)
    rain = blown(
        'In heavy rain a drone hovers over City Hall at 50 m.', wind=RelativeWind.CROSSWIND
    )
    assert hypot(*_wind(rain)) == pytest.approx(6.0)


@pytest.mark.parametrize(
    ('bound', 'least', 'most'), [('at_least', 6.0, 7.0), ('at_most', 5.0, 6.0)]
)
def test_a_bound_is_kept(
    blown: Blown, parameter: Make, bound: str, least: float, most: float
) -> None:
    asked = parameter(6.0, 'm/s').model_copy(update={'bound': Bound(bound)})
    assert least < hypot(*_wind(blown(HOVER, wind_mps=asked))) < most


def test_who_hovers_in_a_named_wind_may_drift_as_in_wind(
    read_prompt: Read, parameter: Make, limits: Limits, tolerances: Tolerances
) -> None:
    world = read_prompt(HOVER, 'downtown').world
    calm = hover_drift_limit_m(world, limits, tolerances)
    named = world.model_copy(update={'wind_mps': parameter(6.0, 'm/s')})
    still = world.model_copy(update={'wind_mps': parameter(0.0, 'm/s')})
    assert calm == hover_drift_limit_m(still, limits, tolerances) == 2.0
    assert hover_drift_limit_m(named, limits, tolerances) == 3.0
