# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What words tie together in time: effects, landings, waiting, the second of two."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.doubts.clauses import (
    MOMENTS,
    clause_of,
    events_in,
    inside,
    meet,
    over,
    sentences,
    stretch,
    within,
)
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.scenario import (
    AgentAction,
    Clause,
    DistanceTrigger,
    Event,
    MissionDoneTrigger,
    ScenarioSpec,
    TimeTrigger,
    UavAction,
)
from aurora_core.spec.vocabulary import STANDING, BehaviorKind, ClauseStatus

# Whose distance is that of t = 0: where one starts, how far ahead a van is that cuts in.
_FROM_HERE = frozenset({'change_lane', 'start'})
_ONCE = MOMENTS | {'ascend', 'descend', 'land', 'step_onto'}
# What a driver does for a while, and a flight does not.
_STANDS = frozenset({'park', 'wait'})
_NEARS = frozenset({'approach', 'reach'})
_INTRANSITIVE = frozenset({'brake', 'cross', 'land', 'start', 'stop', 'turn_left', 'turn_right'})
_AFTER_THAT = frozenset({'after that', 'afterwards', 'then', 'thereafter'})
# `after 20 s of the run`, `after 20 s from the start`.
_OF_THE_RUN = re.compile(r'\s*(?:from|in|into|of|since)\b')
_LETS = frozenset({'lets', 'letting'})
_LETS_PASS = frozenset({'cross', 'overtake'})
# What stands for an act of its own behind `then`.
_ACTS = frozenset({AtomKind.VERB, AtomKind.PATTERN, AtomKind.ROUTE, AtomKind.HAPPENING})


