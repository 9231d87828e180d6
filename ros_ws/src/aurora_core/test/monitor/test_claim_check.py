# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Claims against the commands and the record: phases, actions, releases, messages, the end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import pytest

from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.spec.scenario import AgentAction
from aurora_core.trace.layout import UavCommandColumn, UavPhase
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind

K = ScenarioEventKind


def _landing_claimed_early(case: Any) -> None:
    case.run.claim(800, K.PHASE, 'uav1', 'landing')


def _two_phases_at_once(case: Any) -> None:
    case.run.claim(0, K.PHASE, 'uav1', 'm1')


def _phase_of_a_stranger(case: Any) -> None:
    case.run.claim(30, K.PHASE, 'uav9', 'm1')


def _phase_that_no_plan_has(case: Any) -> None:
    case.run.flights[0].commands[900:950, UavCommandColumn.PHASE] = UavPhase.MISSION + 7


def _trigger_twice(case: Any) -> None:
    case.run.claim(700, K.TRIGGERED, 'e1')


def _brakes_without_a_command(case: Any) -> None:
    case.spec = case.spec.model_validate(
        dict(case.spec)
        | {
            'links': (),
            'events': (
                dict(case.spec.events[0]) | {'action': AgentAction(do='brake', agent='van1')},
            ),
        }
    )
    case.run.links.clear()


def _trigger_without_action(case: Any) -> None:
    _brakes_without_a_command(case)
    case.run.events[:] = [e for e in case.run.events if e.kind is not K.ACTION]


def _release_of_a_stranger(case: Any) -> None:
    case.run.claim(100, K.RELEASED, 'bus7')


def _release_without_a_command(case: Any) -> None:
    case.run.claim(100, K.RELEASED, 'van1')


def _message_of_no_event(case: Any) -> None:
    case.run.links[:] = [replace(r, event='e9') for r in case.run.links]


def _message_over_another_link(case: Any) -> None:
    other = dict(case.spec.links[0]) | {'id': 'l2', 'receiver': 'van1'}
    case.spec = case.spec.model_validate(
        dict(case.spec) | {'links': (*case.spec.links, other)},
    )
    case.run.links[:] = [replace(r, link='l2', receiver='van1') for r in case.run.links]


def _end_too_early(case: Any) -> None:
    case.run.claim(900, K.FINISHED, 'run', 'finished')
    case.run.finished = False


def _end_twice(case: Any) -> None:
    case.run.claim(900, K.FINISHED, 'run', 'finished')


def _horizon_too_early(case: Any) -> None:
    case.facts = case.facts.model_validate(dict(case.facts) | {'horizon_s': 500.0})
    case.run.claim(case.run.ticks - 1, K.FINISHED, 'run', 'horizon')
    case.run.finished = False


def _finished_in_the_air(case: Any) -> None:
    case.facts = case.facts.model_validate(dict(case.facts) | {'horizon_s': 500.0})
    case.run.flights[0].states[-400:, 2] = 20.0
    case.run.flights[0].states[-400:, 5] = 0.0


def _outcome_of_its_own(case: Any) -> None:
    case.run.claim(case.run.ticks - 1, K.FINISHED, 'run', 'well done')
    case.run.finished = False


@pytest.mark.parametrize(
    ('forge', 'kind', 'text'),
    [
        (_landing_claimed_early, 'phase', 'phase claimed: landing, the commands begin: None'),
        (_two_phases_at_once, 'phase', 'two phases claimed at one tick'),
        (_phase_of_a_stranger, 'phase', 'does not take part'),
        (_phase_that_no_plan_has, 'phase', 'phase 9'),
        (_trigger_twice, 'event', 'TRIGGERED claimed a second time'),
        (_brakes_without_a_command, 'event', 'nothing was commanded to van1'),
        (_trigger_without_action, 'event', 'trigger claimed, but no action'),
        (_release_of_a_stranger, 'event', 'an agent that does not take part'),
        (_release_without_a_command, 'event', 'release claimed, but nothing was commanded'),
        (_message_of_no_event, 'message', 'no event that sends a message'),
        (_message_over_another_link, 'message', 'sends no message over this link'),
        (_end_too_early, 'end', 'the record goes to'),
        (_end_twice, 'end', 'a second time'),
        (_horizon_too_early, 'end', 'horizon claimed at'),
        (_finished_in_the_air, 'end', 'was not over yet'),
        (_outcome_of_its_own, 'end', 'unknown outcome'),
    ],
)
def test_a_false_claim_is_found(
    tb: ModuleType, forge: Callable[[Any], None], kind: str, text: str
) -> None:
    case = tb.tailgate_case()
    forge(case)
    verdict = tb.judge(case)
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert any(f.kind == kind and text in f.text for f in verdict.cross_check), [
        (f.kind, f.text) for f in verdict.cross_check
    ]


def test_what_waits_for_another_event_may_be_triggered_without_an_action(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    _trigger_without_action(case)
    (braking,) = case.spec.events
    never = {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': tb.number(99.0)}
    changes = {
        'events': (braking, {'id': 'e2', 'trigger': never}),
        'orders': ({'id': 'o1', 'first': 'e2', 'then': braking.id},),
    }
    case.spec = tb.spec(**dict(case.spec) | changes)
    verdict = tb.judge(case)
    assert not [f.text for f in verdict.cross_check if 'no action' in f.text]
    # That it never came about is a matter of the conditions.
    assert not tb.result(verdict, 'o1.holds').satisfied


@pytest.mark.parametrize(
    ('lost', 'drop', 'text'),
    [
        (1, LinkEventKind.ATTEMPT_PASSED, 'attempt 1 was due at tick'),
        (0, LinkEventKind.ATTEMPT_PASSED, 'attempt 0 was due at tick'),
    ],
)
def test_a_missing_attempt_is_found(
    tb: ModuleType, lost: int, drop: LinkEventKind, text: str
) -> None:
    case = tb.tailgate_case(lost=lost)
    case.run.links[:] = [
        r for r in case.run.links if r.kind not in (drop, LinkEventKind.DELIVERED)
    ]
    assert any(text in f.text for f in tb.judge(case).cross_check)


def test_a_receipt_is_recorded_once_and_attempts_are_counted(tb: ModuleType) -> None:
    case = tb.tailgate_case(lost=1)
    case.run.links.append(case.run.links[-1])
    case.run.links[1] = replace(case.run.links[1], attempt=3)
    texts = ' '.join(f.text for f in tb.judge(case).cross_check)
    assert 'DELIVERED of this message a second time' in texts
    assert 'attempt 0 is numbered 3' in texts
