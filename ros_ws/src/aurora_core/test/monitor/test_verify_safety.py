# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Safety conditions of every run, stated conditions, and the numbers of a result."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.outcomes.verdict import Reason, VerdictStatus
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import UavColumn, UavCommandColumn

T = 401


def _results(tb: ModuleType, case: Any) -> dict[str, Any]:
    return {r.id: r for r in tb.judge(case).results}


def test_an_overlap_is_a_collision_with_its_depth_time_and_place(tb: ModuleType) -> None:
    case = tb.ground_case(
        Behavior(kind=BehaviorKind.DRIVE), np.full(T, 5.0), car2=(20.0, np.zeros(T))
    )
    one = case.run.agents[0]
    one.x[:] = np.minimum(one.x, 17.5)
    one.speed[1:] = np.diff(one.x) / tb.DT_S
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}['safety.collision']
    assert verdict.status is VerdictStatus.VIOLATED
    # 4.5 m long each, 2.5 m between centres: 2 m overlap along, but 1.8 m across part them.
    assert found.margin == pytest.approx(-1.8)
    assert 'car1 and car2' in found.explanation
    assert found.worst_time_s == pytest.approx(17.5 / 5.0)
    assert found.worst_place_m is not None


def test_touching_is_a_collision(tb: ModuleType) -> None:
    case = tb.ground_case(Behavior(kind=BehaviorKind.PARK), np.zeros(T), car2=(4.5, np.zeros(T)))
    found = _results(tb, case)['safety.collision']
    assert found.margin == 0.0
    assert not found.satisfied


def test_a_jump_is_found(tb: ModuleType) -> None:
    case = tb.ground_case(Behavior(kind=BehaviorKind.DRIVE), np.full(T, 5.0))
    case.run.agents[0].x[100:] += 4.0
    found = _results(tb, case)['safety.jump']
    assert found.margin == pytest.approx(60.0 - (0.25 + 4.0) / 0.05)
    assert found.worst_time_s == 5.0
    assert 'car1' in found.explanation


def test_speed_limits_have_one_percent(tb: ModuleType) -> None:
    case = tb.ground_case(Behavior(kind=BehaviorKind.DRIVE), np.full(T, 50.4))
    assert _results(tb, case)['safety.vehicle_speed'].margin == pytest.approx(0.1)
    case = tb.ground_case(Behavior(kind=BehaviorKind.DRIVE), np.full(T, 50.6))
    assert not _results(tb, case)['safety.vehicle_speed'].satisfied


def test_clearance_counts_while_flying_only(tb: ModuleType) -> None:
    case = tb.hover_case()
    assert _results(tb, case)['safety.clearance.uav1'].satisfied
    wall = tb.building(95.0, 21.0, 105.0, 30.0, 60.0)  # 0.8 m beside the take-off spot
    case.world = tb.world(buildings=(wall,))
    found = _results(tb, case)['safety.clearance.uav1']
    assert found.margin == pytest.approx(0.8 - 3.0)
    assert 'a building' in found.explanation
    assert found.worst_time_s == pytest.approx(0.05)


@pytest.mark.parametrize(
    ('column', 'value', 'name', 'margin'),
    [
        (UavColumn.Z, 125.0, 'altitude_max', 123.6 - 125.0),
        (UavColumn.Z, 0.5, 'altitude_min', 0.5 - 1.0),
        (UavColumn.VX, 20.0, 'speed', 19.8 - 20.0),
        (UavColumn.VZ, 5.3, 'climb', 5.05 - 5.3),
        (UavColumn.VZ, -3.5, 'descent', 3.03 - 3.5),
    ],
)
def test_flight_limits(
    tb: ModuleType, column: UavColumn, value: float, name: str, margin: float
) -> None:
    case = tb.hover_case()
    case.run.flights[0].states[700, column] = value
    found = _results(tb, case)[f'safety.{name}.uav1']
    assert found.margin == pytest.approx(margin)
    assert found.worst_time_s == pytest.approx(35.0)


@pytest.mark.parametrize(
    ('column', 'value', 'name', 'margin'),
    [
        (UavCommandColumn.Z, 121.0, 'altitude_command', -1.0),
        (UavCommandColumn.Z, 2.0, 'altitude_command', -1.0),
        (UavCommandColumn.VY, 18.5, 'speed_command', -0.5),
    ],
)
def test_limits_of_what_is_commanded(
    tb: ModuleType, column: UavCommandColumn, value: float, name: str, margin: float
) -> None:
    case = tb.hover_case()
    case.run.flights[0].commands[700, column] = value
    assert _results(tb, case)[f'safety.{name}.uav1'].margin == pytest.approx(margin)


def test_a_no_fly_zone_is_not_entered(tb: ModuleType) -> None:
    case = tb.hover_case()
    case.world = tb.world(zones=(tb.zone(95.0, -5.0, 105.0, 5.0, 0.0, 200.0),))
    found = _results(tb, case)['safety.no_fly.uav1']
    assert found.margin == pytest.approx(-5.0)


def test_uavs_keep_apart_while_flying(tb: ModuleType) -> None:
    case = tb.hover_case()
    second = tb.flight(1401, (200.0, 20.0), 30.0, landing=900, id='uav2')
    second.states[700, UavColumn.X : UavColumn.Z + 1] = (104.0, 0.0, 30.0)
    case.run.flights.append(second)
    case.spec = tb.spec(**{**dict(case.spec), 'uavs': ({'id': 'uav1'}, {'id': 'uav2'})})
    found = _results(tb, case)['safety.separation.uav1.uav2']
    assert found.margin == pytest.approx(-1.0)


