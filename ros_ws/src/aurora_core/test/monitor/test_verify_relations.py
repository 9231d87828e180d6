# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Placements, relations in motion and behaviours of ground agents."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.outcomes.verdict import Reason, VerdictStatus
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.vocabulary import BehaviorKind, Relation

T = 401  # 20 s


def _results(tb: ModuleType, case: Any) -> dict[str, Any]:
    return {r.id: r for r in tb.judge(case).results}


def test_a_convoy_is_verified(tb: ModuleType) -> None:
    verdict = tb.judge(tb.convoy_case())
    assert verdict.status is VerdictStatus.VERIFIED, [
        r.explanation for r in verdict.results if not r.satisfied
    ]
    found = {r.id: r for r in verdict.results}
    assert found['bus1.placed'].margin == pytest.approx(20.0)
    assert found['bus1.placed.distance'].margin == pytest.approx(1.0)
    assert found['bus1.placed.kept'].margin == pytest.approx(0.2)
    assert found['ambulance1.placed'].margin == pytest.approx(20.0)
    # 20 m between centres are 14.5 m between ambulance (6.5 m) and ego (4.5 m).
    assert found['ambulance1.follow'].margin == pytest.approx(0.2)
    # Up to the landing command at 52.5 s: 25 m while speeding up, then 10 m/s.
    assert found['bus1.drive'].margin == pytest.approx(25.0 + 47.45 * 10.0 - 20.0, abs=1.0)
    assert found['car1.circulate'].margin == pytest.approx(25.0 + 47.45 * 10.0 - 50.0, abs=1.0)


def test_an_ego_that_overtakes_the_bus_ends_the_relation(tb: ModuleType) -> None:
    # The ego is faster by 2 m/s from the start: 20 m are made up after 10 s of 52.5 s.
    fast = tb.ramp(1401, 0, 10.0) + 2.0
    found = _results(tb, tb.convoy_case(ego=fast))['bus1.placed.kept']
    assert found.margin == pytest.approx(10.0 / 52.5 - 0.8, abs=0.002)
    assert found.worst_time_s == pytest.approx(10.0, abs=0.1)


