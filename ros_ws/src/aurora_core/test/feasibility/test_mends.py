# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What could be asked instead: with it a request is feasible, one step short of it it is not."""

from __future__ import annotations

from typing import Any

import pytest
from requests_by_hand import asked, judged, number, request

from aurora_core.feasibility.mends import _changed
from aurora_core.outcomes.feasibility import Certificate, Feasibility, Mend, Rule
from aurora_core.recheck import recheck
from aurora_core.spec.scenario import ScenarioSpec


def flown(**mission: Any) -> list[dict[str, Any]]:
    default = {**number(30.0, 's'), 'provenance': 'default', 'span': None}
    return [{'id': 'm0', 'uav': 'uav1', 'duration_s': default, **mission}]


def hovering(altitude_m: float, target: str | None = None, **more: Any) -> list[dict[str, Any]]:
    return flown(mode='hover', target=target, altitude_m=number(altitude_m, 'm'), **more)


def request_of(missions: list[dict[str, Any]], *conditions: Any, **more: Any) -> ScenarioSpec:
    spec = request(list(conditions), **more).model_dump(mode='json')
    return ScenarioSpec.model_validate({**spec, 'missions': missions})


LINK = {
    'id': 'link1',
    'sender': 'uav1',
    'receiver': 'car1',
    'range_m': number(40.0, 'm'),
    'loss': {**number(0.0, '1'), 'provenance': 'default', 'span': None},
    'latency_s': {**number(0.1, 's'), 'provenance': 'default', 'span': None},
    'retransmissions': {**number(3.0, '1'), 'provenance': 'default', 'span': None},
    'retransmission_interval_s': {**number(0.2, 's'), 'provenance': 'default', 'span': None},
}
SENT = {
    'id': 'e1',
    'trigger': {'on': 'time', 'at_s': number(40.0, 's')},
    'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': 'car1'},
}
TRACKED = flown(
    mode='track',
    target='car1',
    altitude_m=number(70.0, 'm'),
    standoff_m=number(0.0, 'm'),
    duration_s=number(60.0, 's'),
)
LANDED = {**asked('c1', 'landed', ['uav1'], '==', 1.0, '1'), 'by_s': number(40.0, 's')}
CASES = {
    'limit': (request_of(hovering(500.0)), {'missions/m0/altitude_m': 120.0}),
    'sensing': (
        request_of(hovering(100.0, 'car1'), world={'weather': 'fog'}),
        {'missions/m0/altitude_m': 77.0},
    ),
    'radio': (
        request_of(TRACKED, links=[LINK], events=[SENT]),
        {'links/link1/range_m': 68.0, 'missions/m0/altitude_m': 42.0},
    ),
    'phase': (
        # It has to climb and to land as well.
        request_of(hovering(40.0, duration_s=number(1800.0, 's'))),
        {'missions/m0/duration_s': 1478.7},
    ),
    'phases': (
        request_of(
            [
                *hovering(50.0, duration_s=number(840.0, 's')),
                {**hovering(50.0, duration_s=number(720.0, 's'))[0], 'id': 'm1'},
            ]
        ),
        {'missions/m0/duration_s': 753.4, 'missions/m1/duration_s': 633.4},
    ),
    'battery': (
        request_of(hovering(118.0, duration_s=number(1490.0, 's'))),
        {'missions/m0/duration_s': 1437.1, 'missions/m0/altitude_m': 18.9},
    ),
    'deadline': (
        request_of(hovering(30.0, duration_s=number(60.0, 's')), LANDED),
        {'conditions/c1/by_s': 75.9, 'missions/m0/duration_s': 24.1},
    ),
    'flight_band': (
        request_of(
            hovering(50.0, 'car1'), asked('c1', 'distance', ['uav1', 'car1'], '<', 30.0, 'm')
        ),
        {'conditions/c1/value': 48.0, 'missions/m0/altitude_m': 32.0},
    ),
    'bounds': (
        request(
            [
                asked('c1', 'distance', ['car1', 'bus1'], '<', 30.0, 'm'),
                asked('c2', 'distance', ['car1', 'bus1'], '>', 50.0, 'm'),
            ]
        ),
        {'conditions/c1/value': 50.1, 'conditions/c2/value': 29.9},
    ),
    'wind': (
        request_of(hovering(30.0), world={'wind_mps': number(18.0, 'm/s')}),
        {'world/wind_mps': 15.0},
    ),
    'roof': (
        request_of(hovering(12.0, 'landmark:City Hall')),
        {'missions/m0/altitude_m': 25.0},
    ),
    'wall': (
        request_of(
            hovering(15.0, 'landmark:Union Station', standoff_m=number(60.0, 'm')),
            asked('c1', 'clearance', ['uav1', 'landmark:City Hall'], '<', 1.0, 'm'),
        ),
        {'conditions/c1/value': 3.0, 'missions/m0/altitude_m': 22.1},
    ),
}  # fmt: skip


