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
from aurora_core.quantities.view import RunView
from aurora_core.repair.attempts import anchor_of, judged_attempt
from aurora_core.repair.beyond import beyond_repair
from aurora_core.repair.foresee import Foresight
from aurora_core.repair.helps import ANCHOR
from aurora_core.repair.localize import localize
from aurora_core.repair.realised_values import here_of
from aurora_core.repair.revise import revised
from aurora_core.repair.settings import RepairSettings
from aurora_core.repair.surrogate.replay import Replay
from aurora_core.repair.values import moved_values, one_parameter, plan_with, searched

# What was of no avail speaks for a field so much less.
_LESS = 0.5
# Steps that put the scene elsewhere.
_AWAY = (Step.GROUNDING, Step.SYMBOLIC)


def propose(
    agsg: Agsg,
    verdict: Verdict,
    past: Sequence[Attempt],
    settings: RepairSettings,
    view: RunView | None = None,
) -> Proposal:
    """Return what to try next.

    An edit after which everything is expected to hold comes first. Then what most speaks for: a
    place is changed by going back to grounding, a value by one parameter and, when several single
    ones were of no avail, by several at once. What was of no avail, or is expected to fail, speaks
    less for its field. When nothing was of avail, several fields are revised at another place.

    Args:
        agsg: The best realisation so far, grounded.
        verdict: Of its trace.
        past: Everything that was tried, the first realisation included, in order; empty: nothing
            beside the realisation.
        settings: How it is searched.
        view: What was recorded of that realisation; None: nothing is foreseen.
    """
    if not past and agsg.grounding is not None:
        first = judged_attempt(agsg.iteration, verdict)
        past = (first.model_copy(update={'anchor': anchor_of(agsg.grounding)}),)
    locked = beyond_repair(agsg, verdict)
    if locked:
        told = ', '.join(item.field for item in locked)
        return Proposal(
            outcome=ProposalOutcome.OUT_OF_SCOPE,
            implicated=locked,
            reason=f'{locked[0].reason}; {told} is locked, so no other realisation mends that',
        )
    implicated = localize(agsg, verdict, past[0].learned if past else {}, view)
    if not implicated:
        return Proposal(
            outcome=ProposalOutcome.OUT_OF_SCOPE,
            reason='nothing that the request leaves open affects what does not hold',
        )
    foresight = None
    if view is not None and settings.surrogate.candidates:
        replay = Replay(view, agsg, verdict, past, settings.surrogate)
        foresight = Foresight(replay, agsg, implicated, verdict, settings)
    tried = [attempt.plan for attempt in past[1:]]
    for proposal in _ordered(agsg, implicated, past, settings, foresight):
        if proposal.plan in tried or proposal.step not in settings.escalation:
            continue
        if foresight is None or proposal.step in _AWAY or proposal.predicted:
            return proposal
        values = moved_values(agsg, proposal.plan)
        return proposal.model_copy(update={'predicted': foresight.predicted(values)})
    return Proposal(
        outcome=ProposalOutcome.EXHAUSTED,
        implicated=implicated,
        reason='everything that could help was tried',
    )


def _ordered(
    agsg: Agsg,
    implicated: tuple[Implicated, ...],
    past: Sequence[Attempt],
    settings: RepairSettings,
    foresight: Foresight | None,
) -> Iterator[Proposal]:
    """Yield what is foreseen to hold, then all else."""
    if foresight is not None:
        for choice in foresight.choices():
            told = ', '.join(f'{path} to {value:.4g}' for path, value in choice.values.items())
            reason = _reason(implicated, tuple(choice.values))
            yield Proposal(
                outcome=ProposalOutcome.EDITED,
                step=Step.ONE if len(choice.values) == 1 else Step.SEARCH,
                plan=plan_with(agsg, choice.values),
                implicated=implicated,
                predicted=choice.predicted,
                reason=(
                    f'{reason}; replayed with {told} everything that the replay has a model of '
                    f'holds (equation 5: {choice.value:.3g})'
                ),
            )
    yield from _candidates(agsg, implicated, past, settings, foresight)


def _reason(implicated: Sequence[Implicated], fields: Sequence[str]) -> str:
    return next((item.reason for item in implicated if item.field in fields), '')


