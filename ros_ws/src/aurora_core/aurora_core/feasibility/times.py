# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse stated times that exclude each other, and phases that outlast the battery."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.feasibility.certificates import beyond, contradiction
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.zones import roof_reach_m
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.feasibility import BoundKind, Certificate, Fact, Rule, TimeBound
from aurora_core.spec.parameter import Span
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.stated import is_stated, least
from aurora_core.temporal.links import Basis, Link, Spot
from aurora_core.temporal.network import Cycle, contradictions
from aurora_core.temporal.words import told

# What a contradiction is called after, the first kind of bound in it that is here.
_RULES = (
    (BoundKind.ORDER, Rule.ORDER),
    (BoundKind.DEADLINE, Rule.DEADLINE),
    (BoundKind.INSIDE, Rule.HORIZON),
    (BoundKind.BATTERY, Rule.BATTERY),
    (BoundKind.CAUSE, Rule.ORDER),
    (BoundKind.MESSAGE, Rule.ORDER),
    (BoundKind.ALOFT, Rule.DEADLINE),
)


def check_times(
    spec: ScenarioSpec,
    limits: Limits,
    tolerances: Tolerances,
    map_model: MapModel | None = None,
) -> Iterator[Certificate]:
    """Return what the battery, deadlines, the horizon and stated orders rule out.

    Args:
        spec: The request.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
        map_model: Its map: a UAV that hovers at one landmark and then at another flies the way.
    """
    yield from _battery(spec, limits)
    marks = {} if map_model is None else _spots(spec, map_model)
    basis = Basis(spec=spec, limits=limits, tolerances=tolerances, landmarks=marks)
    for cycle in contradictions(basis):
        found = _certificate(basis, cycle)
        if found is not None and not (found.rule is Rule.BATTERY and _is_named(basis, found.path)):
            yield found


def _spots(spec: ScenarioSpec, map_model: MapModel) -> dict[str, Spot]:
    """Return where the landmarks are that several missions may be at, by their references."""
    targets = {m.target for m in spec.missions} if len(spec.missions) > 1 else set()
    return {
        f'{LANDMARK}{mark.name}': Spot(
            x_m=mark.x_m, y_m=mark.y_m, roof_m=roof_reach_m(mark, map_model.buildings)
        )
        for mark in map_model.quotable
        if f'{LANDMARK}{mark.name}' in targets
    }


def _battery(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    """The phases of one UAV together; a single one is checked against the limit alone."""
    for uav in spec.uavs:
        flown = [m for m in spec.missions if m.uav == uav.id]
        stated = [m.duration_s for m in flown if m.duration_s and is_stated(m.duration_s)]
        total = sum(least(d, 0.0, 0.0) for d in stated)
        if len(stated) > 1 and total > limits.uav_endurance_s:
            yield beyond(
                Rule.BATTERY,
                'endurance',
                stated[-1],
                f'uavs/{uav.id}',
                ('uav_endurance_s', limits.uav_endurance_s),
                f'the phases of {uav.id} last {total:g} s together; '
                f'at most {limits.uav_endurance_s:g} s are possible (uav_endurance_s).',
                (
                    *(f for m in flown for f in says(f'missions/{m.id}/duration_s', m.duration_s)),
                    *limit_facts(limits, 'uav_endurance_s'),
                ),
            )


def _is_named(basis: Basis, path: str) -> bool:
    """Return whether stated phases of a UAV alone outlast the battery: that is told already."""
    flown = [m for m in basis.spec.missions if f'uavs/{m.uav}' == path]
    return sum(least(m.duration_s, 0.0, 0.0) for m in flown) > basis.limits.uav_endurance_s


def _certificate(basis: Basis, cycle: Cycle) -> Certificate | None:
    """Return the proof by a circle of bounds; None where a bound is at fault by itself."""
    kinds = {link.kind for link in cycle}
    rule, kind = next(((r, k) for k, r in _RULES if k in kinds), (None, None))
    if rule is None:
        return None
    path = min(link.of for link in cycle if link.kind is kind)
    return contradiction(
        rule,
        'endurance' if rule is Rule.BATTERY else 'temporal_contradiction',
        path,
        f'{told(cycle)}.',
        _span(basis.spec, path),
        _facts(basis, cycle),
        tuple(_bound(link) for link in cycle),
    )


def _bound(link: Link) -> TimeBound:
    return TimeBound(
        earlier=link.earlier,
        later=link.later,
        least_s=link.least_s,
        most_s=link.most_s,
        kind=link.kind,
        of=link.of,
        words=link.words,
    )


def _facts(basis: Basis, cycle: Cycle) -> tuple[Fact, ...]:
    """Return what the bounds rest on, each fact once."""
    found: list[Fact] = []
    for link in cycle:
        for path, value in link.stated:
            found += says(path, value)
        found += limit_facts(basis.limits, *link.limits)
        found += tolerance_facts(basis.tolerances, *link.tolerances)
    return tuple(dict.fromkeys(found))


def _span(spec: ScenarioSpec, path: str) -> Span | None:
    """Return where the prompt speaks of an element; of a UAV, where it tells its last mission."""
    kind, _, name = path.partition('/')
    if kind == 'uavs':
        return next((m.span for m in reversed(spec.missions) if m.uav == name), None)
    if kind == 'agents':
        agent, _, number = name.partition('/behaviors/')
        return next(a.behaviors[int(number)].span for a in spec.agents if a.id == agent)
    spans = {
        'orders': {o.id: o.span for o in spec.orders},
        'conditions': {c.id: c.span for c in spec.conditions},
        'events': {e.id: e.span for e in spec.events},
    }
    return spans[kind][name]
