# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Verbs, patterns and relations whose meaning the lexicon knows: a reading may not contradict or
drop them. What the lexicon does not know is the model's to understand.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.constructions.ground import BEHAVIORS
from aurora_core.parsing.llm.facts import PromptFacts, inside, overlap
from aurora_core.parsing.llm.places import is_place
from aurora_core.parsing.llm.reading import Reading
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Pattern,
    Place,
    Relation,
)

_MODES = {
    'hover': MissionMode.HOVER,
    'track': MissionMode.TRACK,
    'follow': MissionMode.TRACK,
    'trail': MissionMode.TRACK,
    'orbit': MissionMode.NAVIGATE,
    'navigate': MissionMode.NAVIGATE,
}
# Verbs with another, weaker meaning: `passes the crossing`, `comes down the road`.
_WEAK = frozenset({'overtake', 'approach', 'come', 'start', 'lead', 'visit'})
# Verbs with one meaning that has to show up somewhere.
_TELLING = frozenset(
    {
        'tailgate',
        'brake',
        'yield',
        'cross',
        'park',
        'change_lane',
        'turn_left',
        'turn_right',
        'emergency_run',
        'circulate',
    }
)
_STILL = (BehaviorKind.PARK, BehaviorKind.STOP, BehaviorKind.WAIT)
# What is said in other words by another relation, or of the other one of two.
_SAID_BY = {
    'ahead': ('behind', 'before', 'same_lane'),
    'behind': ('ahead', 'before', 'same_lane'),
    'beside': ('left', 'right', 'adjacent_lane', 'at', 'near'),
    'left': ('right', 'beside', 'adjacent_lane'),
    'right': ('left', 'beside', 'adjacent_lane'),
    'adjacent_lane': ('left', 'right', 'beside'),
    'same_lane': ('ahead', 'behind', 'before'),
}
_NO_BODIES = (NounKind.STREET, NounKind.SURROUNDINGS, NounKind.UNKNOWN)
# Verbs that are about somebody.
_OF_SOMEBODY = frozenset({'follow', 'tailgate', 'track', 'trail'})
# Relations that prepositions state too.
_BY_PREPOSITION = (Relation.AT, Relation.ON, Relation.BEFORE, Relation.PARKED_AT)
# How one can be placed by a place.
_AT_PLACES = (*_BY_PREPOSITION, Relation.BESIDE, Relation.NEAR)
_BEHIND_ITS_TARGET = ('follow', 'tailgate', 'overtake', 'approach')


