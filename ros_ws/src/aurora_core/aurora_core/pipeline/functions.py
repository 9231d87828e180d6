# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The stages as plain functions: called by the local engine, and by each ROS node for its own."""

from __future__ import annotations

from aurora_core.agsg.build import build_agsg
from aurora_core.execution.faults import Fault
from aurora_core.execution.plan import Execution, build_execution
from aurora_core.feasibility.check import check_request
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.parser import parse_offline
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.planned import plan_conditions
from aurora_core.planning.complete import complete
from aurora_core.temporal.schedule import plan_time
<<<<<<< HEAD
=======
from aurora_core.trace.bag_content import BagContent
>>>>>>> h-latency


def parse_context(known: Knowledge, map_name: str, seed: int) -> ParseContext:
    """Return the map as prompts are read against it."""
    marks = tuple(mark.name for mark in known.map(map_name).landmarks)
    return ParseContext(map_name=map_name, landmark_names=marks, seed=seed)


def parse_stage(known: Knowledge, prompt: str, map_name: str, seed: int) -> ParseOutcome:
    """Read a prompt against a map, with the offline parser, and complete it; see `understood`."""
    return understood(known, parse_offline(prompt, parse_context(known, map_name, seed)))


def understood(known: Knowledge, outcome: ParseOutcome) -> ParseOutcome:
    """Return what a reader made of a prompt, with the graph of the completed request.

    Whoever read the prompt, every UAV has a mission from here on.
    """
    if outcome.spec is None:
        return outcome
    spec = complete(outcome.spec, known.limits)
    graph = build_agsg(spec, map_digest=known.map(spec.world.map_name).digest)
    fields = {name: getattr(outcome, name) for name in ParseOutcome.model_fields}
    return ParseOutcome(**{**fields, 'agsg': graph})


def check_stage(known: Knowledge, agsg: Agsg) -> FeasibilityVerdict:
    """Judge feasibility of a request against limits, tolerances and its map."""
    spec = agsg.spec
    return check_request(
        spec, known.map(spec.world.map_name), known.limits, known.tolerances, known.types
    )