def untied_effects(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`alerts the ego when a van comes near and climbs to 60 m`: it climbs then, not before."""
    for sentence in sentences(atoms):
        acts = causes = False
        for k, atom in enumerate(sentence):
            if atom.kind is AtomKind.SUBORDINATOR:
                causes = acts and atom.key == 'when'
            if atom.kind is not AtomKind.VERB:
                continue
            acts = True
            joined = k and sentence[k - 1].kind is AtomKind.CONJUNCTION
            clause = clause_of(spec, atom) if causes and joined else None
            if clause is None or events_in(spec, clause) or _in_orders(spec, clause):
                continue
            if set(clause.ids) <= {m.id for m in spec.missions} | {u.id for u in spec.uavs}:
                yield clause.span


def _in_orders(spec: ScenarioSpec, clause: Clause) -> bool:
    return any({o.first, o.then} & set(clause.ids) for o in spec.orders)


def let_pass(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`stops and lets a pedestrian cross`: who lets somebody pass waits for that."""
    yields = any(b.kind is BehaviorKind.YIELD for a in spec.agents for b in a.behaviors) or any(
        isinstance(e.action, AgentAction)
        and (e.action.do == 'yield' or (e.trigger and not isinstance(e.trigger, TimeTrigger)))
        for e in spec.events
    )
    for k, atom in enumerate(atoms):
        if atom.kind is not AtomKind.CAUSATIVE or atom.words not in _LETS or yields:
            continue
        rest = list(atoms[k + 1 : k + 3])
        passes = len(rest) == 2 and rest[0].is_actor and rest[1].key in _LETS_PASS
        clause = clause_of(spec, rest[1]) if passes else None
        if clause is not None:
            yield clause.span


def landings(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`when the drone has landed` that became the end of its missions, many seconds before."""
    waiting = {e.id: _lands_other(e) for e in spec.events if _awaits_another(e)}
    landed = False
    for sentence in sentences(atoms):
        words = [a for a in sentence if a.kind in (AtomKind.VERB, AtomKind.HAPPENING)]
        clauses = [clause_of(spec, a) for a in words]
        told = {i for c in clauses if c is not None for i in c.ids} & waiting.keys()
        lands = [a for a in words if a.key == 'land']
        before, landed = landed, bool(lands)
        if not told or any(a.key == 'finish' for a in sentence):
            continue
        if before and sentence[0].words in _AFTER_THAT:
            yield from (c.span for c in clauses[:1] if c is not None)
        if len(lands) <= any(waiting[i] for i in told):
            continue  # what it does then is to land
        then = {b.start for a, b in pairwise(sentence) if a.kind is AtomKind.THEN}
        for atom, clause in zip(words, clauses, strict=True):
            if atom.key == 'land' and clause is not None and atom.start not in then:
                yield clause.span


def _awaits_another(event: Event) -> bool:
    """A UAV that lands when its own missions are over waits for nobody."""
    done, action = event.trigger, event.action
    lands = isinstance(action, UavAction) and action.lands and action.uav
    return isinstance(done, MissionDoneTrigger) and lands != done.uav


def _lands_other(event: Event) -> bool:
    return isinstance(event.action, UavAction) and event.action.lands


def started_again(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`stops and starts again after 10 s`: after the stop, not 10 s into the run."""
    for clause in spec.clauses:
        words = within(atoms, clause.span)
        again = any(a.words == 'again' or a.key == 'again' for a in words)
        events = events_in(spec, clause) if clause.status is ClauseStatus.ENCODED else []
        if again and any(isinstance(e.trigger, TimeTrigger) for e in events):
            yield clause.span


def bare_sequels(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`warns the ego, then the truck`, `first at 30 m and then at 60 m`: the verb is not told."""
    for sentence in sentences(atoms):
        for k, atom in enumerate(sentence):
            if atom.kind is not AtomKind.THEN:
                continue
            told = stretch(sentence, k + 1)
            verb = next((a for a in reversed(sentence[:k]) if a.kind is AtomKind.VERB), None)
            if verb is not None and (verb is sentence[k - 1] or _alone(verb, told)):
                continue
            behind = sentence[k + 1 + len(told) :]
            if behind and behind[0].kind is AtomKind.RELATIVE:
                continue  # `then a drone that tracks the van warns the ego`
            happens = any(a.kind in _ACTS for a in sentence[:k])
            if verb is not None and _goes_on(spec, verb, told):
                continue
            if told and happens and not any(a.kind in _ACTS for a in told):
                clause = clause_of(spec, told[0])
                if clause is not None:
                    yield over(atom, told[-1])


def _alone(verb: Atom, told: Sequence[Atom]) -> bool:
    """`the truck stops, then the bus`: whoever is named can only do the same."""
    return verb.key in _INTRANSITIVE and any(a.is_actor for a in told)


def _goes_on(spec: ScenarioSpec, verb: Atom, told: Sequence[Atom]) -> bool:
    """`stops for 20 s and then continues`: one does so by itself when a stated time is over."""
    clause = clause_of(spec, verb)
    return (
        clause is not None
        and all(a.kind is AtomKind.AUXILIARY for a in told)
        and any(
            b.kind.value == verb.key and b.duration_s is not None
            for a in spec.agents
            if a.id in clause.ids
            for b in a.behaviors
        )
    )


def times_of_others(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`tracks the bus; the bus stops for 5 s` that became a flight of 5 s."""
    drivers = {agent.id for agent in spec.agents}
    for mission in spec.missions:
        told = None if mission.duration_s is None else mission.duration_s.span
        if told is None:
            continue
        for clause in spec.clauses:
            holds = clause.span.start <= told.start and told.end <= clause.span.end
            before = [a for a in within(atoms, clause.span) if a.end <= told.start]
            acts = [a for a in before if a.kind is AtomKind.VERB]
            aside = any(a.kind in (AtomKind.COMMA, AtomKind.SUBORDINATOR) for a in before)
            if not holds or aside or not acts or acts[-1].key not in _STANDS | MOMENTS:
                continue
            if clause.status is ClauseStatus.ENCODED and drivers & set(clause.ids):
                yield told


def at_one_moment(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`brakes as a pedestrian crosses`: two that happen once, and nothing that ties them."""
    for sentence in sentences(atoms):
        for k, atom in enumerate(sentence):
            if atom.kind is not AtomKind.SUBORDINATOR or atom.key != 'while':
                continue
            before = [a for a in sentence[:k] if a.kind is AtomKind.VERB][-1:]
            behind = [a for a in stretch(sentence, k + 1) if a.kind is AtomKind.VERB][:1]
            first = any(a.key in _ONCE | {'wait'} for a in before)
            once = first and any(
                a.key in _ONCE or (a.key in _NEARS and atom.words == 'as') for a in behind
            )
            told = [c for a in (*before, *behind) if (c := clause_of(spec, a)) is not None]
            if once and len(told) == 2 and not any(_tied(spec, c) for c in told):
                yield over(atom, behind[0])


def bounds_meanwhile(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`never exceeds 8 m/s while the drone is within 50 m`: a bound that holds then became two."""
    bounds = [c.value.span for c in spec.conditions if c.value.span is not None]
    for sentence in sentences(atoms):
        for k, atom in enumerate(sentence):
            if atom.kind is not AtomKind.SUBORDINATOR or atom.key != 'while':
                continue
            told = stretch(sentence, k + 1)
            if not k or not told:
                continue
            sides = (over(sentence[0], sentence[k - 1]), over(told[0], told[-1]))
            if all(any(meet(bound, side) for bound in bounds) for side in sides):
                yield over(atom, told[-1])


def _tied(spec: ScenarioSpec, clause: Clause) -> bool:
    """Whether what a clause became has a cause, an order or a bound."""
    caused = any(
        e.trigger is not None and not isinstance(e.trigger, TimeTrigger)
        for e in events_in(spec, clause)
    )
    bound = any(c.id in clause.ids for c in spec.conditions)
    return caused or bound or _in_orders(spec, clause)


def begun_already(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`20 m ahead; when the gap falls below 30 m`: it is below that from the start."""
    told = {
        frozenset((agent.id, place.of)): place.distance_m.value
        for agent in spec.agents
        for place in agent.placements
        if place.distance_m is not None and place.distance_m.provenance is Provenance.EXPLICIT
    }
    for event in spec.events:
        near = event.trigger
        if not isinstance(near, DistanceTrigger) or near.value_m.span is None:
            continue
        start_m = told.get(frozenset((near.a, near.b)))
        below = near.on == 'distance_below'
        if start_m is None or (start_m < near.value_m.value) is not below:
            continue
        for clause in spec.clauses:
            before = [a for a in within(atoms, clause.span) if a.end <= near.value_m.span.start]
            verbs = [a.key for a in before if a.kind in (AtomKind.VERB, AtomKind.HAPPENING)]
            changes = bool(verbs) and verbs[-1] != 'be' and event.id in clause.ids
            if changes and clause.status is ClauseStatus.ENCODED:
                yield clause.span


def times_of_phases(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hovers; after 20 s it switches to the bus`: 20 s of the hover, and not of the run."""
    for _, told_s, action in _changes_at(spec):
        first = next((m for m in spec.missions if m.uav == action.uav), None)
        told = None if first is None else first.duration_s
        if first is None or (told is not None and told.provenance is Provenance.EXPLICIT):
            continue
        before = spec.prompt[: told_s.start].lower().rstrip()
        behind = spec.prompt[told_s.end :].lower()
        if before.endswith('after') and not _OF_THE_RUN.match(behind):
            yield told_s


def times_of_described(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`at 40 s a drone that tracks the bus returns`: it returns then, and has tracked before."""
    for at, told_s, action in _changes_at(spec):
        if action.mission != next((m.id for m in spec.missions if m.uav == action.uav), None):
            continue
        ends = any(
            isinstance(e.action, UavAction)
            and (e.action.uav, e.trigger) == (action.uav, at)
            and e.action.lands
            for e in spec.events
        )
        behind = (a for a in atoms if a.start >= told_s.end)
        told = next((a for a in behind if a.kind in (AtomKind.RELATIVE, AtomKind.VERB)), None)
        if ends or (told is not None and told.kind is AtomKind.RELATIVE):
            yield told_s


def _changes_at(spec: ScenarioSpec) -> Iterator[tuple[TimeTrigger, Span, UavAction]]:
    """Yield the changes of mission at a stated time, with the words for that time."""
    for event in spec.events:
        at, action = event.trigger, event.action
        if not isinstance(at, TimeTrigger) or at.at_s.span is None:
            continue
        if isinstance(action, UavAction) and action.do == 'change_mission':
            yield at, at.at_s.span, action


def times_of_sequels(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hovers, then descends to 40 m and hovers for 10 s` that became 10 s of the hover before."""
    for before, after in pairwise(sorted(spec.missions, key=lambda m: m.uav)):
        parts = (before.altitude_m, after.altitude_m, before.duration_s)
        spans = [p.span for p in parts if p is not None and p.span is not None]
        if before.uav != after.uav or len(spans) < 3 or before.duration_s == after.duration_s:
            continue
        first, then, lasts = spans
        if first.start < then.start < lasts.start:
            yield lasts


def distances_of_moments(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`stops 10 m behind the truck` that became 10 m at the start."""
    for clause in spec.clauses:
        words = within(atoms, clause.span)
        acts = [a for a in words if a.kind is AtomKind.VERB]
        moment = acts and acts[-1].key in MOMENTS - _FROM_HERE
        if not moment or clause_of(spec, acts[-1]) is None:
            continue
        told = [
            p.distance_m.span
            for a in spec.agents
            if a.id in clause.ids
            for p in a.placements
            if p.distance_m is not None and p.distance_m.provenance is Provenance.EXPLICIT
        ]
        for span in told:
            if span is not None and acts[-1].end <= span.start and span.end <= clause.span.end:
                yield span


def standing_meanwhile(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the car stands for 20 s while a drone circles it`: it has stood before that begins."""
    for sentence in sentences(atoms):
        for word in sentence:
            if word.words != 'while':
                continue
            whole = over(sentence[0], sentence[-1])
            stands = any(
                b.kind in STANDING and b.duration_s is not None and inside(b.span, whole)
                for a in spec.agents
                for b in a.behaviors
            )
            if stands and any(inside(m.span, whole) for m in spec.missions):
                yield over(word, word)
