# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes are flown as often as a stated time allows, and keep their shape."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import pytest

from aurora_core.grounding.laps import REPEATED, Laps
from aurora_core.grounding.patterns import pattern_points
from aurora_core.knowledge.settings import load_settings
from aurora_core.mission.setpoint import FlightSettings, RouteReference
from aurora_core.quantities.waypoints import has_shape, orbit_radius_m, pattern_centre
from aurora_core.spec.vocabulary import Pattern

Point3 = tuple[float, float, float]

LAPS = Laps(load_settings())
# Time between capture and the start of the route, and for the UAV to come after its reference.
SPARE_S = 4.0


def lap(pattern: Pattern) -> tuple[Point3, ...]:
    points = pattern_points(pattern, length_m=60.0, width_m=40.0, radius_m=25.0, waypoint_count=4)
    assert points is not None
    return tuple((x, y, 30.0) for x, y in points)


def flown_s(way: tuple[Point3, ...], speed_mps: float) -> float:
    settings = load_settings()
    flight = FlightSettings(**settings.flight.model_dump())
    reference, ticks = RouteReference(way, speed_mps), 0
    while not reference.done:
        reference.step(flight, settings.run.dt_s)
        ticks += 1
    return ticks * settings.run.dt_s


def length_m(way: tuple[Point3, ...]) -> float:
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(way))


@pytest.mark.parametrize('pattern', sorted(REPEATED))
@pytest.mark.parametrize('asked_s', [90.0, 200.0])
def test_whole_laps_take_the_asked_time_at_a_speed_of_ones_own(
    pattern: Pattern, asked_s: float
) -> None:
    way, speed_mps = LAPS.lasting(lap(pattern), 8.0, asked_s, keeps_speed=False)
    assert flown_s(way, speed_mps) == pytest.approx(asked_s - SPARE_S, abs=0.5)
    assert has_shape(pattern, way)
    assert way[-1] in (lap(pattern)[0], lap(pattern)[-1])


@pytest.mark.parametrize('pattern', sorted(REPEATED))
@pytest.mark.parametrize('asked_s', [90.0, 200.0])
def test_a_stated_speed_is_kept_and_the_last_lap_is_cut(pattern: Pattern, asked_s: float) -> None:
    way, speed_mps = LAPS.lasting(lap(pattern), 5.0, asked_s, keeps_speed=True)
    assert speed_mps == 5.0
    assert asked_s - SPARE_S - 1.0 <= flown_s(way, speed_mps) <= asked_s - SPARE_S
    assert has_shape(pattern, way)


@pytest.mark.parametrize('turns', [1.0, 1.5, 2.0, 3.25])
def test_an_orbit_goes_round_as_often_as_asked(turns: float) -> None:
    one = lap(Pattern.ORBIT)
    way, speed_mps = LAPS.turned(one, turns, 8.0, None, keeps_speed=False)
    assert speed_mps == 8.0
    assert has_shape(Pattern.ORBIT, way)
    assert length_m(way) == pytest.approx(turns * length_m(one), abs=1.0)
    assert way[: len(one)] == one


@pytest.mark.parametrize(('keeps_speed', 'took_s'), [(True, None), (False, 90.0 - SPARE_S)])
def test_turns_in_a_stated_time_are_flown_at_a_speed_of_ones_own(
    keeps_speed: bool, took_s: float | None
) -> None:
    way, speed_mps = LAPS.turned(lap(Pattern.ORBIT), 2.0, 8.0, 90.0, keeps_speed=keeps_speed)
    assert length_m(way) == pytest.approx(2.0 * length_m(lap(Pattern.ORBIT)))
    if took_s is None:
        assert speed_mps == 8.0
    else:
        assert flown_s(way, speed_mps) == pytest.approx(took_s, abs=0.5)


def test_one_lap_is_flown_however_short_the_time() -> None:
    for keeps_speed in (True, False):
        way, _ = LAPS.lasting(lap(Pattern.ORBIT), 5.0, 10.0, keeps_speed=keeps_speed)
        assert way == lap(Pattern.ORBIT)


@pytest.mark.parametrize('asked_s', [12.0, 20.0])
def test_an_orbit_without_time_for_a_lap_is_flown_in_part(asked_s: float) -> None:
    way = LAPS.part(lap(Pattern.ORBIT), 5.0, asked_s)
    assert asked_s - SPARE_S - 1.5 <= flown_s(way, 5.0) <= asked_s - SPARE_S
    assert has_shape(Pattern.ORBIT, way, in_part=True)
    assert not has_shape(Pattern.ORBIT, way)
    assert pattern_centre(way) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert orbit_radius_m(way) == pytest.approx(25.0)


@pytest.mark.parametrize('radius_m', [20.0, 37.0, 60.0, 83.3])
@pytest.mark.parametrize('middle', [(160.0, 366.0), (-412.7, 90.1)])
def test_one_lap_ends_where_it_began(radius_m: float, middle: tuple[float, float]) -> None:
    points = pattern_points(
        Pattern.ORBIT, length_m=0.0, width_m=0.0, radius_m=radius_m, waypoint_count=0
    )
    assert points is not None
    east, north = middle
    ring = tuple((x + east, y + north, 30.0) for x, y in points)
    way, _ = LAPS.lasting(ring, 6.0, 5.0, keeps_speed=True)
    assert has_shape(Pattern.ORBIT, way)


def test_laps_that_leave_the_first_one_are_another_shape() -> None:
    way, _ = LAPS.lasting(lap(Pattern.RECTANGLE), 5.0, 200.0, keeps_speed=True)
    off = (way[-1][0] + 1.0, way[-1][1] + 1.0, way[-1][2])
    assert not has_shape(Pattern.RECTANGLE, (*way[:-1], off))
    assert not has_shape(Pattern.RECTANGLE, (*way[:6], off, *way[7:]))
