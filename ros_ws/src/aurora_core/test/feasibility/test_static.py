# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of a specification that do not fit together are told with what would mend them."""

from __future__ import annotations

from typing import Any

import pytest
from requests_by_hand import asked, judged, number, request

from aurora_core.feasibility.static import check_static
from aurora_core.outcomes.feasibility import CheckStage, Feasibility
from aurora_core.spec.scenario import ScenarioSpec


def message(sender: str, receiver: str) -> dict[str, Any]:
    return {'do': 'send_message', 'sender': sender, 'receiver': receiver}


def link(sender: str, receiver: str) -> dict[str, Any]:
    numbers = {
        name: number(value, unit)
        for name, value, unit in (
            ('loss', 0.0, '1'),
            ('latency_s', 0.1, 's'),
            ('retransmissions', 3.0, '1'),
            ('retransmission_interval_s', 0.2, 's'),
        )
    }
    return {'id': 'k1', 'sender': sender, 'receiver': receiver, **numbers}


def waiting(by: str) -> dict[str, Any]:
    brake = {'do': 'brake', 'agent': 'car1'}
    return {'id': 'e1', 'trigger': {'on': 'message_received', 'by': by}, 'action': brake}


SENDS = {'id': 'e2', 'action': message('car1', 'bus1')}
ORDER = {'id': 'o1', 'first': 'm1', 'then': 'm0'}
NO_BRAKING = {'forbids': 'behavior', 'id': 'no1', 'agent': 'car1', 'kind': 'brake'}
BRAKES = {'id': 'e1', 'action': {'do': 'brake', 'agent': 'car1'}}

CASES: dict[str, tuple[ScenarioSpec, ScenarioSpec, str]] = {
    'operands': (
        request([asked('c1', 'altitude', ['car1'], '>', 9.0, 'm')]),
        request([asked('c1', 'altitude', ['uav1'], '>', 9.0, 'm')]),
        'conditions/c1/of',
    ),
    'operands of a group': (
        request([asked('c1', 'speed', ['car1', 'crosswalk'], '<', 9.0, 'm/s')]),
        request([asked('c1', 'speed', ['car1', 'bus1'], '<', 9.0, 'm/s')]),
        'conditions/c1/of',
    ),
    'share': (
        request([asked('c1', 'visible_fraction', ['uav1', 'car1'], '>=', 90.0, '1')]),
        request([asked('c1', 'visible_fraction', ['uav1', 'car1'], '>=', 0.9, '1')]),
        'conditions/c1/value',
    ),
    'link': (
        request([], events=[SENDS]),
        request([], events=[SENDS], links=[link('car1', 'bus1')]),
        'events/e2/action',
    ),
    'sender': (
        request([], events=[waiting('bus1')]),
        request([], events=[waiting('bus1'), SENDS], links=[link('car1', 'bus1')]),
        'events/e1/trigger',
    ),
    'order': (
        request([], missions=2, orders=[ORDER]),
        request([], missions=2, orders=[{**ORDER, 'first': 'm0', 'then': 'm1'}]),
        'orders/o1',
    ),
    'forbidden': (
        request([], prohibitions=[{'forbids': 'agent', 'id': 'no1', 'type': 'bus'}]),
        request([], prohibitions=[{'forbids': 'agent', 'id': 'no1', 'type': 'truck'}]),
        'prohibitions/no1',
    ),
    'done': (
        request([], prohibitions=[NO_BRAKING], events=[BRAKES]),
        request([], prohibitions=[{**NO_BRAKING, 'kind': 'stop'}], events=[BRAKES]),
        'prohibitions/no1',
    ),
}


@pytest.mark.parametrize('name', CASES)
def test_what_does_not_fit_is_found_and_what_fits_is_not(name: str) -> None:
    wrong, right, field = CASES[name]
    [finding] = check_static(wrong)
    assert finding.field == field
    assert finding.relation
    assert finding.mend
    assert list(check_static(right)) == []


def test_a_finding_makes_a_request_doubtful_and_refuses_nothing() -> None:
    verdict = judged(CASES['operands'][0])
    assert (verdict.result, verdict.certificates) == (Feasibility.UNKNOWN, ())
    assert [f.field for f in verdict.findings] == ['conditions/c1/of']


@pytest.mark.parametrize('stage', [CheckStage.STATIC, CheckStage.PROOFS])
def test_a_stage_can_be_left_out(stage: CheckStage) -> None:
    too_high = asked('c2', 'altitude', ['uav1'], '>=', 130.0, 'm')
    spec = request([asked('c1', 'altitude', ['car1'], '>', 9.0, 'm'), too_high])
    verdict = judged(spec, stage)
    assert bool(verdict.findings) is (stage is CheckStage.PROOFS)
    assert bool(verdict.certificates) is (stage is CheckStage.STATIC)
