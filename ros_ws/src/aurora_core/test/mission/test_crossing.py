# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The way over: up where it was, across above everything, down at the goal."""

from __future__ import annotations

import pytest

from aurora_core.mission.crossing import Crossing
from aurora_core.mission.setpoint import FlightSettings, PursuitReference

DT_S = 0.05
FLIGHT = FlightSettings(
    speed_max_mps=16.5, acceleration_mps2=4.0, climb_mps=4.0, descent_mps=2.5,
    corner_speed_mps=1.5, position_gain_hz=0.8,
)  # fmt: skip
GOAL = ((200.0, 0.0, 20.0), (0.0, 0.0))


def _flown(over_m: float | None) -> list[tuple[float, float, float]]:
    """Return where the set-point is, tick by tick, from (0, 0, 20) to the goal 200 m on."""
    reference, crossing = PursuitReference(0.0, 0.0, 20.0), Crossing(over_m)
    points = []
    for _ in range(1200):
        goal, velocity = crossing.goal(reference, (reference.x, reference.y), GOAL)
        reference.step(goal, velocity, FLIGHT, DT_S)
        points.append((reference.x, reference.y, reference.z))
    return points


def test_what_stands_between_is_crossed_above() -> None:
    points = _flown(60.0)
    between = [z for x, _, z in points if 5.0 < x < 190.0]
    assert between
    assert min(between) >= 59.0
    assert points[-1] == pytest.approx(GOAL[0], abs=0.5)


def test_without_a_height_the_way_is_straight() -> None:
    points = _flown(None)
    assert {z for _, _, z in points} == {20.0}
    assert points[-1] == pytest.approx(GOAL[0], abs=0.5)


def test_who_has_been_above_the_goal_stays_down() -> None:
    crossing = Crossing(60.0)
    above = PursuitReference(199.0, 0.0, 60.0)
    assert crossing.goal(above, (199.0, 0.0), GOAL) == GOAL
    away = PursuitReference(150.0, 0.0, 20.0)  # blown off later, it does not go up again
    assert crossing.goal(away, (150.0, 0.0), GOAL) == GOAL


@pytest.mark.parametrize('from_m', [5.0, 60.0])
def test_a_level_way_begins_at_its_height(from_m: float) -> None:
    reference, crossing = PursuitReference(0.0, 0.0, from_m), Crossing(None, level=True)
    points = []
    for _ in range(1600):
        goal, velocity = crossing.goal(reference, (reference.x, reference.y), GOAL)
        reference.step(goal, velocity, FLIGHT, DT_S)
        points.append((reference.x, reference.y, reference.z))
    way = [z for x, _, z in points if x > 1.0]
    assert (min(way), max(way)) == pytest.approx((20.0, 20.0), abs=0.6)
    assert points[-1] == pytest.approx(GOAL[0], abs=0.5)
