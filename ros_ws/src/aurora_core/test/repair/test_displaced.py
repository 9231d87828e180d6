# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import (
    Anchor,
    AttemptOutcome,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
)
from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.repairing import Realisation, realised, why_not
from aurora_core.repair.displaced import still_displaced
from aurora_core.report.facts import ExecutionFacts
from aurora_core.trace.trace import Integrity

_KNOWN = installed_knowledge()
# No lane lies so far to the right of another one.
PROMPT = 'A bicycle is 12 meters to the right of a bus. The bus drives.'
ASKED, PATH = 'bicycle1.placed.distance', 'agents/bicycle1/placements/0/distance_m'


def _verdict(agsg: Agsg, *failed: str) -> Verdict:
    rows = tuple(
        ConditionResult(
            id=c.id,
            sentence=c.sentence,
            explanation='',
            formula=c.formula,
            op=c.op,
            threshold=c.threshold,
            margin=-7.5 if c.id in failed else 1.0,
            normalised=-7.5 if c.id in failed else 1.0,
            unit=c.unit,
            satisfied=c.id not in failed,
            exercised=True,
            provenance=c.provenance,
        )
        for c in agsg.conditions
    )
    status = VerdictStatus.VIOLATED if failed else VerdictStatus.VERIFIED
    return Verdict(status=status, results=rows, integrity=Integrity.INTACT)


def test_a_place_where_somebody_stands_as_wrong_as_before_is_not_simulated() -> None:
    graph = parse_stage(_KNOWN, PROMPT, 'downtown', 1).agsg
    assert graph is not None
    first = ground_stage(_KNOWN, graph, 1)
    assert first.agsg is not None
    assert first.agsg.grounding is not None
    verdict = _verdict(first.agsg, ASKED)
    here = first.agsg.grounding
    plan = RepairPlan(avoided=(Anchor(lane=here.anchor_lane, position_m=here.anchor_position_m),))
    again = graph.model_copy(update={'iteration': 1})
    other = ground_stage(_KNOWN, again, 1, plan)
    proposal = Proposal(
        outcome=ProposalOutcome.EDITED, step=Step.GROUNDING, plan=plan, reason='elsewhere'
    )
    best = Realisation(
        attempt=realised(0, first, verdict),
        grounding=first,
        execution=ExecutionFacts(bag='', ticks=1, dt_s=1.0, trace_sha256='', motion_sha256=''),
        verdict=verdict,
        engine='local',
    )
    unfit = why_not(
        1, proposal, other, first, best, [best.attempt], _KNOWN.map('downtown').network
    )
    assert unfit is not None
    attempt, why = unfit
    assert attempt.outcome is AttemptOutcome.DISPLACED
    assert not attempt.simulated
    assert f'{PATH} would be 3.5 instead of 12' in why


def test_what_stands_nearer_to_what_is_asked_is_simulated() -> None:
    graph = parse_stage(_KNOWN, PROMPT, 'downtown', 1).agsg
    assert graph is not None
    before = ground_stage(_KNOWN, graph, 1).agsg
    assert before is not None
    nearer = before.model_copy(
        update={
            'parameters': tuple(
                row.model_copy(update={'realised': 11.0}) if row.path == PATH else row
                for row in before.parameters
            )
        }
    )
    assert list(still_displaced(before, _verdict(before, ASKED), nearer)) == []
    # Of what holds nothing is foreseen.
    assert list(still_displaced(before, _verdict(before), before)) == []
