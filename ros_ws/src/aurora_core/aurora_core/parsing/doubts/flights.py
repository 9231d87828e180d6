# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flights: what is watched from a hover, heights that come later, flights told without a verb."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.doubts.clauses import (
    MOMENTS,
    clause_of,
    events_in,
    meet,
    over,
    sentences,
    stands_bare,
    stretch,
    within,
)
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    Clause,
    DistanceTrigger,
    ScenarioSpec,
    StatedCondition,
    UavAction,
)
from aurora_core.spec.vocabulary import BehaviorKind, ClauseStatus, MissionMode, Pattern

# What tells of a flight: verbs, `an orbit`, `a patrol`, `back again`.
_FLOWN = frozenset(
    {AtomKind.VERB, AtomKind.PATTERN, AtomKind.THEN, AtomKind.HAPPENING, AtomKind.ROUTE}
)
# Whoever does so is somewhere else soon.
_MOVES = frozenset(
    {BehaviorKind.CIRCULATE, BehaviorKind.DRIVE, BehaviorKind.EMERGENCY_RUN, BehaviorKind.WALK}
)
_CLIMBS = frozenset({'ascend', 'descend'})
_HEIGHTS = ('ascend', 'climb', 'descend', 'sink')
# Who does nothing in the air, and what a distance is measured from.
_GROUND = frozenset({NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO})
_AWAY = ('from', 'away from')
_KEPT = re.compile(
    r'\b(?:hold|keep|kept|maintain|min|neither|never|no|none|not|remain|separat|stay)'
)
_REFUSED_M = 5.0  # a least separation that limits usually ask
_APART = re.compile(r'\b(?:apart|away|close|closer|farther|further|near|nearer)\b')
_STAYS = ('holds', 'keeps', 'remains', 'stays', 'waits')
_AS_LONG = re.compile(r'(?:while|(?:as|so) long as)\b')
# What a driver has done before a UAV is up.
_PASSES = frozenset({'approach', 'change_lane', 'overtake', 'reach', 'turn_left', 'turn_right'})
# Behind these a verb has the subject of the one before.
_JOINS = frozenset({AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN})


