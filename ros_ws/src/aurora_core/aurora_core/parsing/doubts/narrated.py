# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a sentence tells in an order, or as a cause, that became deeds without one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.doubts.clauses import (
    MOMENTS,
    TOLD,
    clause_of,
    events_in,
    meet,
    over,
    sentences,
    within,
)
from aurora_core.parsing.morphology import VerbForm
from aurora_core.spec.parameter import Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Clause, DistanceTrigger, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, ClauseStatus

# Deeds that make sense at one moment: whoever tells several of them tells them in their order.
_DEEDS = frozenset({'brake', 'cross', 'overtake', 'slow', 'start', 'stop'}) | TOLD
_CAUSES = frozenset({'after', 'when'})
# Told of somebody they happen once: `comes within 30 m`, not `must come` or `is within 30 m`.
_COMES = frozenset({'approach', 'come', 'fall_below'})
_DISTANCES = frozenset({QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE})
# `within 25 m of it, it slows`: both words are the same body.
_SAME_TWICE = re.compile(
    r'\d ?m(?:eters?|etres?)? (?:of|from|to) (?:it|him|her)\b[^.;,]*, (?:it|he|she)\b'
)


def in_their_order(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the bus stops, a pedestrian crosses, the bus drives on`: nothing says what is first."""
    for sentence in sentences(atoms):
        before: tuple[Clause, frozenset[str]] | None = None
        for k, atom in enumerate(sentence):
            if atom.kind in (AtomKind.SUBORDINATOR, AtomKind.RELATIVE, AtomKind.THEN):
                before = None
            if atom.kind is not AtomKind.VERB:
                continue
            clause = clause_of(spec, atom) if atom.key in _DEEDS else None
            if clause is None or _timed(spec, clause):
                before = None
                continue
            who = _bodies(spec, clause)
            joined = any(a.kind is AtomKind.COMMA for a in sentence[:k]) or atom.key in TOLD
            if before is not None and joined and who and before[1] and who != before[1]:
                yield clause.span
            before = (clause, who)


def untied_causes(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`when it has tracked the bus for 15 s, the bus stops` that became a bus that stops."""
    for sentence in sentences(atoms):
        if not any(a.kind is AtomKind.SUBORDINATOR and a.key in _CAUSES for a in sentence):
            continue
        verbs = [a for a in sentence if a.kind is AtomKind.VERB]
        told = [(a, clause_of(spec, a)) for a in verbs]
        clauses = [c for _, c in told if c is not None]
        if len(verbs) < 2 or len(clauses) < len(verbs) or any(_timed(spec, c) for c in clauses):
            continue
        flown = {m.id for m in spec.missions}
        deeds = [
            (a, c)
            for a, c in told
            if c is not None and a.key in MOMENTS and _does(spec, c) and not flown & set(c.ids)
        ]
        if deeds and any(flown & set(c.ids) for c in clauses):
            yield over(deeds[0][0], deeds[0][0])


def told_as_bounds(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`a bus comes within 30 m of it and the car drives off` that became a bound all along."""
    for condition in spec.conditions:
        near = condition.op in ('<', '<=') and condition.quantity in _DISTANCES
        if not near or condition.value.span is None or condition.by_s is not None:
            continue
        for clause in spec.clauses:
            told = [a for a in within(atoms, clause.span) if a.end <= condition.value.span.start]
            verbs = [a for a in told if a.kind is AtomKind.VERB]
            comes = bool(verbs) and verbs[-1].key in _COMES and verbs[-1].form is VerbForm.THIRD
            if condition.id in clause.ids and comes and clause.status is ClauseStatus.ENCODED:
                yield clause.span


def said_twice(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`when a car comes within 25 m of it, it slows`: both are one, not the car."""
    text = spec.prompt.lower()
    for found in _SAME_TWICE.finditer(text):
        span = Span(start=found.start(), end=found.end())
        told = {i for c in spec.clauses if meet(c.span, span) for i in c.ids}
        for event in spec.events:
            trigger, action = event.trigger, event.action
            if event.id not in told or not isinstance(trigger, DistanceTrigger):
                continue
            if isinstance(action, AgentAction) and action.agent == trigger.a:
                yield span


def _timed(spec: ScenarioSpec, clause: Clause) -> bool:
    """Tell whether something says when what a clause tells happens."""
    ordered = {i for o in spec.orders for i in (o.first, o.then)}
    caused = any(e.trigger is not None for e in events_in(spec, clause))
    return caused or bool(ordered & set(clause.ids))


def _bodies(spec: ScenarioSpec, clause: Clause) -> frozenset[str]:
    """Return who acts in a clause."""
    acting = {a.id for a in spec.agents if a.id in clause.ids and a.behaviors}
    for event in events_in(spec, clause):
        acting |= {getattr(event.action, n, None) or '' for n in ('agent', 'sender', 'uav')}
    return frozenset(acting - {''})


def _does(spec: ScenarioSpec, clause: Clause) -> bool:
    kinds = {kind.value for kind in BehaviorKind} & MOMENTS
    return any(
        b.kind.value in kinds for a in spec.agents if a.id in clause.ids for b in a.behaviors
    )