def test_endurance_is_the_time_in_the_air(tb: ModuleType) -> None:
    found = _results(tb, tb.hover_case())['safety.endurance.uav1']
    # In the air from tick 1 to the touchdown at about 60 s.
    assert found.margin == pytest.approx(1515.0 - 60.0, abs=0.2)


def _stated(tb: ModuleType, case: Any, **values: Any) -> Any:
    return tb.spec(**{**dict(case.spec), 'conditions': ({'id': 'c1'} | values,)})


@pytest.mark.parametrize(
    ('values', 'margin'),
    [
        ({'quantity': 'distance', 'of': ('car1', 'car2'), 'op': '<=', 'value': 100.0}, -20.0),
        ({'quantity': 'distance', 'of': ('car1', 'car2'), 'op': '>=', 'value': 15.0}, 5.0),
        ({'quantity': 'speed', 'of': ('car1',), 'op': '<', 'value': 7.0}, 2.0),
        ({'quantity': 'speed', 'of': ('car1',), 'op': '==', 'value': 4.5}, 0.5),
        (
            {
                'quantity': 'distance',
                'of': ('car1', 'car2'),
                'op': '<=',
                'value': 25.0,
                'by_s': 2.0,
            },
            5.0,
        ),
        (
            {
                'quantity': 'distance',
                'of': ('car1', 'car2'),
                'op': '>=',
                'value': 90.0,
                'hold_s': 4.0,
            },
            10.0,
        ),
        (
            {
                'quantity': 'distance',
                'of': ('car1', 'car2'),
                'op': '<=',
                'value': 40.0,
                'fraction': 0.5,
            },
            -0.3,
        ),
    ],
)
def test_stated_conditions(tb: ModuleType, values: dict[str, Any], margin: float) -> None:
    # The gap opens from 20 m to 120 m within 20 s: 5 m/s.
    case = tb.ground_case(
        Behavior(kind=BehaviorKind.DRIVE), np.full(T, 5.0), car2=(-20.0, np.zeros(T))
    )
    unit = Unit.METRE_PER_SECOND if values['quantity'] == 'speed' else Unit.METRE
    numbers = {'value': tb.number(values['value'], unit)}
    for name in ('by_s', 'hold_s', 'fraction'):
        if name in values:
            numbers[name] = tb.number(
                values[name], Unit.ONE if name == 'fraction' else Unit.SECOND
            )
    case.spec = _stated(tb, case, **(values | numbers))
    found = next(r for r in tb.judge(case).results if r.id.startswith('c1.'))
    assert found.margin == pytest.approx(margin, abs=0.01)
    assert not found.implied


def test_stated_fractions_of_a_phase(tb: ModuleType) -> None:
    case = tb.convoy_case()
    for quantity, value, unit, margin in (
        ('tracked_fraction', 0.9, Unit.ONE, 0.1),
        ('visible_fraction', 0.9, Unit.ONE, 0.1),
        ('visible_time', 20.0, Unit.SECOND, None),
    ):
        case.spec = _stated(
            tb, case, quantity=quantity, of=('uav1', 'bus1'), op='>=', value=tb.number(value, unit)
        )
        found = _results(tb, case)['c1.holds']
        if margin is None:
            begin = _results(tb, case)['m1.capture'].worst_time_s
            margin = 52.5 - begin - 20.0
        assert found.margin == pytest.approx(margin, abs=0.01)


def test_a_stated_stretch_of_sight(tb: ModuleType) -> None:
    case = tb.convoy_case()
    case.run.agents[1].present = np.where(
        (np.arange(1401) < 600) | (np.arange(1401) > 700), 1.0, 0.0
    )
    case.spec = _stated(
        tb,
        case,
        quantity='visible_time',
        of=('uav1', 'bus1'),
        op='>=',
        value=tb.number(15.0, Unit.SECOND),
        hold_s=tb.number(15.0, Unit.SECOND),
    )
    capture = _results(tb, case)['m1.capture'].worst_time_s
    found = _results(tb, case)['c1.holds']
    assert found.margin == pytest.approx(30.0 - capture - 15.0)


def test_a_stated_distance_to_a_body_that_leaves_is_gone(tb: ModuleType) -> None:
    case = tb.ground_case(
        Behavior(kind=BehaviorKind.DRIVE), np.full(T, 5.0), car2=(-20.0, np.zeros(T))
    )
    case.run.agents[1].present = (np.arange(T) < 200).astype(float)
    case.spec = _stated(
        tb, case, quantity='distance', of=('car1', 'car2'), op='<=', value=tb.number(500.0)
    )
    assert _results(tb, case)['c1.holds'].reason is Reason.TARGET_GONE


def test_margins_compare_when_divided_by_their_scale(tb: ModuleType) -> None:
    found = _results(tb, tb.convoy_case())
    with_tolerance = found['bus1.placed.distance']
    assert with_tolerance.normalised == pytest.approx(1.0)  # 1 m of 1 m tolerance
    with_threshold = found['safety.clearance.uav1']
    assert with_threshold.normalised == with_threshold.margin / (0.1 * 3.0)
    zero = found['bus1.placed']
    assert zero.normalised == zero.margin