def watched_while_hovering(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hovers over the market and monitors a bus` that became a flight behind the bus."""
    missions = {m.id: m for m in spec.missions}
    for sentence in sentences(atoms):
        hovers: Clause | None = None
        for atom in sentence:
            if atom.kind in (AtomKind.THEN, AtomKind.SUBORDINATOR, AtomKind.CONTEXT):
                hovers = None
            if atom.kind is not AtomKind.VERB:
                continue
            clause = clause_of(spec, atom)
            if atom.key != 'observe' or hovers is None or clause is None:
                hovers = clause if atom.key == 'hover' else None
                continue
            before = {missions[i].uav for i in hovers.ids if i in missions}
            now = [missions[i] for i in clause.ids if i in missions]
            if any(m.mode is MissionMode.TRACK and m.uav in before for m in now):
                yield clause.span


def flights_without_verb(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`two drones hover at 40 m and 60 m, the first one at 60 m`: no flight after the first."""
    told: set[str] = set()
    bare: dict[str, Span] = {}
    for clause in spec.clauses:
        if any(a.kind in _FLOWN for a in within(atoms, clause.span)):
            told |= set(clause.ids)
        elif clause.status is ClauseStatus.ENCODED:
            bare |= dict.fromkeys(clause.ids, clause.span)
    for mission in spec.missions:
        others = [m for m in spec.missions if m.uav == mission.uav and m is not mission]
        if mission.id in bare and mission.id not in told and others:
            yield bare[mission.id]


def folded_climbs(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`tracks the car at 30 m and then climbs to 60 m` that became one flight at 60 m."""
    missions, asked = {m.id for m in spec.missions}, {c.id for c in spec.conditions}
    for sentence in sentences(atoms):
        begun: set[str] = set()
        for k, atom in enumerate(sentence):
            clause = clause_of(spec, atom) if atom.kind is AtomKind.VERB else None
            if clause is None or (k and sentence[k - 1].key == 'after'):
                continue  # `tracks it after climbing to 40 m`
            if asked & set(clause.ids):
                continue  # `but always flies lower than 35 m`
            told = missions & set(clause.ids)
            if atom.key in _CLIMBS and _flown(spec, sentence[k + 1 :]) - begun:
                continue  # `climbs to 45 m and hovers there`: the height of what comes next
            if atom.key in _CLIMBS and begun and not told - begun and not events_in(spec, clause):
                yield clause.span
            if atom.key not in _CLIMBS:
                begun |= told


def hovers_over_movers(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hovers above a truck that drives`, `orbits` it: either stays where that is at first."""
    moving = {a.id for a in spec.agents if any(b.kind in _MOVES for b in a.behaviors)}
    for mission in spec.missions:
        if mission.mode is MissionMode.TRACK and mission.target is not None:
            moving.add(mission.target)  # it drives on: what comes next leaves it
        stays = mission.mode is MissionMode.HOVER or mission.pattern is Pattern.ORBIT
        if not stays or mission.target not in moving:
            continue
        for clause in spec.clauses:
            if mission.id in clause.ids and clause.status is ClauseStatus.ENCODED:
                yield clause.span


def flights_at_once(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`stays 40 m away from the van while it orbits City Hall` that became one after the other."""
    uavs = {m.id: m.uav for m in spec.missions}
    for sentence in sentences(atoms):
        for k, atom in enumerate(sentence):
            if atom.kind is not AtomKind.SUBORDINATOR or atom.key != 'while':
                continue
            verbs = [a for a in sentence[:k] if a.kind is AtomKind.VERB][-1:]
            verbs += [a for a in stretch(sentence, k + 1) if a.kind is AtomKind.VERB]
            if not k and len(verbs) == 1:
                # `while it orbits City Hall, it stays …`
                verbs += [a for a in sentence if a.kind is AtomKind.VERB][1:2]
            flown = [_missions(spec, a) for a in verbs[:2]]
            if len(flown) < 2 or flown[0] & flown[1]:
                continue
            if {uavs[i] for i in flown[0]} & {uavs[i] for i in flown[1]}:
                yield over(atom, verbs[-1] if k else verbs[1])


def formations(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hover 30 m apart`: no more than that, either; `keep them 30 m apart` asks for the least."""
    for condition in spec.conditions:
        exact = condition.value.bound is Bound.EXACTLY and condition.op in ('>', '>=')
        if condition.quantity != QuantityName.SEPARATION or not exact:
            continue
        if condition.value.value < _REFUSED_M:
            continue  # whatever it means, nobody may fly so: what is not read proves nothing
        same = {c.id for c in spec.conditions if (c.of, c.value.value) == _pair(condition)}
        if len(same) > 1:
            continue  # `5 m apart, not closer than 5 m ever`: it says itself what it means
        for clause in spec.clauses:
            told = condition.id in clause.ids and clause.status is ClauseStatus.ENCODED
            text = clause.text.lower()
            if told and ' apart' in text and not _KEPT.search(text):
                yield clause.span


def _pair(condition: StatedCondition) -> tuple[tuple[str, ...], float]:
    return condition.of, condition.value.value


def heights_as_distances(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`when the drone descends below 20 m` that became a distance from somebody."""
    for event in spec.events:
        if not isinstance(event.trigger, DistanceTrigger):
            continue
        for clause in spec.clauses:
            if event.id not in clause.ids or clause.status is not ClauseStatus.ENCODED:
                continue
            cause = [a for a in within(atoms, clause.span) if a.end <= _value_at(event.trigger)]
            if any(a.kind is AtomKind.VERB and a.words.startswith(_HEIGHTS) for a in cause[-2:]):
                yield clause.span


def _value_at(trigger: DistanceTrigger) -> int:
    span = trigger.value_m.span
    return -1 if span is None else span.start


def seen_on_another_flight(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`sees the car 80 % of the time and hovers over the stadium`: from there, not on another."""
    shares = [c for c in spec.conditions if c.quantity == QuantityName.VISIBLE_FRACTION]
    for clause in spec.clauses:
        if not any(c.id in clause.ids for c in shares):
            continue
        verbs = {a.key for a in within(atoms, clause.span) if a.kind is AtomKind.VERB}
        for mission in spec.missions:
            alone = all(m.uav != mission.uav or m is mission for m in spec.missions)
            tracks = mission.mode is MissionMode.TRACK and mission.id in clause.ids
            if tracks and not alone and verbs <= {'see', 'observe'}:
                yield clause.span


def flights_over_nothing(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`flies for 60 s. It tracks a bus` that became a hover before it begins to track."""
    for mission in spec.missions:
        nowhere = mission.mode is MissionMode.HOVER and mission.target is None
        more = [m for m in spec.missions if m.uav == mission.uav and m is not mission]
        if not nowhere or not more:
            continue
        for clause in spec.clauses:
            verbs = [a for a in within(atoms, clause.span) if a.kind is AtomKind.VERB]
            flies = bool(verbs) and verbs[0].key == 'fly' and mission.id in clause.ids
            if flies and clause.status is ClauseStatus.ENCODED:
                yield clause.span


def shared_durations(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`two drones hover, one at 50 m and one at 70 m, for 25 s` that became that of one alone."""
    for sentence in sentences(atoms):
        uavs = [a.noun for a in sentence if a.noun is not None and a.noun.kind is NounKind.UAV]
        both = any(noun.count > 1 for noun in uavs)
        both = both or re.search(r'\bboth\b', _words(spec, sentence)) is not None
        ids = {i for a in sentence if (c := clause_of(spec, a)) is not None for i in c.ids}
        told = [m for m in spec.missions if m.id in ids]
        said = [m for m in told if m.duration_s is not None and _explicit(m.duration_s)]
        if both and said and len({m.uav for m in told}) > len({m.uav for m in said}):
            for mission in said:
                assert mission.duration_s is not None
                if mission.duration_s.span is not None:
                    yield mission.duration_s.span


def while_it_stops(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`while the bus stops, the drone hovers over it`: nothing ties the flight to the stop.

    `As long as the truck is near, the drone tracks it` asks no truck to be near.
    """
    for sentence in sentences(atoms):
        if not sentence or not _AS_LONG.match(_words(spec, sentence)):
            continue
        verbs = [a for a in sentence if a.kind is AtomKind.VERB][:2]
        clause = clause_of(spec, sentence[0]) or (clause_of(spec, verbs[0]) if verbs else None)
        if clause is None or events_in(spec, clause) or not verbs:
            continue
        asked = any(c.id in clause.ids for c in spec.conditions)
        if (asked or verbs[0].key in MOMENTS) and _missions(spec, verbs[-1]):
            yield over(sentence[0], sentence[0]) if asked else over(sentence[0], verbs[0])


def passed_before_a_hover(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`hovers over a junction while a truck approaches it`: that one is past when it hovers."""
    places = {
        m.id
        for m in spec.missions
        if m.mode is MissionMode.HOVER and m.target is not None and is_place(m.target)
    }
    for sentence in sentences(atoms):
        for k, atom in enumerate(sentence):
            if atom.kind is not AtomKind.SUBORDINATOR or atom.key != 'while':
                continue
            verbs = [a for a in sentence[:k] if a.kind is AtomKind.VERB][-1:]
            behind = [a for a in sentence[k + 1 :] if a.kind is AtomKind.VERB]
            verbs += behind[: 1 if k else 2]
            hovers = any(places & _missions(spec, a) for a in verbs)
            for verb in verbs:
                clause = clause_of(spec, verb) if hovers and verb.key in _PASSES else None
                drivers = clause is not None and {a.id for a in spec.agents} & set(clause.ids)
                if clause is not None and drivers and not events_in(spec, clause):
                    yield clause.span


def flown_by_both(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`drone B stays 25 m away from drone A and circles the market`: not drone A as well."""
    flown = {m.id: m.uav for m in spec.missions}
    for sentence in sentences(atoms):
        for k, atom in enumerate(sentence):
            clause = clause_of(spec, atom) if atom.kind is AtomKind.VERB else None
            joined = k > 0 and sentence[k - 1].kind in _JOINS
            if (
                clause is None
                or not joined
                or len({flown[i] for i in clause.ids if i in flown}) < 2
            ):
                continue
            named = [n for n, a in enumerate(sentence[:k]) if _is_one_uav(a)]
            between = sentence[named[-2] : named[-1]] if len(named) > 1 else ()
            if any(a.kind is AtomKind.VERB for a in between):
                yield over(atom, sentence[-1])


def _is_one_uav(atom: Atom) -> bool:
    return atom.noun is not None and atom.noun.kind is NounKind.UAV and atom.noun.count <= 1


def heights_of_both(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`climbs to 60 m when it loses the car it tracks`, and tracks it from 60 m up all along."""
    first = {m.uav: m.altitude_m for m in reversed(spec.missions)}
    flown = {(uav, height.span) for uav, height in first.items() if _explicit(height)}
    acts = [e.action for e in spec.events if isinstance(e.action, UavAction)]
    for act in acts:
        told = None if act.altitude_m is None else act.altitude_m.span
        if told is not None and (act.uav, told) in flown:
            yield told


def standoffs_as_heights(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`tracks the van at 40 m, then climbs to 70 m`: was that 40 m away, or 40 m high?"""
    for mission in spec.missions:
        told = mission.standoff_m
        if mission.mode is not MissionMode.TRACK or told is None or told.span is None:
            continue
        heights = [m.altitude_m for m in spec.missions if m.uav == mission.uav]
        acts = [e.action for e in spec.events if isinstance(e.action, UavAction)]
        heights += [a.altitude_m for a in acts if a.uav == mission.uav and a.altitude_m]
        height = any(map(_explicit, heights)) and not _explicit(mission.altitude_m)
        if height and stands_bare(spec.prompt, told.span):
            yield told.span


def heights_over_fliers(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`another one hovers 12 m above it` that became a hover 12 m above the ground."""
    flying = {uav.id for uav in spec.uavs}
    told = [m.altitude_m.span for m in spec.missions if m.target in flying]
    for measure, place in pairwise(atoms):
        if measure.measure is None or (place.kind, place.key) != (AtomKind.PREPOSITION, 'over'):
            continue
        if Span(start=measure.measure.start, end=measure.measure.end) in told:
            yield over(measure, place)


def heights_from_somebody(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`tracks a van and is 35 m away from it` that became an altitude of 35 m."""
    bounds = [c.value.span for c in spec.conditions if c.quantity == QuantityName.ALTITUDE]
    flown = [m.altitude_m.span for m in spec.missions if m.altitude_m is not None]
    for sentence in sentences(atoms):
        for k, measure in enumerate(sentence):
            if measure.measure is None:
                continue
            own = over(measure, measure)
            bound, height = (
                any(span is not None and meet(span, own) for span in spans)
                for spans in (bounds, flown)
            )
            behind = next(iter(sentence[k + 1 :]), measure)
            before = spec.prompt[sentence[max(0, k - 1)].start : measure.end].lower()
            away = behind.words.startswith(_AWAY)
            if (bound or height) and (away or (bound and behind.words.startswith('of'))):
                yield over(measure, behind)
            elif bound and _APART.search(before):
                yield own


def stays_of_others(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`a truck drives to City Hall and stays there` that became a hover of the drone."""
    missions = {m.id for m in spec.missions}
    for sentence in sentences(atoms):
        doer: Atom | None = None
        told = [a for a in sentence if a.kind is not AtomKind.FILL]
        for before, atom in pairwise(told):
            if atom.kind is not AtomKind.VERB:
                continue
            if before.kind not in _JOINS:
                doer = before if before.is_actor else None
            clause = clause_of(spec, atom)
            stays = atom.key == 'hover' and atom.words.startswith(_STAYS)
            if not stays or clause is None or doer is None or doer.noun is None:
                continue
            if doer.noun.kind in _GROUND and missions & set(clause.ids):
                yield clause.span


def heights_passed_twice(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`descends to 20 m; when it reaches 20 m` that the climb to the first height meets, too."""
    for event in spec.events:
        trigger = event.trigger
        if not isinstance(trigger, AltitudeTrigger):
            continue
        flown = [m.altitude_m for m in spec.missions if m.uav == trigger.uav]
        acts = [e.action for e in spec.events if isinstance(e.action, UavAction)]
        later = [*flown[1:], *(a.altitude_m for a in acts if a.uav == trigger.uav)]
        first_m = flown[0].value if flown else 0.0
        meant = trigger.value_m
        again = any(p is not None and _is(p, meant.value) for p in later)
        if again and meant.value < first_m and meant.span is not None:
            yield meant.span


def _is(parameter: Parameter, value: float) -> bool:
    """Whether a parameter was told to have a value."""
    return parameter.provenance is Provenance.EXPLICIT and parameter.value == value


def _flown(spec: ScenarioSpec, atoms: Sequence[Atom]) -> set[str]:
    """Return the missions of the clauses of some verbs."""
    return {name for a in atoms if a.kind is AtomKind.VERB for name in _missions(spec, a)}


def _missions(spec: ScenarioSpec, verb: Atom) -> set[str]:
    clause = clause_of(spec, verb)
    return set() if clause is None else {m.id for m in spec.missions} & set(clause.ids)


def _words(spec: ScenarioSpec, sentence: Sequence[Atom]) -> str:
    return spec.prompt[sentence[0].start : sentence[-1].end].lower() if sentence else ''


def _explicit(parameter: Parameter) -> bool:
    return parameter.provenance is Provenance.EXPLICIT