def test_a_bus_that_leaves_the_route_is_not_ahead(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.agents[1].y[525:] = 30.0
    found = _results(tb, case)
    assert found['bus1.placed.kept'].margin == pytest.approx(0.5 - 0.8)


def test_an_ambulance_that_falls_back_does_not_follow(tb: ModuleType) -> None:
    slow = tb.ramp(1401, 0, 10.0) * 0.5
    found = _results(tb, tb.convoy_case(ambulance1=slow))['ambulance1.follow']
    assert found.margin is not None
    assert found.margin < -0.5


def test_following_while_slow_allows_a_gap_of_one_metre(tb: ModuleType) -> None:
    still = np.zeros(T)
    follow = Behavior(kind=BehaviorKind.FOLLOW, target='car2')
    for x, margin in ((6.5, 0.2), (5.0, -0.8), (60.0, -0.8)):  # gaps 2 m, 0.5 m, 55.5 m
        case = tb.ground_case(follow, still, car2=(x, still))
        assert _results(tb, case)['car1.follow'].margin == pytest.approx(margin)
    moving = np.full(T, 5.0)
    case = tb.ground_case(follow, moving, car2=(6.5, moving))
    assert _results(tb, case)['car1.follow'].margin == pytest.approx(-0.8)  # 5 m asked


@pytest.mark.parametrize(('x', 'satisfied'), [(12.0, True), (-12.0, False)])
def test_a_placement_ahead_is_signed(tb: ModuleType, x: float, satisfied: bool) -> None:
    case = tb.convoy_case()
    case.run.agents[1].x += x - 20.0
    found = _results(tb, case)['bus1.placed']
    assert found.margin == pytest.approx(x)
    assert found.satisfied is satisfied


def test_an_agent_that_is_absent_at_the_start_has_no_place(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.agents[1].present = (np.arange(1401) > 3).astype(float)
    found = _results(tb, case)
    assert found['bus1.placed'].reason is Reason.TARGET_GONE
    assert found['safety.presence'].margin == -0.5
    assert found['safety.presence'].worst_time_s == 0.0


def _placed(tb: ModuleType, relation: Relation, x: float, y: float, **values: Any) -> Any:
    case = tb.ground_case(Behavior(kind=BehaviorKind.PARK), np.zeros(T), ego=(0.0, np.zeros(T)))
    case.run.agents[0].x[:], case.run.agents[0].y[:] = x, y
    place = Placement(relation=relation, of='ego', **values)
    agents = (dict(case.spec.agents[0]) | {'placements': (place,)}, case.spec.agents[1])
    case.spec = tb.spec(agents=agents)
    return case


@pytest.mark.parametrize(
    ('relation', 'x', 'y', 'margin'),
    [
        (Relation.LEFT, 0.0, 4.0, 3.1),  # beyond the flank of the other one, 1.8 m wide
        (Relation.LEFT, -5.0, 0.5, -0.4),
        (Relation.RIGHT, 0.0, 4.0, -4.9),
        (Relation.BESIDE, 1.5, 4.0, 3.0),
        (Relation.NEAR, 30.0, 40.0, 0.0),
        (Relation.SAME_LANE, 30.0, 0.5, 1.25),
        (Relation.ONCOMING, 30.0, 4.0, -1.0),
    ],
)
def test_relations_at_the_start(
    tb: ModuleType, relation: Relation, x: float, y: float, margin: float
) -> None:
    found = _results(tb, _placed(tb, relation, x, y))['car1.placed']
    assert found.margin == pytest.approx(margin)


@pytest.mark.parametrize(
    ('x', 'y', 'margin'),
    [
        (0.0, 4.0, 0.2),
        (-3.0, 4.0, 0.2),
        (-100.0, 4.0, -0.8),
        (100.0, 4.0, -0.8),
        (0.0, -4.0, -0.8),
    ],
)
def test_who_stays_on_a_side_is_level_with_the_other_one(
    tb: ModuleType, x: float, y: float, margin: float
) -> None:
    found = _results(tb, _placed(tb, Relation.LEFT, x, y, kept_in_motion=True))
    assert found['car1.placed.kept'].margin == pytest.approx(margin)


def test_an_oncoming_car_faces_the_other_way(tb: ModuleType) -> None:
    case = _placed(tb, Relation.ONCOMING, 30.0, 4.0)
    case.run.agents[0].heading = (-1.0, 0.0)
    assert _results(tb, case)['car1.placed'].margin == pytest.approx(1.0)


def test_stated_distance_and_bearing_of_a_placement(tb: ModuleType) -> None:
    values = {
        'distance_m': tb.number(50.0, explicit=True),
        'bearing_deg': tb.number(40.0, Unit.DEGREE, explicit=True),
    }
    found = _results(tb, _placed(tb, Relation.NEAR, 30.0, 40.0, **values))
    assert found['car1.placed.distance'].margin == pytest.approx(1.0)
    # atan(30 / 40) is 36.87 degrees: 3.13 of 15 degrees are used.
    assert found['car1.placed.bearing'].margin == pytest.approx(15.0 - 3.13, abs=0.01)


def test_driving_means_moving(tb: ModuleType) -> None:
    drive = Behavior(kind=BehaviorKind.DRIVE)
    assert _results(tb, tb.ground_case(drive, np.full(T, 5.0)))[
        'car1.drive'
    ].margin == pytest.approx(80.0)
    found = _results(tb, tb.ground_case(drive, np.zeros(T)))['car1.drive']
    assert found.margin == -20.0


def test_overtaking_is_getting_from_behind_to_ahead(tb: ModuleType) -> None:
    overtake = Behavior(kind=BehaviorKind.OVERTAKE, target='car2')
    fast, slow = np.full(T, 10.0), np.full(T, 5.0)
    case = tb.ground_case(overtake, fast, car2=(40.0, slow))
    assert _results(tb, case)['car1.overtake'].margin == pytest.approx(60.0)
    case = tb.ground_case(overtake, slow, car2=(40.0, slow))
    assert _results(tb, case)['car1.overtake'].margin == pytest.approx(-40.0)
    case = tb.ground_case(overtake, fast, car2=(-40.0, slow))
    assert _results(tb, case)['car1.overtake'].reason is Reason.PREMISE_NEVER


def test_approaching_is_getting_closer(tb: ModuleType) -> None:
    approach = Behavior(kind=BehaviorKind.APPROACH, target='car2')
    case = tb.ground_case(approach, np.full(T, 1.0), car2=(40.0, np.zeros(T)))
    assert _results(tb, case)['car1.approach'].margin == pytest.approx(20.0 - 10.0)
    case = tb.ground_case(approach, np.zeros(T), car2=(40.0, np.zeros(T)))
    assert _results(tb, case)['car1.approach'].margin == -10.0


def test_stopping_needs_motion_first(tb: ModuleType) -> None:
    stop = Behavior(kind=BehaviorKind.STOP)
    driving = np.full(T, 5.0)
    stops = np.where(np.arange(T) < 200, 5.0, 0.02)
    assert _results(tb, tb.ground_case(stop, stops))['car1.stop'].margin == pytest.approx(0.08)
    assert _results(tb, tb.ground_case(stop, driving))['car1.stop'].margin == pytest.approx(-4.9)
    never = _results(tb, tb.ground_case(stop, np.zeros(T)))['car1.stop']
    assert never.reason is Reason.PREMISE_NEVER
    short = np.where(np.arange(T) < T - 20, 5.0, 0.0)  # 1 s of standing, 2 s asked
    assert _results(tb, tb.ground_case(stop, short))['car1.stop'].margin == pytest.approx(-4.9)


def test_braking_is_a_loss_of_speed(tb: ModuleType) -> None:
    brake = Behavior(kind=BehaviorKind.BRAKE)
    hard = np.maximum(10.0 - np.maximum(np.arange(T) - 100, 0) * 0.05 * 5.0, 0.0)
    found = _results(tb, tb.ground_case(brake, hard))['car1.brake']
    assert found.margin == pytest.approx(1.0)
    soft = _results(tb, tb.ground_case(brake, np.full(T, 5.0)))['car1.brake']
    assert soft.margin == -4.0


def test_waiting_and_parking(tb: ModuleType) -> None:
    waits = np.where(np.arange(T) < 100, 0.0, 5.0)
    assert _results(tb, tb.ground_case(Behavior(kind=BehaviorKind.WAIT), waits))[
        'car1.wait'
    ].satisfied
    parked = _results(tb, tb.ground_case(Behavior(kind=BehaviorKind.PARK), waits))['car1.park']
    assert parked.margin == pytest.approx(0.1 - 5.0)
    assert parked.worst_time_s == pytest.approx(5.0)
