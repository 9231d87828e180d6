# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stated conditions against what batteries, flights and drives leave."""

from __future__ import annotations

from typing import Any

from requests_by_hand import asked, judged, number, request

from aurora_core.outcomes.feasibility import Feasibility, Rule
from aurora_core.recheck import recheck
from aurora_core.spec.scenario import ScenarioSpec

HOVER = {
    'id': 'm0',
    'uav': 'uav1',
    'mode': 'hover',
    'target': 'landmark:Meadow Park',
    'altitude_m': number(40.0, 'm'),
}
LINE = {
    'id': 'm1',
    'uav': 'uav1',
    'mode': 'navigate',
    'pattern': 'line',
    'altitude_m': number(40.0, 'm'),
    'speed_mps': number(12.0, 'm/s'),
    'size_m': [number(400.0, 'm'), number(0.0, 'm')],
}


def flying(missions: list[dict[str, Any]], *conditions: Any) -> ScenarioSpec:
    return request(list(conditions), missions=missions)


def charged(least: float, duration_s: float) -> ScenarioSpec:
    hover = {**HOVER, 'duration_s': number(duration_s, 's')}
    return flying([hover], asked('c1', 'battery', ['uav1'], '>', least, '1'))


def test_a_battery_that_is_to_keep_more_than_the_flight_leaves_is_refused() -> None:
    spec = charged(0.5, 900.0)
    (proof,) = judged(spec).certificates
    assert (proof.rule, proof.reason) == (Rule.BATTERY, 'endurance')
    assert 'the battery of uav1 is down to 0.5 after 750 s' in proof.sentence
    assert recheck(proof, spec.model_dump(mode='json')).valid
    assert not recheck(proof, charged(0.3, 900.0).model_dump(mode='json')).valid


def test_a_battery_is_of_one_uav_and_no_fault_of_the_reader() -> None:
    verdict = judged(charged(0.3, 60.0))
    assert (verdict.result, verdict.findings) == (Feasibility.FEASIBLE, ())


def test_a_speed_that_another_mission_may_have_proves_nothing() -> None:
    """The hover before the route is slow enough."""
    slow = asked('c1', 'speed', ['uav1'], '<', 5.0, 'm/s')
    hover = {**HOVER, 'duration_s': number(20.0, 's')}
    alone, after = flying([LINE], slow), flying([hover, LINE], slow)
    assert [c.rule for c in judged(alone).certificates] == [Rule.FLIGHT_BAND]
    assert judged(after).certificates == ()
