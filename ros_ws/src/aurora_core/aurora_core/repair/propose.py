# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What to try next after a violated verdict: the escalation of bounded local repair.

Source: paper, "Bounded local repair".
"""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import (
    Attempt,
    AttemptOutcome,
    AvoidedAnchor,
    Implicated,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.localize import localize


def propose(agsg: Agsg, verdict: Verdict, past: Sequence[Attempt]) -> Proposal:
    """Return what to try next.

    Args:
        agsg: The best realisation so far, grounded.
        verdict: Of its trace.
        past: Everything that was tried, the first realisation included, in order.
    """
    implicated = localize(agsg, verdict)
    if not implicated:
        return Proposal(
            outcome=ProposalOutcome.OUT_OF_SCOPE,
            reason='nothing that the request leaves open affects what does not hold',
        )
    for item in implicated:
        if item.field == ANCHOR:
            return _elsewhere(agsg, item, implicated, past)
    return Proposal(
        outcome=ProposalOutcome.EXHAUSTED,
        implicated=implicated,
        reason='everything that could help was tried',
    )


def _elsewhere(
    agsg: Agsg, item: Implicated, implicated: tuple[Implicated, ...], past: Sequence[Attempt]
) -> Proposal:
    """Return to grounding, without the places where the scene was tried."""
    narrow = any(a.outcome is AttemptOutcome.NO_PLACE for a in past)
    if past and past[-1].outcome is AttemptOutcome.NO_PLACE and _is_narrow(past[-1].plan):
        return Proposal(
            outcome=ProposalOutcome.EXHAUSTED,
            implicated=implicated,
            reason='the map has no other place for the scene',
        )
    places = [a.anchor for a in past if a.anchor is not None]
    avoided = tuple(
        AvoidedAnchor(lane=p.lane, position_m=p.position_m, whole_road=not narrow) for p in places
    )
    values = (
        ()
        if agsg.grounding is None or agsg.grounding.repair is None
        else (agsg.grounding.repair.values)
    )
    where = 'not near' if narrow else 'on another road than'
    lanes = ', '.join(dict.fromkeys(place.lane for place in places))
    return Proposal(
        outcome=ProposalOutcome.EDITED,
        step=Step.GROUNDING,
        plan=RepairPlan(avoided=avoided, values=values),
        implicated=implicated,
        reason=f'{item.reason}; the scene is put {where} {lanes}',
    )


def _is_narrow(plan: RepairPlan) -> bool:
    return bool(plan.avoided) and not any(place.whole_road for place in plan.avoided)
