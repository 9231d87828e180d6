# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A request whose realisation is revised by a language model: what is open, and what is not."""

from __future__ import annotations

from functools import cache

from aurora_bench.trust.documents import PROMPT
from aurora_cli.installed import installed
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import (
    Anchor,
    Attempt,
    Implicated,
    Proposal,
    ProposalOutcome,
)
from aurora_core.pipeline.functions import ground_stage, parse_stage, revision_stage
from aurora_core.ports.language_model import LanguageModel
from aurora_core.repair.lock import is_movable

# What the prompt leaves open and repair holds to be at fault.
OPEN_FIELD = 'missions/m1/altitude_m'


@cache
def scene() -> Agsg:
    """Return the grounded graph of the request."""
    known = installed()
    parsed = parse_stage(known, PROMPT, 'downtown', 1).agsg
    assert parsed is not None
    grounded = ground_stage(known, parsed, 1).agsg
    assert grounded is not None
    assert any(row.path == OPEN_FIELD and is_movable(row) for row in grounded.parameters)
    return grounded


def revise(model: LanguageModel, attempts: int, *, order: str = '') -> Proposal:
    """Let a model revise after everything was tried by rules.

    Args:
        model: Is asked.
        attempts: Most calls.
        order: Stands in the prompt and in what was found to be at fault.
    """
    agsg = scene()
    grounding = agsg.grounding
    assert grounding is not None
    if order:
        spec = agsg.spec.model_copy(update={'prompt': f'{agsg.spec.prompt} {order}'})
        agsg = agsg.model_copy(update={'spec': spec})
    implicated = Implicated(
        field=OPEN_FIELD, score=1.0, direction=1, conditions=(), reason=f'not seen {order}'.strip()
    )
    anchor = Anchor(lane=grounding.anchor_lane, position_m=grounding.anchor_position_m)
    first = Attempt.model_validate({'iteration': 0, 'outcome': 'violated', 'anchor': anchor})
    spent = Proposal(
        outcome=ProposalOutcome.EXHAUSTED, implicated=(implicated,), reason='all was tried'
    )
    return revision_stage(installed(), agsg, (first,), spent, [model], attempts)


def problem_of(proposal: Proposal) -> str:
    """Return what a proposal moves that it must not, '' when nothing."""
    low, high = next((row.low, row.high) for row in scene().parameters if row.path == OPEN_FIELD)
    for edit in proposal.plan.values:
        if edit.path != OPEN_FIELD:
            return f'{edit.path} is moved, which is not open'
        if not low <= edit.realised <= high:
            return f'{edit.path} is moved to {edit.realised:g}, outside its domain'
    return ''
