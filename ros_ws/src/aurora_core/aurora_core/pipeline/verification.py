# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Judge a recording: its margins, and what its request gives when it is worked out anew."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from aurora_core.agsg.message import read_agsg
from aurora_core.errors import AuroraError, SpecError, VerificationError
from aurora_core.execution.plan import build_roster, build_world, wind_of
from aurora_core.grounding.places import place_positions
from aurora_core.judging.codec import conditions_from_json
from aurora_core.judging.evaluation import Context
from aurora_core.knowledge.basis import Basis, Tables
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.clock_doubt import with_clocks
from aurora_core.monitor.plan_check import NotComparable, Plan, finding
from aurora_core.monitor.verify import context_of, verify
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.repair import with_values
from aurora_core.outcomes.schedule import Schedule
from aurora_core.outcomes.verdict import Finding, Verdict
from aurora_core.pipeline.functions import parse_context
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.planned import plan_conditions
from aurora_core.pipeline.reading import doubts_of_reading
from aurora_core.pipeline.recompute import recomputed
from aurora_core.planning.complete import complete
from aurora_core.ports.progress import Progress, quietly
from aurora_core.repair.lock import locked_edits
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.retarget import retargeted
from aurora_core.temporal.schedule import plan_time
from aurora_core.trace.bag_content import BagContent


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
        VerificationError: There is none, or its parts do not fit each other.
    """
    if content.agsg_message is None:
        raise VerificationError(
            f'{where} holds no scenario graph', hint='record /aurora/agsg with the run'
        )
    try:
        return read_agsg(content.agsg_message)
    except SpecError as err:
        raise VerificationError(
            f'the scenario graph in {where} is none that was recorded: {err.message}',
            hint='take another copy of the recording, or run the scenario again',
        ) from err


def verify_stage(known: Knowledge, bag: Path, *, recompute: bool = True) -> Verdict:
    """Recompute every margin from a bag alone; see `verify_content`."""
    content, agsg = load_bag(bag)
    return verify_content(known, content, agsg, recompute=recompute)


def verify_content(
    known: Knowledge,
    content: BagContent,
    agsg: Agsg,
    *,
    recompute: bool = True,
    progress: Progress = quietly,
) -> Verdict:
    """Compute every margin of a run, wherever its messages come from; see `judge_content`."""
    return judge_content(known, content, agsg, recompute=recompute, progress=progress).verdict


@dataclass(frozen=True, slots=True, kw_only=True)
class Judged:
    """A verdict, and what the recording was held against.

    Attributes:
        context: Holds what was measured for each condition.
    """

    verdict: Verdict
    plan: Plan | NotComparable
    conditions: tuple[Condition, ...]
    context: Context


def judge_content(
    known: Knowledge,
    content: BagContent,
    agsg: Agsg,
    *,
    as_recorded: bool = False,
    recompute: bool = True,
    progress: Progress = quietly,
) -> Judged:
    """Compute every margin of a run.

    Args:
        known: What is installed here.
        content: Messages of the run.
        agsg: Graph in them.
        as_recorded: Judge by the recorded version, limits, tolerances, settings and map, though
            they are others here.
        recompute: Step the executor over the recorded states, too. Only a benchmark that asks what
            the conditions find by themselves goes without.
        progress: Called whenever a piece of the work is done.

    Raises:
        VerificationError: The grounding is missing, or nothing fits.
    """
    conditions = conditions_from_json(content.world.conditions_json)
    plan = recorded_plan(known, content.world, conditions, agsg)
    progress()
    found: tuple[Finding, ...] = ()
    # What another version of the executor commands is not known here.
    if recompute and isinstance(plan, Plan) and not plan.other_version:
        found = recomputed_content(known, content, agsg, progress)
    context = context_of(content.trace, content.world, conditions, agsg.realised_spec)
    verdict = verify(
        content.trace,
        content.world,
        conditions,
        agsg.realised_spec,
        plan,
        found,
        as_recorded=as_recorded,
        progress=progress,
        context=context,
    )
    told = with_clocks(verdict, content.air_clocks)
    return Judged(verdict=told, plan=plan, conditions=conditions, context=context)


def recomputed_content(
    known: Knowledge, content: BagContent, agsg: Agsg, progress: Progress = quietly
) -> tuple[Finding, ...]:
    """Return where a run of this version of the executor is not the executor's.

    Raises:
        VerificationError: The recording does not say what it was made with.
    """
    basis = agsg.grounding.basis if agsg.grounding is not None else None
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
        progress=progress,
    )


def recorded_plan(
    known: Knowledge, world: WorldModel, conditions: tuple[Condition, ...], agsg: Agsg
) -> Plan | NotComparable:
    """Return what the request and the grounding of a recording give when worked out anew.

    That is done with the limits, tolerances and settings that it was recorded with; where others
    are installed here, the plan names each.

    Args:
        known: What is installed here.
        world: As recorded.
        conditions: Of that world.
        agsg: As recorded.

    Raises:
        VerificationError: The grounding is missing, or does not fit the request.
    """
    try:
        grounded = agsg.grounding
        if grounded is None:
            raise VerificationError('the graph is not grounded')
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
        return _plan(known, world, conditions, agsg, grounded, grounded.basis, tables)
    except (ValueError, LookupError, ArithmeticError, AuroraError) as err:
        raise VerificationError(
            f'the recorded grounding does not fit the recorded request: {err}',
            hint='run the scenario again',
        ) from err


def _plan(
    known: Knowledge,
    world: WorldModel,
    conditions: tuple[Condition, ...],
    agsg: Agsg,
    grounded: GroundedScenario,
    basis: Basis,
    tables: Tables,
) -> Plan:
    here = known.basis
    spec = agsg.spec
    # Requests were once recorded as they were read; completing changes nothing of a complete one.
    whole = complete(spec, tables.limits)
    if grounded.repair is not None:
        whole = with_values(whole, grounded.repair.values)
    schedule = plan_time(whole, grounded, tables.limits, tables.tolerances)
    planned = plan_conditions(spec, grounded, schedule, tables.limits, tables.tolerances)
    rebuilt = _rebuilt_world(known, spec, grounded, tables.limits)
    foreign = basis.differences(here)
    if rebuilt is None:
        name, digest = grounded.map_name, grounded.map_digest
        foreign = (*foreign, f'map {name} with digest {digest[:12]} (here none such)')
    return Plan(
        conditions=planned.conditions,
        roster=build_roster(grounded, tables.settings.run.dt_s),
        world=_as_grounded(world, grounded, tables.limits) if rebuilt is None else rebuilt,
        seed=grounded.seed,
        documents=(
            *_documents(conditions, agsg, grounded, schedule),
            *_triggers(grounded, retargeted(whole, grounded, tables.limits)),
            *_repair(agsg, grounded),
            *_reading(known, spec, tables.limits, is_here=rebuilt is not None),
        ),
        version=basis.version,
        other_version=basis.version != here.version,
        foreign=foreign,
        missing=planned.missing,
        unjudged=planned.unjudged,
    )


def _documents(
    conditions: tuple[Condition, ...],
    agsg: Agsg,
    grounded: GroundedScenario,
    schedule: Schedule,
) -> Iterator[Finding]:
    """Yield where the recorded documents do not fit each other."""
    if grounded.basis is not None and grounded.configuration != grounded.basis.sha256:
        text = 'its digest is not that of the limits, tolerances and settings beside it'
        yield finding('configuration', 'digest', text)
    if agsg.conditions != conditions:
        yield finding('graph', 'conditions', 'graph and world tell of different conditions')
    if agsg.schedule not in (schedule, schedule.without_times):
        yield finding('graph', 'schedule', 'not the one that request and grounding give')
    if agsg.map_name != grounded.map_name:
        text = f'requested on {agsg.map_name}, grounded on {grounded.map_name}'
        yield finding('graph', 'map', text)


def _triggers(grounded: GroundedScenario, again: GroundedScenario) -> Iterator[Finding]:
    """Yield where triggers were moved to other values than their places ask for."""
    if grounded.realised != again.realised:
        yield finding('graph', 'triggers', 'not those that request and grounding give')


def _repair(agsg: Agsg, grounded: GroundedScenario) -> Iterator[Finding]:
    """Yield what was realised otherwise though it is locked."""
    for why in () if grounded.repair is None else locked_edits(agsg, grounded.repair):
        yield finding('graph', 'repair', why)


def _reading(
    known: Knowledge, spec: ScenarioSpec, limits: Limits, *, is_here: bool
) -> Iterator[Finding]:
    """Yield where the recorded request is not what its prompt says."""
    context = parse_context(known, spec.world.map_name, 0) if is_here else None
    for text in doubts_of_reading(spec, limits, context):
        yield finding('graph', 'prompt', text)


def _rebuilt_world(
    known: Knowledge, spec: ScenarioSpec, grounded: GroundedScenario, limits: Limits
) -> WorldModel | None:
    """Return the world of a grounding, None when its map is not installed here."""
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
