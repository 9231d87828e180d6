# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse what a limit rules out: a stated number beyond a limit is refused, never clamped."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from aurora_core.feasibility.bounds import check_bounds
from aurora_core.feasibility.doubts import doubts, nominal
from aurora_core.feasibility.geometry import check_geometry
from aurora_core.feasibility.hidden import check_hidden
from aurora_core.feasibility.limits import check_limits
from aurora_core.feasibility.mends import Check, Mends
from aurora_core.feasibility.operands import operands_fit
from aurora_core.feasibility.places import check_placements
from aurora_core.feasibility.pursuit import check_pursuit
from aurora_core.feasibility.quotes import rests_on_unread, unread_spans, with_clauses
from aurora_core.feasibility.radio import check_radio
from aurora_core.feasibility.roofs import check_roofs, check_walls
from aurora_core.feasibility.rounds import check_rounds
from aurora_core.feasibility.scene import check_scene
from aurora_core.feasibility.sight import check_sight
from aurora_core.feasibility.signs import check_signs
from aurora_core.feasibility.static import check_static
from aurora_core.feasibility.times import check_times
from aurora_core.feasibility.zones import check_zones
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.uav_record import UavRecord
from aurora_core.outcomes.feasibility import (
    Certificate,
    CheckStage,
    Feasibility,
    FeasibilityVerdict,
    Rule,
)
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

# Statements that clash with each other: a word that was not read may keep them apart.
_BETWEEN_STATEMENTS = (
    Rule.PLACEMENT,
    Rule.ORDER,
    Rule.DEADLINE,
    Rule.HORIZON,
    Rule.BOUNDS,
    Rule.SCENE,
    Rule.STILL,
)


def check_request(
    spec: ScenarioSpec,
    map_model: MapModel,
    limits: Limits,
    tolerances: Tolerances,
    types: Mapping[str, AgentTypeRecord],
    without: frozenset[CheckStage] = frozenset(),
    uav: UavRecord | None = None,
) -> FeasibilityVerdict:
    """Check limits, and what several stated things together or the map rule out.

    Args:
        spec: The request.
        map_model: Its map, with landmarks and no-fly zones.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed: what they allow is not refused.
        types: What the agent types can reach.
        without: Stages that are left out.
        uav: What the multirotor was measured to do.

    Returns:
        `infeasible` with its proofs; `unknown` with what is in doubt; else `feasible`.
    """
    findings = () if CheckStage.STATIC in without else tuple(check_static(spec))
    verdict = FeasibilityVerdict(result=Feasibility.FEASIBLE)
    if CheckStage.PROOFS not in without:
        verdict = _proven(spec, map_model, limits, tolerances, types, uav)
    if not findings:
        return verdict
    result = verdict.result
    notes = (*verdict.notes, *(f'{f.field}: {f.relation}.' for f in findings))
    if result is Feasibility.FEASIBLE:
        result = Feasibility.UNKNOWN
    return verdict.model_copy(update={'result': result, 'notes': notes, 'findings': findings})


def _proven(
    spec: ScenarioSpec,
    map_model: MapModel,
    limits: Limits,
    tolerances: Tolerances,
    types: Mapping[str, AgentTypeRecord],
    uav: UavRecord | None,
) -> FeasibilityVerdict:
    # A condition of what has no such quantity is a fault of the reader, and proves nothing.
    sound = tuple(c for c in spec.conditions if operands_fit(spec, c))
    if len(sound) < len(spec.conditions):
        spec = spec.model_copy(update={'conditions': sound})
    checks = _checks(map_model, limits, tolerances, types)
    by_check = [list(check(spec)) for check in checks]
    found = [c for proofs in by_check for c in proofs]
    certificates = [c for c in found if not _is_doubtful(spec, c)]
    if certificates:
        # A value that only the tolerances allow is no help to anybody.
        mends = Mends(spec, _checks(map_model, *nominal(limits, tolerances), types), _is_doubtful)
        told = tuple(
            with_clauses(spec, mends.added_to(c, index))
            for index, proofs in enumerate(by_check)
            for c in proofs
            if c in certificates
        )
        return FeasibilityVerdict(result=Feasibility.INFEASIBLE, certificates=told)
    notes = (
        *(f'{c.sentence} But part of that clause was not read.' for c in found),
        *doubts(spec, map_model, limits, tolerances, uav, known={c.sentence for c in found}),
    )
    notes = tuple(dict.fromkeys(notes))
    result = Feasibility.UNKNOWN if notes else Feasibility.FEASIBLE
    return FeasibilityVerdict(result=result, notes=notes)


def _checks(
    map_model: MapModel,
    limits: Limits,
    tolerances: Tolerances,
    types: Mapping[str, AgentTypeRecord],
) -> tuple[Check, ...]:
    """Return the checks, each of which gives the proofs of its own kind of a request."""

    def numbers(spec: ScenarioSpec) -> Iterator[Certificate]:
        beyond_limits = check_limits(spec, limits, types).certificates
        named = {c.span for c in beyond_limits}
        yield from beyond_limits
        yield from (c for c in check_signs(spec) if c.span not in named)

    def places(spec: ScenarioSpec) -> Iterator[Certificate]:
        marks, buildings = map_model.quotable, map_model.buildings
        fenced = list(check_zones(spec, map_model.zones, marks, limits, tolerances, buildings))
        yield from fenced
        # A tower in a no-fly zone is told of once, and a flight among buildings, too.
        told = {zone.path for zone in fenced}
        built = (buildings, marks, limits, tolerances)
        for check in (check_roofs, check_hidden, check_rounds):
            found = [c for c in check(spec, *built) if c.path.rpartition('/')[0] not in told]
            told |= {c.path.rpartition('/')[0] for c in found}
            yield from found

    return (
        numbers,
        lambda spec: check_sight(spec, map_model, limits, tolerances),
        lambda spec: check_radio(spec, limits, tolerances),
        lambda spec: check_geometry(spec, map_model, limits, tolerances),
        lambda spec: check_pursuit(spec, limits, tolerances),
        lambda spec: check_bounds(spec, limits, tolerances),
        check_scene,
        lambda spec: check_times(spec, limits, tolerances, map_model),
        lambda spec: check_placements(spec, tolerances),
        places,
        lambda spec: check_walls(spec, map_model.buildings, limits, tolerances),
    )


def _is_doubtful(spec: ScenarioSpec, proof: Certificate) -> bool:
    """Tell whether words that were not read may say otherwise."""
    if rests_on_unread(spec, proof):
        return True
    return proof.rule in _BETWEEN_STATEMENTS and _half_read(spec, proof)


def _half_read(spec: ScenarioSpec, certificate: Certificate) -> bool:
    """Tell whether a word was not read in a clause that clashes with another statement.

    `starts 20 m behind it and ends 10 m ahead`: without `ends` they clash, with it they do not.
    """
    at = certificate.span
    if at is None:
        return False
    unread = list(unread_spans(spec))
    clauses = [c.span for c in spec.clauses if c.status is ClauseStatus.ENCODED]
    around = [c for c in clauses if c.start <= at.start and at.end <= c.end]
    return any(c.start <= u.start and u.end <= c.end for c in around for u in unread)
