# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An offset turns with the course of its target, smoothly, and no faster than one can fly."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, degrees, hypot, pi, sin

import pytest
from flown_missions import DT_S, SETTINGS

from aurora_core.mission.turning_offset import TurningOffset

LEFT = (0.0, 25.0)
Steps = list[tuple[tuple[float, float], tuple[float, float]]]


def _turned(course_deg: float, speed_mps: float, seconds: float) -> Steps:
    """Go beside a target that drives east for 1 s and then, at once, on another course."""
    offset, found = TurningOffset(LEFT, SETTINGS, DT_S), []
    for k in range(round(seconds / DT_S)):
        angle = 0.0 if k < 20 else course_deg * pi / 180.0
        course = (cos(angle), sin(angle))
        velocity = (speed_mps * course[0], speed_mps * course[1])
        found.append(offset.step(velocity, course))
    return found


@pytest.mark.parametrize('course_deg', [30.0, 90.0, -90.0, 170.0, 180.0, -179.0])
def test_it_comes_to_the_side_and_stays_there(course_deg: float) -> None:
    (x, y), velocity = _turned(course_deg, 8.0, 30.0)[-1]
    assert hypot(x, y) == pytest.approx(25.0)
    off = (degrees(atan2(y, x)) - 90.0 - course_deg + 180.0) % 360.0 - 180.0
    assert off == pytest.approx(0.0, abs=0.5)
    assert hypot(*velocity) < 0.2


@pytest.mark.parametrize('speed_mps', [2.0, 8.0, 15.0])
def test_it_goes_round_with_a_limited_speed_and_acceleration(speed_mps: float) -> None:
    steps = _turned(90.0, speed_mps, 12.0)
    round_mps = [hypot(*velocity) for _, velocity in steps]
    assert max(round_mps) <= 8.0 + 1e-9
    assert max(abs(b - a) for a, b in pairwise(round_mps)) <= 4.0 * DT_S + 1e-9
    for ((x, y), _), ((to_x, to_y), velocity) in pairwise(steps):
        assert hypot(to_x - x, to_y - y) == pytest.approx(DT_S * hypot(*velocity), abs=1e-3)


def test_it_turns_the_short_way_and_does_not_overshoot() -> None:
    angles = [degrees(atan2(y, x)) for (x, y), _ in _turned(60.0, 8.0, 15.0)]
    assert min(angles) >= 90.0 - 1e-6
    assert max(angles) <= 150.0 + 2.0


def test_a_target_that_stands_keeps_its_course() -> None:
    offset = TurningOffset(LEFT, SETTINGS, DT_S)
    first, _ = offset.step((0.0, 0.0), (0.0, 1.0))
    assert first == pytest.approx((-25.0, 0.0))
    offset.step((0.0, 5.0), (0.0, 1.0))
    stands, _ = offset.step((0.4, 0.0), (1.0, 0.0))
    assert stands == pytest.approx((-25.0, 0.0))


def test_an_offset_of_nothing_stays_nothing() -> None:
    offset = TurningOffset((0.0, 0.0), SETTINGS, DT_S)
    for course in ((1.0, 0.0), (-1.0, 0.0)):
        place, velocity = offset.step((5.0 * course[0], 0.0), course)
        assert place == pytest.approx((0.0, 0.0))
        assert velocity == pytest.approx((0.0, 0.0))