def mends_of(spec: ScenarioSpec) -> list[Mend]:
    return [m for c in judged(spec).certificates for m in c.mends]


@pytest.mark.parametrize('rule', CASES)
def test_every_number_is_told_with_the_nearest_value_that_can_be(rule: str) -> None:
    spec, values = CASES[rule]
    found = {m.path: m.nearest for m in mends_of(spec)}
    assert found == values


@pytest.mark.parametrize('rule', CASES)
def test_with_a_nearest_value_the_check_accepts_and_the_re_check_agrees(rule: str) -> None:
    spec, _ = CASES[rule]
    for proof in judged(spec).certificates:
        assert recheck(proof, spec.model_dump(mode='json')).valid
        for mend in proof.mends:
            changed = _changed(spec, mend.path, mend.nearest)
            assert judged(changed).result is Feasibility.FEASIBLE, mend


@pytest.mark.parametrize('rule', CASES)
@pytest.mark.parametrize('far', [0.5, -0.5, 7.0])
def test_another_value_is_refuted(rule: str, far: float) -> None:
    spec, _ = CASES[rule]
    for proof in judged(spec).certificates:
        for mend in proof.mends:
            other = mend.model_copy(update={'nearest': mend.nearest + far})
            forged = proof.model_copy(update={'mends': (other,)})
            assert not recheck(forged, spec.model_dump(mode='json')).valid, other


def test_a_value_that_another_proof_rules_out_is_not_told() -> None:
    """To be seen in fog it would have to fly in the building."""
    spec = request_of(
        hovering(100.0, 'landmark:Mercy Hospital', standoff_m=number(0.0, 'm')),
        asked('c1', 'altitude', ['uav1'], '>=', 110.0, 'm'),
        asked('c2', 'altitude', ['uav1'], '<=', 130.0, 'm'),
        world={'weather': 'fog'},
    )
    proofs = judged(spec).certificates
    sensing = next(c for c in proofs if c.rule is Rule.SENSING)
    assert 'missions/m0/altitude_m' not in [m.path for m in sensing.mends]


def test_elements_that_are_too_many_are_told_with_how_many_can_be() -> None:
    spec = request([], uavs=[{'id': f'uav{k}'} for k in range(1, 13)])
    proof: Certificate = judged(spec).certificates[0]
    assert [(m.path, m.requested, m.nearest) for m in proof.mends] == [('uavs', 12.0, 10.0)]
    assert recheck(proof, spec.model_dump(mode='json')).valid


def test_a_value_is_not_told_to_be_nearest_because_other_times_exclude_each_other() -> None:
    """A scenario too short for its hover is no reason why a lower height could not be due."""
    due = {**asked('c1', 'altitude', ['uav1'], '>=', 39.5, 'm'), 'by_s': number(7.2, 's')}
    spec = request_of(
        hovering(40.0, duration_s=number(60.0, 's')), due, world={'duration_s': number(30.0, 's')}
    )
    told = [
        (proof, mend)
        for proof in judged(spec).certificates
        for mend in proof.mends
        if mend.path == 'conditions/c1/value'
    ]
    assert told
    for proof, mend in told:
        document = spec.model_dump(mode='json')
        assert recheck(proof, document).valid
        for off in (-5.0, -1.0, 1.0):
            change = mend.model_copy(update={'nearest': mend.nearest + off})
            forged = proof.model_copy(update={'mends': (change,)})
            assert not recheck(forged, document).valid, off
