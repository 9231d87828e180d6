# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Speeds that are not those of the way are found; honest ones, jumps and removals are not."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest

from aurora_core.knowledge.world import CentreLine
from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.trace.layout import UavColumn


def test_a_forged_speed_of_a_vehicle_is_found_with_both_ways(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.agents[1].speed[700:] *= 1.6
    verdict = tb.judge(case)
    found = [f for f in verdict.cross_check if f.kind == 'motion']
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert [f.subject for f in found] == ['van1']
    assert 700 < found[0].tick <= 720
    assert 'in 1 s, its speed says' in found[0].text


def test_a_forged_velocity_of_a_uav_is_found(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.flights[0].states[600:700, UavColumn.VX] = 0.0
    found = [f for f in tb.judge(case).cross_check if f.kind == 'motion']
    assert [f.subject for f in found] == ['uav1']


@pytest.mark.parametrize('share', [0.0, 0.05])
def test_small_differences_are_none(tb: ModuleType, share: float) -> None:
    case = tb.tailgate_case()
    case.run.agents[1].speed[700:] *= 1.0 + share
    assert not [f for f in tb.judge(case).cross_check if f.kind == 'motion']


def test_a_jump_is_left_to_its_condition(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.agents[1].y[900:] += 40.0
    verdict = tb.judge(case)
    assert not [f for f in verdict.cross_check if f.kind == 'motion']
    assert not tb.result(verdict, 'safety.jump').satisfied


def test_an_agent_that_is_gone_does_not_move(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    van = case.run.agents[1]
    van.present = np.where(np.arange(case.run.ticks) < 1100, 1.0, 0.0)
    van.x[1100:] = van.x[1100]
    assert not [f for f in tb.judge(case).cross_check if f.kind == 'motion']


def _lane(lane_id: str, west_m: float, east_m: float, y_m: float) -> CentreLine:
    points = np.array([(west_m, y_m), (east_m, y_m)])
    return CentreLine(
        lane_id=lane_id, street_name='', points=points, width_m=3.2, speed_limit_mps=14.0
    )


@pytest.mark.parametrize(
    ('share', 'found'), [(1.0, ['ego', 'van1']), (1.5, []), (0.8, ['ego', 'van1'])]
)
def test_on_a_lane_longer_than_it_is_counted_a_vehicle_gets_on_faster(
    tb: ModuleType, share: float, found: list[str]
) -> None:
    case = tb.tailgate_case()
    for agent in case.run.agents:
        agent.speed /= 1.5
    # Two lanes of an edge, counted as long as their mean.
    long_m = 20_000.0
    short_m = long_m * (2.0 / share - 1.0)
    y_m = float(case.run.agents[1].y[0])
    lanes = (
        _lane('e_0', -long_m / 2.0, long_m / 2.0, y_m),
        _lane('e_1', 0.0, max(short_m, 1.0), y_m + 50.0),
    )
    case.world = replace(case.world, lanes=lanes)
    told = [f.subject for f in tb.judge(case).cross_check if f.kind == 'motion']
    assert told == found


@pytest.mark.parametrize(('share', 'found'), [(1.0, []), (4.0, ['van1'])])
def test_in_a_turn_on_the_spot_the_way_is_that_of_the_front(
    tb: ModuleType, share: float, found: list[str]
) -> None:
    case = tb.tailgate_case()
    van = case.run.agents[1]
    begin, ticks, radius_m = 700, 40, 2.0
    length_m = case.run.trace().roster.agents[1].length_m
    # Its rear stands while its front goes half a circle round a point beside it.
    angle = np.clip((np.arange(case.run.ticks) - begin) / ticks, 0.0, 1.0) * np.pi
    rear_x = float(van.x[begin]) - length_m / 2.0
    front = rear_x + length_m + radius_m * np.sin(angle), radius_m * (1.0 - np.cos(angle))
    reach = np.hypot(front[0] - rear_x, front[1])
    van.heading = ((front[0] - rear_x) / reach, front[1] / reach)
    turns = np.arange(case.run.ticks) >= begin
    y_m = float(van.y[begin])
    van.x = np.where(turns, front[0] - length_m / 2.0 * van.heading[0], van.x)
    van.y = np.where(turns, y_m + front[1] - length_m / 2.0 * van.heading[1], y_m)
    turning = turns & (np.arange(case.run.ticks) <= begin + ticks)
    van.speed = np.where(turning, share * np.pi * radius_m / (ticks * 0.05), van.speed)
    van.speed[begin + ticks + 1 :] = 0.0
    case.world = replace(case.world, lanes=())
    told = [f.subject for f in tb.judge(case).cross_check if f.kind == 'motion']
    assert told == found