def _candidates(
    agsg: Agsg,
    implicated: tuple[Implicated, ...],
    past: Sequence[Attempt],
    settings: RepairSettings,
    foresight: Foresight | None,
) -> Iterator[Proposal]:
    """Yield proposals, the best one first; those that were made already are among them."""
    yield from _moved_along(implicated, past)
    if sum(1 for _ in _of_no_avail(past)) >= settings.in_vain:
        yield from _symbolic(agsg, implicated, past, settings)
    singles = [a for a in past if a.step is Step.ONE and a.simulated]
    if len(singles) >= settings.singles:
        yield from searched(agsg, implicated, past, settings)
    found: list[tuple[float, list[Proposal]]] = []
    for item in implicated:
        score = item.score * _LESS ** _tries(item, past)
        if item.field == ANCHOR:
            found.append((score, list(_elsewhere(agsg, item, implicated, past))))
            continue
        own = list(one_parameter(agsg, item, implicated, past, settings))
        failing = [p for p in own if _fails(agsg, p, foresight)]
        if failing:
            found.append((score * _LESS, failing))
        found.append((score, [p for p in own if p not in failing]))
    found.sort(key=lambda row: -row[0])
    for _, proposals in found:
        yield from proposals
    yield from _symbolic(agsg, implicated, past, settings)


def _moved_along(
    implicated: tuple[Implicated, ...], past: Sequence[Attempt]
) -> Iterator[Proposal]:
    """Yield the last edit at any other place, where its own has no room for it."""
    last = past[-1] if past else None
    if last is None or last.outcome is not AttemptOutcome.NO_PLACE or last.plan.kept is None:
        return
    if any(item.field == ANCHOR for item in implicated):
        told = ', '.join(f'{edit.path} to {edit.realised:.4g}' for edit in last.plan.values)
        yield Proposal(
            outcome=ProposalOutcome.EDITED,
            step=Step.SYMBOLIC,
            plan=last.plan.model_copy(update={'kept': None}),
            implicated=implicated,
            reason=f'at its place there is no room for {told}; the scene goes along',
        )


def _symbolic(
    agsg: Agsg,
    implicated: tuple[Implicated, ...],
    past: Sequence[Attempt],
    settings: RepairSettings,
) -> Iterator[Proposal]:
    """Revise several fields at another place than those that were tried."""
    here = {row.path: here_of(row, agsg) for row in agsg.parameters}
    for plan in plans_elsewhere(agsg, implicated, past):
        yield from revised(agsg, implicated, here, plan, settings)


def plans_elsewhere(
    agsg: Agsg, implicated: Sequence[Implicated], past: Sequence[Attempt]
) -> Iterator[RepairPlan]:
    """Yield plans that lead to places that were not tried, where the place can be at fault.

    Args:
        agsg: The best realisation so far.
        implicated: The localization.
        past: Everything that was tried, in order.
    """
    place = next((item for item in implicated if item.field == ANCHOR), None)
    if place is not None:
        for proposal in _elsewhere(agsg, place, tuple(implicated), past):
            yield proposal.plan


def _fails(agsg: Agsg, proposal: Proposal, foresight: Foresight | None) -> bool:
    """Tell whether an edit is foreseen to fail beyond the error of the replay."""
    return foresight is not None and foresight.fails(moved_values(agsg, proposal.plan))


def _tries(item: Implicated, past: Sequence[Attempt]) -> int:
    """Return how often a field was realised otherwise, and nothing became better by it."""
    made = [attempt for attempt in _of_no_avail(past) if attempt.step is not None]
    if item.field == ANCHOR:
        return sum(attempt.step in _AWAY for attempt in made)
    # Who goes to another place keeps what was moved before: that is no try of it.
    moved = [attempt.plan.values for attempt in made if attempt.step not in _AWAY]
    return sum(item.field in {edit.path for edit in values} for values in moved)


def _of_no_avail(past: Sequence[Attempt]) -> Iterator[Attempt]:
    """Yield the simulated attempts that are no better than all before them."""
    best: tuple[int, int, float] | None = None
    for attempt in past:
        if not attempt.simulated:
            continue
        if best is None or attempt.rank > best:
            best = attempt.rank
        else:
            yield attempt


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