class Wording:
    """Compares one reading with the words of the prompt.

    Args:
        reading: What the model says.
        facts: The prompt.
        unread: Clauses that are admitted not to be encoded.
        complaints: Where objections go, worded for the model.
        admitted: Where words go that are not carried, and that may mean something else.
    """

    def __init__(
        self,
        reading: Reading,
        facts: PromptFacts,
        unread: Sequence[Span],
        complaints: list[str],
        admitted: list[Span],
    ) -> None:
        self._admitted = admitted
        self._reading = reading
        self._facts = facts
        self._complaints = complaints
        self._read = [a for a in facts.atoms if not any(inside(a, clause) for clause in unread)]

    def check(self) -> None:
        """Object to contradictions and to what is lost."""
        self._behaviors()
        self._placements()
        self._missions()
        self._lost_verbs()
        self._lost_patterns()
        self._lost_relations()
        self._flag('over_streets', AtomKind.STREETS_FLAG, (AtomKind.STREETS_FLAG,))
        self._flag('ends_in_flight', AtomKind.IN_FLIGHT, (AtomKind.IN_FLIGHT, AtomKind.NEGATION))

    def _within(self, quote: str, kind: AtomKind) -> list[Atom]:
        spans = self._facts.spans(quote)[:1]
        return [
            a for a in self._facts.atoms if a.kind is kind and any(overlap(a, s) for s in spans)
        ]

    def _say(self, where: str, quote: str, wanted: Iterable[str], found: str) -> None:
        told = ' or '.join(sorted(set(wanted)))
        self._complaints.append(f'{where}: {quote!r} says {told}, found {found}')

    def _behaviors(self) -> None:
        for agent in self._reading.agents:
            for i, said in enumerate(agent.behaviors):
                keys = {a.key for a in self._within(said.quote, AtomKind.VERB)}
                known = {BEHAVIORS[key] for key in keys if key in BEHAVIORS}
                if self._within(said.quote, AtomKind.SIREN):
                    known.add(BehaviorKind.EMERGENCY_RUN)
                weak = said.kind is BehaviorKind.DRIVE and bool(keys & _WEAK)
                # One drives, whatever for.
                weak |= known == {BehaviorKind.DRIVE} or known | {said.kind} <= {*_STILL}
                # A vehicle that crosses a place drives over it.
                weak |= agent.type is not AgentType.PEDESTRIAN and keys == {'cross'}
                # Of several verbs in a long quote nobody knows which one is meant.
                if len(known) == 1 and said.kind not in known and not weak:
                    where = f'{agent.id}.behaviors[{i}].kind'
                    self._say(where, said.quote, (k.value for k in known), said.kind.value)

    def _placements(self) -> None:
        for agent in self._reading.agents:
            for i, said in enumerate(agent.placements):
                known = {a.key for a in self._within(said.quote, AtomKind.RELATION)}
                if said.relation in _AT_PLACES and is_place(said.of or ''):
                    continue  # `in front of the school`: near it
                if len(known) == 1 and said.relation not in (*_BY_PREPOSITION, *known):
                    where = f'{agent.id}.placements[{i}].relation'
                    self._say(where, said.quote, known, said.relation.value)

    def _missions(self) -> None:
        for said in self._reading.missions:
            keys = {a.key for a in self._within(said.quote, AtomKind.VERB)}
            for atom in self._within(said.quote, AtomKind.NOUN):
                keys |= set(atom.noun.states) if atom.noun is not None else set()
            modes = {_MODES[key] for key in keys if key in _MODES}
            if len(modes) == 1 and said.mode not in modes:
                self._say(f'{said.id}.mode', said.quote, (m.value for m in modes), said.mode.value)
            patterns = {a.key for a in self._within(said.quote, AtomKind.PATTERN)}
            patterns |= {Pattern.ORBIT.value} if 'orbit' in keys else set()
            if said.mode is not MissionMode.NAVIGATE or not patterns:
                continue
            if said.pattern is None or said.pattern.value not in patterns:
                found = said.pattern.value if said.pattern is not None else 'null'
                self._say(f'{said.id}.pattern', said.quote, patterns, found)

    def _lost_verbs(self) -> None:
        done = {b.kind.value for agent in self._reading.agents for b in agent.behaviors}
        done |= {e.action.do for e in self._reading.events if e.action is not None}
        done |= {f.kind.value for f in self._reading.forbidden if f.kind is not None}
        modes = {mission.mode for mission in self._reading.missions}
        for atom in self._read:
            if atom.kind is not AtomKind.VERB or self._is_denied(atom):
                continue
            mode = _MODES.get(atom.key)
            kind = BEHAVIORS.get(atom.key)
            shown = mode in modes or (kind is not None and kind.value in done)
            shown = shown or (atom.key == 'park' and self._stands())
            shown = shown or (atom.key in ('follow', 'trail') and self._comes_behind())
            if (atom.key in _TELLING or mode is not None) and not shown and self._acts(atom):
                self._complaints.append(
                    f'{self._facts.text(atom)!r} is said and nothing in the answer does it: '
                    'encode it, or make its clause not_encoded'
                )

    def _comes_behind(self) -> bool:
        """Tell whether somebody on the ground is placed behind another: it follows."""
        placed = (p.relation for agent in self._reading.agents for p in agent.placements)
        return Relation.BEHIND in placed

    def _stands(self) -> bool:
        """Tell whether somebody stands somewhere: who is parked may just be placed there."""
        agents = self._reading.agents
        still = any(b.kind in _STILL for agent in agents for b in agent.behaviors)
        beside = (Relation.PARKED_AT.value, Place.ROADSIDE.value)
        return still or any(
            p.of in beside or p.relation.value in beside for a in agents for p in a.placements
        )

    def _acts(self, verb: Atom) -> bool:
        """Tell whether a verb has the meaning of the lexicon here.

        `follows the rules` is about nobody, and a vehicle that `crosses` drives over a place.
        """
        behind = [a for a in self._facts.atoms if a.start >= verb.end]
        behind = [a for a in behind if a.kind is not AtomKind.FILL][:1]
        if verb.key in _OF_SOMEBODY:
            return bool(behind) and (behind[0].is_actor or behind[0].is_place)
        crosses = verb.key == 'cross'
        return not crosses or any(a.type is AgentType.PEDESTRIAN for a in self._reading.agents)

    def _is_denied(self, atom: Atom) -> bool:
        before = [a for a in self._facts.atoms if a.end <= atom.start][-2:]
        return any(a.kind is AtomKind.NEGATION for a in before)

    def _lost_patterns(self) -> None:
        flown = {m.pattern.value for m in self._reading.missions if m.pattern is not None}
        for atom in self._read:
            # Vehicles stand in a line too, and of a route that is told `circular` may be a zone.
            if atom.kind is AtomKind.PATTERN and not flown and atom.key != Pattern.LINE.value:
                self._complaints.append(
                    f'{self._facts.text(atom)!r} is said, and no mission has the pattern '
                    f'{atom.key}'
                )

    def _lost_relations(self) -> None:
        placed = {p.relation.value for agent in self._reading.agents for p in agent.placements}
        placed |= {m.side.value for m in self._reading.missions if m.side is not None}
        kinds = {b.kind.value for agent in self._reading.agents for b in agent.behaviors}
        if kinds & set(_BEHIND_ITS_TARGET):
            placed.add(Relation.BEHIND.value)
        for atom in self._read:
            said = {atom.key, *_SAID_BY.get(atom.key, ())}
            if atom.kind is AtomKind.RELATION and not said & placed:
                if atom.key in (Relation.NEAR.value, Relation.BEFORE.value):
                    continue  # distances and times are said with these words too
                if not (self._is_of_a_moment(atom) or self._by_a_place(atom)):
                    self._admitted.append(Span(start=atom.start, end=atom.end))

    def _is_of_a_moment(self, atom: Atom) -> bool:
        """Tell whether a clause became something that happens or is demanded, or is of UAVs."""
        reading = self._reading
        ids = {e.id for e in reading.events} | {c.id for c in reading.conditions}
        ids |= {f.id for f in reading.forbidden}
        flies = {m.id for m in reading.missions} | {u.id for u in reading.uavs}
        clauses = [c for c in reading.clauses if ids & set(c.ids) or flies >= set(c.ids)]
        return any(overlap(atom, s) for c in clauses for s in self._facts.spans(c.quote))

    def _by_a_place(self, atom: Atom) -> bool:
        """`in front of the school`: of a place all are nearness; a street has sides."""
        behind = next((a for a in self._facts.atoms if a.start >= atom.end), None)
        if behind is not None and behind.noun is not None and behind.noun.kind in _NO_BODIES:
            return True
        placed = (p.of for agent in self._reading.agents for p in agent.placements)
        return behind is not None and behind.is_place and any(is_place(of or '') for of in placed)

    def _flag(self, name: str, stated: AtomKind, allowed: tuple[AtomKind, ...]) -> None:
        missions = [m.id for m in self._reading.missions if getattr(m, name)]
        words = [a for a in self._read if a.kind is stated]
        streets = any(a.noun is not None and a.noun.kind is NounKind.STREET for a in self._read)
        grounds = any(a.kind in allowed for a in self._read) or (
            stated is AtomKind.STREETS_FLAG and streets
        )
        if missions and not grounds:
            self._complaints.append(f'{missions[0]}.{name}: the prompt does not say so')
        routes = [m for m in self._reading.missions if m.mode is MissionMode.NAVIGATE]
        over = stated is AtomKind.STREETS_FLAG and (
            not routes or any(m.target == Place.MAIN_ROAD.value for m in routes)
        )
        if words and not missions and not over:
            self._complaints.append(
                f'{self._facts.text(words[0])!r} is said: a mission needs {name} true'
            )
