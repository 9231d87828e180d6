# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is remembered of the attempts of a run, and how they are told in its report."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from aurora_core.document import canonical_json
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import (
    Anchor,
    Attempt,
    AttemptOutcome,
    Proposal,
    RepairPlan,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.repair.attempts import anchor_of, judged_attempt
from aurora_core.repair.displaced import still_displaced
from aurora_core.repair.localize import localize
from aurora_core.repair.lock import changes_of_the_request
from aurora_core.repair.neighbourhood import outside
from aurora_core.repair.unshown import never_shown
from aurora_core.report.facts import ExecutionFacts
from aurora_core.report.run_report import ChangeKind, EditReport, MarginChange, RepairReport
from aurora_core.spec.parameter import Provenance

_ANCHOR = 'grounding/anchor'
_SHOWN = 5
_DIGITS = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class Realisation:
    """A request as it was grounded, executed and judged.

    Attributes:
        attempt: What repair remembers of it.
        grounding: What it was executed from.
        execution: What was left behind.
        verdict: Of its trace.
        engine: Who executed it.
    """

    attempt: Attempt
    grounding: GroundingOutcome
    execution: ExecutionFacts
    verdict: Verdict
    engine: str

    @property
    def graph(self) -> Agsg:
        """The graph that was executed."""
        assert self.grounding.agsg is not None  # it was executed
        return self.grounding.agsg


def best_of(made: Sequence[Realisation], engine: str) -> Realisation:
    """Return the best realisation; among equals one of the run's engine, then the earliest."""
    return max(made, key=lambda r: (r.attempt.rank, r.engine == engine))


def realised(
    iteration: int, grounding: GroundingOutcome, verdict: Verdict, proposal: Proposal | None = None
) -> Attempt:
    """Return what is remembered of a realisation that was judged."""
    grounded = grounding.agsg.grounding if grounding.agsg is not None else None
    return judged_attempt(iteration, verdict).model_copy(
        update={
            'step': None if proposal is None else proposal.step,
            'plan': RepairPlan() if proposal is None else proposal.plan,
            'anchor': None if grounded is None else anchor_of(grounded),
            'scene': '' if grounded is None else scene_digest(grounded),
            'predicted': {} if proposal is None else proposal.predicted,
        }
    )


def why_not(
    iteration: int,
    proposal: Proposal,
    grounding: GroundingOutcome,
    first: GroundingOutcome,
    best: Realisation,
    past: Sequence[Attempt],
    network: RoadNetwork,
) -> tuple[Attempt, str] | None:
    """Return why a grounded proposal is not worth or not allowed a simulation, None when it is.

    Args:
        iteration: That it would be.
        proposal: What was proposed.
        grounding: What came of it.
        first: Of the first realisation, by whose conditions every other one is judged as well.
        best: The realisation that it was proposed after. Its neighbourhood is worked out anew:
            whoever proposes does not say how far he may go.
        past: Everything that was tried.
        network: Roads of the map.
    """
    graph = grounding.agsg
    if graph is None or graph.grounding is None or first.agsg is None:
        reason = 'no place' if grounding.failure is None else grounding.failure.reason
        return (
            _not_simulated(iteration, proposal, AttemptOutcome.NO_PLACE, None),
            f'there is no such place on the map ({reason})',
        )
    for change in changes_of_the_request(first.agsg, graph, first, grounding):
        return (
            _not_simulated(iteration, proposal, AttemptOutcome.REFUSED, graph.grounding),
            f'the request would be judged otherwise: {change}',
        )
    admissible = {item.field for item in localize(best.graph, best.verdict)}
    for change in outside(best.graph, graph, admissible):
        return (
            _not_simulated(iteration, proposal, AttemptOutcome.REFUSED, graph.grounding),
            f'it would change more than it says: {change}',
        )
    if scene_digest(graph.grounding) in {attempt.scene for attempt in past}:
        return (
            _not_simulated(iteration, proposal, AttemptOutcome.SAME_SCENE, graph.grounding),
            'it gives a scene that was tried already',
        )
    for told in still_displaced(best.graph, best.verdict, graph):
        return (
            _not_simulated(iteration, proposal, AttemptOutcome.DISPLACED, graph.grounding),
            told,
        )
    for told in never_shown(best.verdict, graph, network):
        return (
            _not_simulated(iteration, proposal, AttemptOutcome.UNSHOWN, graph.grounding),
            told,
        )
    return None


def _not_simulated(
    iteration: int,
    proposal: Proposal,
    outcome: AttemptOutcome,
    grounded: GroundedScenario | None,
) -> Attempt:
    return Attempt(
        iteration=iteration,
        step=proposal.step,
        plan=proposal.plan,
        outcome=outcome,
        anchor=None if grounded is None else anchor_of(grounded),
        scene='' if grounded is None else scene_digest(grounded),
    )


def to_fit(proposal: Proposal, outcome: GroundingOutcome) -> RepairReport:
    """Return how a revision is told that was made because the request had no place."""
    agsg = outcome.agsg
    anchor = None if agsg is None or agsg.grounding is None else anchor_of(agsg.grounding)
    found = AttemptOutcome.NO_PLACE if anchor is None else AttemptOutcome.PLACED
    attempt = Attempt(
        iteration=0, step=proposal.step, plan=proposal.plan, outcome=found, anchor=anchor
    )
    return repair_report(proposal, attempt, None)


def nothing_left(iteration: int, proposal: Proposal) -> RepairReport:
    """Return how it is told that nothing is proposed."""
    return RepairReport(
        iteration=iteration,
        kind='',
        reason=proposal.reason,
        outcome=proposal.outcome.value,
        implicated=proposal.implicated[:_SHOWN],
    )


def scene_digest(grounded: GroundedScenario) -> str:
    """Return the digest (hex) of all that is executed of a grounding."""
    names = {'agents', 'uavs', 'wind_mean_east_mps', 'wind_mean_north_mps'}
    text = canonical_json(grounded.model_dump(mode='json', include=names))
    return hashlib.sha256(text.encode('utf-8')).hexdigest()


def repair_report(
    proposal: Proposal, attempt: Attempt, best: Realisation | None, note: str = ''
) -> RepairReport:
    """Return how an attempt is told.

    Args:
        proposal: What was tried.
        attempt: What came of it.
        best: The realisation that the proposal was made after.
        note: Why nothing was simulated.
    """
    ids = dict.fromkeys((*proposal.predicted, *attempt.margins))
    before = None if best is None else best.graph.grounding
    margins = {} if best is None else best.attempt.margins
    return RepairReport(
        iteration=attempt.iteration,
        kind='' if proposal.step is None else proposal.step.value,
        edits=tuple(_edits(proposal, attempt, before)),
        margins=tuple(
            MarginChange(
                condition=name,
                before=margins.get(name),
                predicted=proposal.predicted.get(name),
                realised=attempt.margins.get(name),
            )
            for name in ids
        ),
        reason=note or proposal.reason,
        outcome=attempt.outcome.value,
        bag=f'bag.{attempt.iteration}' if attempt.simulated else None,
        implicated=proposal.implicated[:_SHOWN],
    )


def confirmation(candidate: Realisation, done: Realisation) -> RepairReport:
    """Return how it is told that the engine of the run executed a candidate again.

    Args:
        candidate: As another engine executed it.
        done: The same graph in the engine of the run.
    """
    name, again = candidate.execution.bag, done.execution.trace_sha256
    recorded = candidate.execution.trace_sha256
    is_same = again == recorded
    came = (
        f'gave the same trace as the {candidate.engine} one'
        if is_same
        else f'gave another trace than the {candidate.engine} one ({again[:_DIGITS]} instead of '
        f'{recorded[:_DIGITS]}), whose recordings count for nothing'
    )
    margins = {**candidate.attempt.margins, **done.attempt.margins}
    return RepairReport(
        iteration=done.attempt.iteration,
        kind='',
        margins=tuple(
            MarginChange(
                condition=condition,
                before=candidate.attempt.margins.get(condition),
                realised=done.attempt.margins.get(condition),
            )
            for condition in margins
        ),
        reason=f'the engine {done.engine} executed {name} again and {came}',
        outcome=done.attempt.outcome.value,
        bag=done.execution.bag,
        confirms=candidate.attempt.iteration,
    )


def _edits(
    proposal: Proposal, attempt: Attempt, before: GroundedScenario | None
) -> Iterator[EditReport]:
    if attempt.anchor is not None and before is not None:
        old = anchor_of(before)
        if old != attempt.anchor:
            yield EditReport(
                path=_ANCHOR,
                old=_place(old),
                new=_place(attempt.anchor),
                provenance=Provenance.INFERRED,
                change=ChangeKind.REALIZATION,
            )
    earlier = before.repair.values if before is not None and before.repair is not None else ()
    known = {edit.path: edit.realised for edit in earlier}
    for edit in proposal.plan.values:
        was = known.get(edit.path, edit.requested)
        if was != edit.realised:
            yield EditReport(
                path=edit.path,
                old=was,
                new=edit.realised,
                provenance=edit.provenance,
                change=ChangeKind.REALIZATION,
            )


def _place(anchor: Anchor) -> str:
    return f'{anchor.lane} at {anchor.position_m:.1f} m'