def ground_stage(known: Knowledge, agsg: Agsg, seed: int) -> GroundingOutcome:
    """Ground a graph: places, routes, schedule, conditions."""
    spec = agsg.spec
    grounded = known.grounder(spec.world.map_name).ground(spec, seed)
    if isinstance(grounded, GroundingFailure):
        return GroundingOutcome(failure=grounded)
    schedule = plan_time(spec, grounded, known.limits)
    planned = plan_conditions(spec, grounded, schedule, known.limits, known.tolerances)
    graph = build_agsg(
        spec,
        map_digest=known.map(spec.world.map_name).digest,
        stage=Stage.GROUNDED,
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
<<<<<<< HEAD
=======


def load_bag(bag: Path) -> tuple[BagContent, Agsg]:
    """Read a bag and the graph in it.

    Raises:
        BagError: There is nothing to judge.
        VerificationError: The bag holds no graph.
    """
    # Imported here: a check reads no bag.
    from aurora_core.trace.bag_reader import read_bag
    from aurora_core.trace.definitions import message_definitions

    content = read_bag(bag, message_definitions())
    return content, graph_of(content, str(bag))


def graph_of(content: BagContent, where: str) -> Agsg:
    """Return the graph that a run was recorded with.

    Raises:
        VerificationError: There is none.
    """
    if content.agsg_message is None:
        raise VerificationError(
            f'{where} holds no scenario graph', hint='record /aurora/agsg with the run'
        )
    return graph_from_message(content.agsg_message)


def graph_from_message(message: Any) -> Agsg:
    """Return the graph of an Agsg message.

    Raises:
        SpecError: Its parts do not fit each other.
    """
    return read_agsg(message, derived)


def verify_stage(bag: Path, *, recompute: bool = True) -> Verdict:
    """Recompute every margin from a bag alone; see `verify_content`."""
    content, agsg = load_bag(bag)
    return verify_content(content, agsg, recompute=recompute)


def verify_content(content: BagContent, agsg: Agsg, *, recompute: bool = True) -> Verdict:
    """Compute every margin of a run, wherever its messages come from; see `judge_content`."""
    return judge_content(content, agsg, recompute=recompute).verdict


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """A verdict, and what the recording was held against."""

    verdict: Verdict
    plan: Plan | NotComparable


def judge_content(
    content: BagContent, agsg: Agsg, *, as_recorded: bool = False, recompute: bool = True
) -> Judged:
    """Compute every margin of a run.

    Args:
        content: Messages of the run.
        agsg: Graph in them.
        as_recorded: Judge by the recorded version, limits, tolerances, settings and map, though
            they are others here.
        recompute: Step the executor over the recorded states, too. Only a benchmark that asks what
            the conditions find by themselves goes without.

    Raises:
        VerificationError: The grounding is missing, or nothing fits.
    """
    conditions = conditions_from_json(content.world.conditions_json)
    plan = recorded_plan(content.world, agsg)
    found: tuple[Finding, ...] = ()
    # What another version of the executor commands is not known here.
    if recompute and isinstance(plan, Plan) and not plan.other_version:
        found = recomputed_content(content, agsg)
    verdict = verify(
        content.trace, content.world, conditions, agsg.spec, plan, found, as_recorded=as_recorded
    )
    return Judged(verdict=verdict, plan=plan)


def recomputed_content(content: BagContent, agsg: Agsg) -> tuple[Finding, ...]:
    """Return where a run of this version of the executor is not the executor's.

    Raises:
        VerificationError: The recording does not say what it was made with.
    """
    known = knowledge()
    basis = GroundedScenario.model_validate_json(agsg.grounding_json).basis
    if basis is None:
        raise VerificationError(
            'the recording does not say with which settings it was made', hint='run it again'
        )
    tables = basis.tables()
    return recomputed(
        content.trace,
        content.world,
        agsg,
        tolerances=tables.tolerances,
        settings=tables.settings,
        parts=known.parts_of(content.world),
    )


def recorded_plan(world: WorldModel, agsg: Agsg) -> Plan | NotComparable:
    """Return what the request and the grounding of a recording give when worked out anew.

    That is done with the limits, tolerances and settings that it was recorded with; where others
    are installed here, the plan names each.

    Raises:
        VerificationError: The grounding is missing, or does not fit the request.
    """
    try:
        grounded = GroundedScenario.model_validate_json(agsg.grounding_json)
        if grounded.basis is None:
            return NotComparable(
                why='recorded without its version, limits, tolerances and settings, as by an '
                'older version: conditions, bodies and world are taken as recorded'
            )
        try:
            tables = grounded.basis.tables()
        except AuroraError as err:
            return NotComparable(
                why=f'{err.message}: conditions, bodies and world are taken as recorded'
            )
        return _plan(world, agsg, grounded, grounded.basis, tables)
    except (ValueError, LookupError, ArithmeticError, AuroraError) as err:
        raise VerificationError(
            f'the recorded grounding does not fit the recorded request: {err}',
            hint='run the scenario again',
        ) from err


def _plan(
    world: WorldModel, agsg: Agsg, grounded: GroundedScenario, basis: Basis, tables: Tables
) -> Plan:
    here = knowledge().basis
    spec = agsg.spec
    schedule = plan_time(spec, grounded, tables.limits)
    derivation = derive_conditions(spec, schedule.facts, tables.limits, tables.tolerances)
    rebuilt = _rebuilt_world(spec, grounded, tables.limits)
    foreign = basis.differences(here)
    if rebuilt is None:
        name, digest = grounded.map_name, grounded.map_digest
        foreign = (*foreign, f'map {name} with digest {digest[:12]} (here none such)')
    return Plan(
        conditions=judgeable(derivation.conditions, spec, grounded),
        roster=build_roster(grounded, tables.settings.run.dt_s),
        world=_as_grounded(world, grounded, tables.limits) if rebuilt is None else rebuilt,
        seed=grounded.seed,
        documents=tuple(_documents(world, agsg, grounded, schedule.canonical_json())),
        version=basis.version,
        other_version=basis.version != here.version,
        foreign=foreign,
        missing=(
            *_missing(spec, grounded, derivation),
            *(
                f'{one.element}: no condition depends on {one.what}'
                for one in _unjudged(spec, grounded, schedule, tables.limits, tables.tolerances)
            ),
        ),
    )


def _documents(
    world: WorldModel, agsg: Agsg, grounded: GroundedScenario, schedule_json: str
) -> Iterator[Finding]:
    """Yield where the recorded documents do not fit each other."""
    if grounded.basis is not None and grounded.configuration != grounded.basis.sha256:
        text = 'its digest is not that of the limits, tolerances and settings beside it'
        yield finding('configuration', 'digest', text)
    if agsg.conditions_json != world.conditions_json:
        yield finding('graph', 'conditions', 'graph and world tell of different conditions')
    if agsg.schedule_json != schedule_json:
        yield finding('graph', 'schedule', 'not the one that request and grounding give')
    if agsg.map_name != grounded.map_name:
        text = f'requested on {agsg.map_name}, grounded on {grounded.map_name}'
        yield finding('graph', 'map', text)


def _rebuilt_world(
    spec: ScenarioSpec, grounded: GroundedScenario, limits: Limits
) -> WorldModel | None:
    """Return the world of a grounding, None when its map is not installed here."""
    known = knowledge()
    try:
        map_model = known.map(grounded.map_name)
    except AuroraError:
        return None
    if map_model.digest != grounded.map_digest:
        return None
    places = place_positions(spec, map_model, grounded)
    parts = known.parts(grounded.map_name)
    return build_world(map_model, grounded, limits, places, '[]', parts)


def _as_grounded(world: WorldModel, grounded: GroundedScenario, limits: Limits) -> WorldModel:
    """Return a recorded world with all that the grounding says of it."""
    return replace(
        world,
        map_name=grounded.map_name,
        map_digest=grounded.map_digest,
        weather=grounded.weather,
        time_of_day=grounded.time_of_day,
        wind=wind_of(grounded),
        limits=limits,
    )
>>>>>>> h-latency
