# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The stages as plain functions: called by the local engine, and by each ROS node for its own."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.agsg.build import build_agsg
from aurora_core.errors import SpecError
from aurora_core.execution.faults import Fault
from aurora_core.execution.plan import Execution, build_execution
from aurora_core.feasibility.check import check_request
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.feasibility import CheckStage, FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.outcomes.repair import (
    Attempt,
    Proposal,
    ProposalOutcome,
    RepairPlan,
    Step,
    with_values,
)
from aurora_core.outcomes.verdict import Verdict
from aurora_core.parsing.landmarks import is_plain_word, landmark_words
from aurora_core.parsing.parser import parse_offline
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.planned import plan_conditions
from aurora_core.pipeline.reading import parser_digest
from aurora_core.planning.complete import complete
from aurora_core.ports.language_model import LanguageModel
from aurora_core.quantities.view import RunView
from aurora_core.repair.guarded import guarded_revision
from aurora_core.repair.lock import locked_edits
from aurora_core.repair.propose import plans_elsewhere, propose
from aurora_core.repair.realise import repaired
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.retarget import retargeted
from aurora_core.temporal.schedule import plan_time
from aurora_core.trace.bag_content import BagContent


def parse_context(known: Knowledge, map_name: str, seed: int) -> ParseContext:
    """Return the map as prompts are read against it."""
    model = known.map(map_name)
    grounds = [m for m in model.grounds if not is_plain_word(landmark_words(m.name))]
    marks = (*model.landmarks, *grounds)
    return ParseContext(
        map_name=map_name,
        landmark_names=tuple(mark.name for mark in marks),
        landmark_kinds=tuple(mark.kind for mark in marks),
        grounds=len(grounds),
        seed=seed,
    )


def parse_stage(known: Knowledge, prompt: str, map_name: str, seed: int) -> ParseOutcome:
    """Read a prompt against a map, with the offline parser, and complete it; see `understood`."""
    outcome = parse_offline(prompt, parse_context(known, map_name, seed))
    return understood(known, outcome, reader=parser_digest())


def understood(known: Knowledge, outcome: ParseOutcome, *, reader: str = '') -> ParseOutcome:
    """Return what a reader made of a prompt, with the graph of the completed request.

    Whoever read the prompt, every UAV has a mission from here on.

    Args:
        known: What is installed here.
        outcome: Of the reader.
        reader: Digest of the offline parser, when that was it.
    """
    if outcome.spec is None:
        return outcome
    spec = complete(outcome.spec, known.limits).model_copy(update={'reader': reader})
    graph = build_agsg(spec, map_digest=known.map(spec.world.map_name).digest)
    fields = {name: getattr(outcome, name) for name in ParseOutcome.model_fields}
    return ParseOutcome(**{**fields, 'agsg': graph})


def check_stage(
    known: Knowledge, agsg: Agsg, without: frozenset[CheckStage] = frozenset()
) -> FeasibilityVerdict:
    """Judge feasibility of a request against limits, tolerances and its map.

    Args:
        known: What is installed here.
        agsg: The request.
        without: Stages that are left out, for a benchmark that asks what they are worth.
    """
    spec = agsg.spec
    map_model = known.map(spec.world.map_name)
    return check_request(
        spec, map_model, known.limits, known.tolerances, known.types, without, known.uav
    )


def ground_stage(
    known: Knowledge, agsg: Agsg, seed: int, plan: RepairPlan | None = None
) -> GroundingOutcome:
    """Ground a graph: places, routes, schedule, conditions.

    Args:
        known: What is installed here.
        agsg: Graph of the request.
        seed: Of the run.
        plan: How it is to be realised otherwise than at first; None: the first time.

    Raises:
        SpecError: The plan would change what is locked.
    """
    spec = agsg.spec
    for why in () if plan is None else locked_edits(agsg, plan):
        raise SpecError(f'the request cannot be realised so: {why}')
    asked = spec if plan is None else with_values(spec, plan.values)
    grounded = known.grounder(spec.world.map_name).ground(asked, seed, plan)
    if isinstance(grounded, GroundingFailure):
        return GroundingOutcome(failure=grounded)
    if plan is not None:
        grounded = repaired(grounded, plan)
    grounded = retargeted(asked, grounded, known.limits)
    schedule = plan_time(asked, grounded, known.limits, known.tolerances)
    planned = plan_conditions(spec, grounded, schedule, known.limits, known.tolerances)
    graph = build_agsg(
        spec,
        map_digest=known.map(spec.world.map_name).digest,
        stage=Stage.GROUNDED if plan is None else Stage.REPAIRED,
        iteration=agsg.iteration,
        grounding=grounded,
        schedule=schedule,
        conditions=planned.conditions,
    )
    return GroundingOutcome(agsg=graph, unsupported=planned.missing, unjudged=planned.unjudged)


def execution_stage(
    known: Knowledge, agsg: Agsg, seed: int, faults: tuple[Fault, ...]
) -> Execution:
    """Build the execution of a grounded graph."""
    return build_execution(
        agsg,
        known.map(agsg.map_name),
        limits=known.limits,
        tolerances=known.tolerances,
        settings=known.settings,
        seed=seed,
        faults=faults,
        parts=known.parts(agsg.map_name),
    )


def repair_stage(
    known: Knowledge,
    agsg: Agsg,
    verdict: Verdict,
    past: tuple[Attempt, ...],
    content: BagContent | None = None,
) -> Proposal:
    """Propose what to try after a violated verdict; see `repair.propose`.

    Args:
        known: What is installed here.
        agsg: The best realisation so far.
        verdict: Of its trace.
        past: Everything that was tried, in order.
        content: Its recording; None: edits are proposed without a replay of it.
    """
    view = None if content is None else RunView(content.trace, content.world)
    if view is not None and view.first_missing_tick is not None:
        view = None
    return propose(agsg, verdict, past, known.repair, view)


def revision_stage(
    known: Knowledge,
    agsg: Agsg,
    past: tuple[Attempt, ...],
    proposal: Proposal,
    models: Sequence[LanguageModel],
    attempts: int,
) -> Proposal:
    """Let models revise what rules would revise; the rules stand where no answer is taken.

    Args:
        known: What is installed here.
        agsg: The best realisation so far.
        past: Everything that was tried, in order.
        proposal: Of `repair_stage`.
        models: In the order in which they are asked.
        attempts: Most calls to one model.
    """
    is_spent = proposal.outcome is ProposalOutcome.EXHAUSTED
    if not (is_spent or proposal.step is Step.SYMBOLIC) or not proposal.implicated:
        return proposal

    def refused(spec: ScenarioSpec) -> str:
        verdict = check_stage(known, build_agsg(spec))
        return ' '.join(certificate.sentence for certificate in verdict.certificates)

    elsewhere = next(plans_elsewhere(agsg, proposal.implicated, past), None)
    plan, because, calls = guarded_revision(
        agsg, proposal.implicated, elsewhere, refused, models, attempts
    )
    if plan is None or plan in [attempt.plan for attempt in past]:
        return proposal.model_copy(update={'model_calls': calls})
    return Proposal(
        outcome=ProposalOutcome.EDITED,
        step=Step.SYMBOLIC,
        plan=plan,
        implicated=proposal.implicated,
        reason=f'{calls[-1].model} proposes: {because}',
        model_calls=calls,
    )
