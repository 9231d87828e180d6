# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What to try next after a violated verdict: the escalation of bounded local repair.

Source: paper, "Bounded local repair".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import (
    Anchor,
    Attempt,
    AttemptOutcome,
    Implicated,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.localize import localize
from aurora_core.repair.settings import RepairSettings
from aurora_core.repair.values import one_parameter, searched


def propose(
    agsg: Agsg, verdict: Verdict, past: Sequence[Attempt], settings: RepairSettings
) -> Proposal:
    """Return what to try next.

    What most speaks for comes first: a place is changed by going back to grounding, a value by one
    parameter and, when several single ones were of no avail, by several at once.

    Args:
        agsg: The best realisation so far, grounded.
        verdict: Of its trace.
        past: Everything that was tried, the first realisation included, in order.
        settings: How it is searched.
    """
    implicated = localize(agsg, verdict)
    if not implicated:
        return Proposal(
            outcome=ProposalOutcome.OUT_OF_SCOPE,
            reason='nothing that the request leaves open affects what does not hold',
        )
    for proposal in _candidates(agsg, implicated, past, settings):
        if not any(_same(proposal.plan, attempt.plan) for attempt in past[1:]):
            return proposal
    return Proposal(
        outcome=ProposalOutcome.EXHAUSTED,
        implicated=implicated,
        reason='everything that could help was tried',
    )


def _same(plan: RepairPlan, other: RepairPlan) -> bool:
    return plan == other


def _candidates(
    agsg: Agsg,
    implicated: tuple[Implicated, ...],
    past: Sequence[Attempt],
    settings: RepairSettings,
) -> Iterator[Proposal]:
    """Yield proposals, the best one first; those that were made already are among them."""
    singles = [a for a in past if a.step is Step.ONE and a.simulated]
    if len(singles) >= settings.singles:
        yield from searched(agsg, implicated, past, settings)
    for item in implicated:
        if item.field == ANCHOR:
            yield from _elsewhere(agsg, item, implicated, past)
        else:
            yield from one_parameter(agsg, item, implicated, past, settings)


def _elsewhere(
    agsg: Agsg, item: Implicated, implicated: tuple[Implicated, ...], past: Sequence[Attempt]
) -> Iterator[Proposal]:
    """Go back to grounding, without the places where the scene was tried."""
    places = [a.anchor for a in past if a.anchor is not None]
    lanes = ', '.join(dict.fromkeys(place.lane for place in places))
    grounded = agsg.grounding
    values = () if grounded is None or grounded.repair is None else grounded.repair.values
    none_left = {
        any(place.whole_road for place in a.plan.avoided)
        for a in past
        if a.step is Step.GROUNDING and a.outcome is AttemptOutcome.NO_PLACE
    }
    for whole_road, where in ((True, 'on another road than'), (False, 'not near')):
        if whole_road in none_left:
            continue
        avoided = dict.fromkeys(
            Anchor(lane=p.lane, position_m=p.position_m, whole_road=whole_road) for p in places
        )
        yield Proposal(
            outcome=ProposalOutcome.EDITED,
            step=Step.GROUNDING,
            plan=RepairPlan(avoided=tuple(avoided), values=values),
            implicated=implicated,
            reason=f'{item.reason}; the scene is put {where} {lanes}',
        )
