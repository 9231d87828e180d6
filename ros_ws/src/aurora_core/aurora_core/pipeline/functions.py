# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The stages as plain functions: called by the local engine, and by each ROS node for its own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from aurora_core.agsg.build import build_agsg, derived
from aurora_core.agsg.judged import unjudged
from aurora_core.agsg.message import read_agsg
from aurora_core.conditions.capabilities import judgeable, unsupported
from aurora_core.conditions.derive import Derivation, derive_conditions
from aurora_core.errors import AuroraError, VerificationError
from aurora_core.execution.faults import Fault
from aurora_core.execution.map_parts import MapParts, map_parts
from aurora_core.execution.plan import (
    EXECUTOR_VERSION,
    Execution,
    build_execution,
    build_roster,
    build_world,
    wind_of,
)
from aurora_core.feasibility.check import check_request
from aurora_core.grounding.ground import Grounder
from aurora_core.grounding.places import place_positions
from aurora_core.knowledge.agent_types import load_agent_types
from aurora_core.knowledge.basis import Basis, Tables
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import Limits, Tolerances, load_limits, load_tolerances
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.settings import Settings, load_settings
from aurora_core.knowledge.world import WorldModel
from aurora_core.monitor.plan_check import NotComparable, Plan, finding
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.condition import (
    Condition,
    conditions_from_json,
    conditions_to_json,
)
from aurora_core.outcomes.feasibility import FeasibilityVerdict
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure, GroundingOutcome, Unjudged
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.outcomes.schedule import Schedule
from aurora_core.outcomes.verdict import Finding, Verdict
from aurora_core.parsing.idle_uavs import hovering
from aurora_core.parsing.parser import parse_offline
from aurora_core.pipeline.recompute import recomputed
from aurora_core.report.versions import AURORA_VERSION
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time
from aurora_core.trace.bag_content import BagContent


class Knowledge:
    """Maps, limits, tolerances and settings, loaded once per process."""

    def __init__(self) -> None:
        self.limits: Limits = load_limits(config_path('limits.json'))
        self.tolerances: Tolerances = load_tolerances(config_path('tolerances.json'))
        self.settings: Settings = load_settings()
        self.types = load_agent_types()
        tables = Tables(limits=self.limits, tolerances=self.tolerances, settings=self.settings)
        self.basis = Basis.of(AURORA_VERSION, tables)
        self._maps: dict[str, MapModel] = {}
        self._grounders: dict[str, Grounder] = {}
        self._parts: dict[str, MapParts] = {}

    def map(self, name: str) -> MapModel:
        """Return a map by name (verified against its digest when first loaded)."""
        if name not in self._maps:
            self._maps[name] = load_map(name)
        return self._maps[name]

    def parts(self, name: str) -> MapParts:
        """Return what the runs on a map share."""
        if name not in self._parts:
            self._parts[name] = map_parts(self.map(name))
        return self._parts[name]

    def grounder(self, name: str) -> Grounder:
        """Return the grounder of a map."""
        if name not in self._grounders:
            self._grounders[name] = Grounder(
                self.map(name),
                self.types,
                self.limits,
                self.tolerances,
                self.settings,
                self.basis,
                EXECUTOR_VERSION,
            )
        return self._grounders[name]

    def parts_of(self, world: WorldModel) -> MapParts | None:
        """Return the parts of the installed map whose solids a recorded world has, else None."""
        try:
            known = self.map(world.map_name)
        except AuroraError:
            return None
        same = known.buildings == world.buildings and known.zones == world.no_fly_zones
        return self.parts(world.map_name) if same else None


@lru_cache(maxsize=1)
def knowledge() -> Knowledge:
    """Return the knowledge of this process."""
    return Knowledge()


def parse_context(map_name: str, seed: int) -> ParseContext:
    """Return the map as prompts are read against it."""
    marks = tuple(mark.name for mark in knowledge().map(map_name).landmarks)
    return ParseContext(map_name=map_name, landmark_names=marks, seed=seed)


def parse_stage(prompt: str, map_name: str, seed: int) -> ParseOutcome:
    """Read a prompt against a map, with the offline parser."""
    return parse_offline(prompt, parse_context(map_name, seed))


def check_stage(agsg: Agsg) -> FeasibilityVerdict:
    """Judge feasibility of a specification against limits, tolerances and its map."""
    known = knowledge()
    spec = hovering(agsg.spec)
    return check_request(
        spec, known.map(spec.world.map_name), known.limits, known.tolerances, known.types
    )


def ground_stage(agsg: Agsg, seed: int) -> GroundingOutcome:
    """Ground a graph: places, routes, schedule, conditions.

    Whoever read the prompt, every UAV has a mission from here on.
    """
    known = knowledge()
    spec = hovering(agsg.spec)
    grounded = known.grounder(spec.world.map_name).ground(spec, seed)
    if isinstance(grounded, GroundingFailure):
        return GroundingOutcome(failure=grounded)
    schedule = plan_time(spec, grounded, known.limits)
    derivation = derive_conditions(spec, schedule.facts, known.limits, known.tolerances)
    conditions = judgeable(derivation.conditions, spec, grounded)
    graph = build_agsg(
        spec,
        map_digest=known.map(spec.world.map_name).digest,
        stage=Stage.GROUNDED,
        iteration=agsg.iteration,
        grounding_json=grounded.canonical_json(),
        schedule_json=schedule.canonical_json(),
        conditions=conditions,
        conditions_json=conditions_to_json(conditions),
        realised={r.path: r.realised for r in grounded.realised},
    )
    return GroundingOutcome(
        agsg=graph,
        unsupported=_missing(spec, grounded, derivation),
        unjudged=_unjudged(spec, grounded, schedule, known.limits, known.tolerances),
    )


def _missing(
    spec: ScenarioSpec, grounded: GroundedScenario, derivation: Derivation
) -> tuple[str, ...]:
    """Return what of a request nobody carries out or judges, as `id: what`."""
    return (
        *unsupported(spec, grounded),
        *(f'{u.element}: {u.what}' for u in derivation.underivable),
    )


def _unjudged(
    spec: ScenarioSpec,
    grounded: GroundedScenario,
    schedule: Schedule,
    limits: Limits,
    tolerances: Tolerances,
) -> tuple[Unjudged, ...]:
    """Return what a request states and no condition of its run depends on."""

    def derive(asked: ScenarioSpec) -> tuple[Condition, ...]:
        made = derive_conditions(asked, schedule.facts, limits, tolerances)
        return judgeable(made.conditions, asked, grounded)

    return unjudged(spec, derive(spec), derive)


def execution_stage(agsg: Agsg, seed: int, faults: tuple[Fault, ...]) -> Execution:
    """Build the execution of a grounded graph."""
    known = knowledge()
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
