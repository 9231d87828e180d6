# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A model that revises: whatever it answers, only what is open moves, or nothing."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import (
    Anchor,
    Attempt,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.functions import revision_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.ports.language_model import (
    FailureKind,
    ModelFailure,
    ModelReply,
    ModelRequest,
)
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.localize import localize

_KNOWN = installed_knowledge()
ALTITUDE = 'missions/m1/altitude_m'
Failing = Callable[..., Verdict]


class Model:
    """Answers with what it was given, in order."""

    name = 'told'

    def __init__(self, *answers: Any) -> None:
        self.answers = list(answers)
        self.asked: list[ModelRequest] = []

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        self.asked.append(request)
        answer = self.answers.pop(0)
        if isinstance(answer, ModelFailure):
            return answer
        return ModelReply(text=answer if isinstance(answer, str) else json.dumps(answer))


def revision(*fields: tuple[str, float | None], because: str = 'it is so') -> dict[str, Any]:
    return {'fields': [{'field': f, 'value': v} for f, v in fields], 'because': because}


@pytest.fixture
def asked(agsg: Agsg, failing: Failing) -> Callable[..., Proposal]:
    """Let a model revise after everything was tried by rules."""
    implicated = localize(agsg, failing(m1__visible=-0.4))
    spent = Proposal(
        outcome=ProposalOutcome.EXHAUSTED, implicated=implicated, reason='all was tried'
    )
    assert agsg.grounding is not None
    anchor = Anchor(lane=agsg.grounding.anchor_lane, position_m=agsg.grounding.anchor_position_m)
    first = Attempt.model_validate({'iteration': 0, 'outcome': 'violated', 'anchor': anchor})

    def ask(model: Model, attempts: int = 2) -> Proposal:
        return revision_stage(_KNOWN, agsg, (first,), spent, [model], attempts)

    return ask


def test_what_a_model_proposes_becomes_a_plan(asked: Callable[..., Proposal]) -> None:
    found = asked(Model(revision((ALTITUDE, 60.0), (ANCHOR, None))))
    assert (found.outcome, found.step) == (ProposalOutcome.EDITED, Step.SYMBOLIC)
    assert [(e.path, e.realised) for e in found.plan.values] == [(ALTITUDE, 60.0)]
    assert found.plan.avoided
    assert len(found.model_calls) == 1


@pytest.mark.parametrize(
    ('answer', 'why'),
    [
        (revision(('missions/m1/duration_s', 5.0)), 'is not among the fields'),
        (revision(('events/e1/trigger/value_m', 90.0)), 'is not among the fields'),
        (revision((ALTITUDE, 500.0)), 'is outside'),
        (revision((ALTITUDE, None)), 'needs a value'),
        (revision((ALTITUDE, 50.0), (ALTITUDE, 60.0)), 'is named twice'),
        (revision(*[(f'missions/m1/x{k}', 1.0) for k in range(7)]), 'at most 6'),
        (revision(), 'at least 1'),
        ({'fields': [{'field': ALTITUDE, 'value': 50.0}], 'because': '', 'seed': 7}, 'seed'),
        ('rm -rf /', 'one JSON object'),
    ],
)
def test_what_is_not_allowed_goes_back_with_the_reason_and_changes_nothing(
    asked: Callable[..., Proposal], answer: Any, why: str
) -> None:
    model = Model(answer, revision((ALTITUDE, 60.0)))
    found = asked(model)
    assert [(e.path, e.realised) for e in found.plan.values] == [(ALTITUDE, 60.0)]
    assert why in model.asked[1].messages[-1].content
    assert why in ' '.join(found.model_calls[0].complaints)
    alone = asked(Model(answer), attempts=1)
    assert (alone.outcome, alone.plan) == (ProposalOutcome.EXHAUSTED, RepairPlan())


def test_without_an_answer_the_rules_stand_and_every_call_is_kept(
    asked: Callable[..., Proposal],
) -> None:
    failure = ModelFailure(kind=FailureKind.TIMEOUT, message='no answer')
    found = asked(Model(failure, failure))
    assert found.outcome is ProposalOutcome.EXHAUSTED
    assert [call.failure for call in found.model_calls] == [failure, failure]


def test_a_model_is_not_asked_while_the_evidence_leads_on(agsg: Agsg) -> None:
    model = Model()
    single = Proposal(outcome=ProposalOutcome.EDITED, step=Step.ONE, reason='evidence')
    assert revision_stage(_KNOWN, agsg, (), single, [model], 2) is single
    assert model.asked == []
