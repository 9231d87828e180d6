# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Actors of a reading against the actors of the prompt: none invented, none lost."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import takewhile

from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.lexicon import Tag, shipped_lexicon
from aurora_core.parsing.llm.asides import speaks
from aurora_core.parsing.llm.facts import PromptFacts, inside, overlap
from aurora_core.parsing.llm.reading import AgentReading, MissingReading, Reading, UavReading
from aurora_core.parsing.resolver import MOST_AGENTS
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import AgentType

_FLYING_VERBS = frozenset({'hover', 'track', 'orbit', 'navigate', 'fly', 'observe'})
# What somebody of a type may be called as well, once named: `a police van … the van`.
_ALSO_CALLED = {
    AgentType.AMBULANCE: ('car', 'truck', 'van'),
    AgentType.BICYCLE: ('motorcycle', 'pedestrian'),  # `the bike`, `this person`
    AgentType.FIRETRUCK: ('truck',),
    AgentType.MOTORCYCLE: ('bicycle', 'pedestrian'),
    AgentType.POLICE: ('car', 'motorcycle', 'van'),
    AgentType.TRUCK: ('van',),
    AgentType.VAN: ('car', 'truck'),
}
_ARTICLES = frozenset({'a', 'an', 'the'})
_ON_FOOT = (AgentType.PEDESTRIAN, AgentType.RSU)
# `vehicle V2`, `car B`: somebody of a name.
_DESIGNATION = re.compile(r'\d|\b[A-Z]\b')
_OTHERS = re.compile(r'(?:the )?(?:those|others?|rest|remaining|some)\b', re.IGNORECASE)
# What may stand between the two of `a white and a black van`.
_JOINED = (AtomKind.FILL, AtomKind.COMMA, AtomKind.CONJUNCTION)
_UNAVAILABLE = (NounKind.UNSUPPORTED, NounKind.UNKNOWN, NounKind.MISSING_LANDMARK)


class Anchors:
    """The words that each actor of one reading stands for.

    Args:
        facts: The prompt.
        complaints: Where objections go, worded for the model.
    """

    def __init__(self, facts: PromptFacts, complaints: list[str]) -> None:
        self._facts = facts
        self._complaints = complaints
        self._atoms: dict[str, Atom] = {}

    def count(self, atom: Atom) -> int:
        """Return how many actors of the reading were anchored in some words."""
        return self._taken(atom)

    def of(self, actor_id: str) -> Atom | None:
        """Return the words that an actor of the reading was anchored in."""
        return self._atoms.get(actor_id)

    def read(self, reading: Reading, unread: Sequence[Span]) -> None:
        """Anchor every actor; object to those without words and to words without an actor."""
        actors: tuple[AgentReading | UavReading, ...] = (*reading.agents, *reading.uavs)
        for actor in actors:
            self._anchor(actor)
        for atom in self._facts.actors:
            if not any(inside(atom, clause) for clause in unread):
                self._lost(atom, actors, reading.missing)

    def _anchor(self, actor: AgentReading | UavReading) -> None:
        spans = self._facts.spans(actor.quote)
        what = 'a UAV' if isinstance(actor, UavReading) else f'a {actor.type.value}'
        if not spans:
            self._complaints.append(
                f'{actor.id}: the quote {actor.quote!r} is not in the prompt; an actor needs '
                'words of the prompt that name it'
            )
            return
        named = [a for a in self._facts.actors if any(overlap(a, s) for s in spans)]
        named = named or self._shared_heads(spans) or self._others(spans, actor)
        named = [a for a in named if not self._facts.is_denied(a)]
        fitting = [a for a in named if a.noun is not None and self._may_name(a.noun, actor)]
        if not fitting and isinstance(actor, UavReading):
            seen = self._flying_without_a_name()
            fitting = [a for a in seen if any(overlap(a, s) for s in spans)]
        if not fitting:
            self._complaints.append(
                f'{actor.id}: {actor.quote!r} does not name {what}; add no actor that the prompt '
                'does not name, and put types that do not exist here into missing'
            )
            return
        # `car` may stand for `car` before it stands for `my car`.
        fitting.sort(key=lambda a: all((a.start, a.end) != (s.start, s.end) for s in spans))
        free = [a for a in fitting if self._taken(a) < self._room(a)]
        if not free:
            self._complaints.append(
                f'{actor.id}: {actor.quote!r} names {self._room(fitting[0])}, and there are more'
            )
            return
        if self._is_again(free[0], actor) and _DESIGNATION.search(actor.quote) is None:
            self._complaints.append(
                f'{actor.id}: {self._facts.text(free[0])!r} means the {what[2:]} already named: '
                'use its id'
            )
            return
        self._atoms[actor.id] = free[0]

    def _may_name(self, noun: NounPhrase, actor: AgentReading | UavReading) -> bool:
        """`the lead vehicle of four vans` is a van."""
        if _names(noun, actor) or isinstance(actor, UavReading):
            return _names(noun, actor)
        types = {a.noun.key for a in self._facts.actors if a.noun and a.noun.plural}
        return noun.kind is NounKind.VEHICLE and actor.type.value in types

    def _flying_without_a_name(self) -> list[Atom]:
        """Return words that need a UAV: `from above`; where none is named, `hover over …`."""
        seen = [a for a in self._facts.atoms if a.kind is AtomKind.AERIAL]
        if any(a.noun is not None and a.noun.kind is NounKind.UAV for a in self._facts.actors):
            return seen
        verbs = [a for a in self._facts.atoms if a.kind is AtomKind.VERB]
        return seen + [a for a in verbs if a.key in _FLYING_VERBS]

    def _shared_heads(self, spans: Sequence[Span]) -> list[Atom]:
        """`a white | and a black van`: the noun is that of the one told last."""
        behind = [a for a in self._facts.atoms if a.start >= spans[0].end]
        joined = takewhile(lambda a: a.kind in _JOINED, behind)
        rest = behind[len(list(joined)) :]
        return [a for a in rest[:1] if a in self._facts.actors and self._told_before(a)]

    def _others(self, spans: Sequence[Span], actor: AgentReading | UavReading) -> list[Atom]:
        """`cars that hear it … | those out of range`: more of a kind told in the plural."""
        if _OTHERS.match(self._facts.text(spans[0])) is None:
            return []
        before = [a for a in self._facts.actors if a.end <= spans[0].start]
        return [
            a for a in before if a.noun is not None and a.noun.plural and _names(a.noun, actor)
        ]

    def _told_before(self, atom: Atom) -> int:
        """Return how many are told by words that share the noun of another one."""
        before = [a for a in self._facts.atoms if a.end <= atom.start]
        joined = list(takewhile(lambda a: a.kind in _JOINED, reversed(before)))
        words = [a.kind is AtomKind.FILL and a.key not in _ARTICLES for a in joined]
        return sum(words) if any(a.kind is AtomKind.CONJUNCTION for a in joined[:2]) else 0

    def _room(self, atom: Atom) -> int:
        if atom.noun is None:
            return 1
        count = atom.noun.count or (MOST_AGENTS if atom.noun.plural else 1)
        return count + self._told_before(atom)

    def _taken(self, atom: Atom) -> int:
        return sum(known is atom for known in self._atoms.values())

    def _is_again(self, atom: Atom, actor: AgentReading | UavReading) -> bool:
        """`the van` behind `a van`: a mention, not another one."""
        noun = atom.noun
        if noun is None or noun.determiner not in (Determiner.DEFINITE, Determiner.BARE):
            return False
        if noun.plural or noun.index or noun.labels or noun.count or noun.background:
            return False
        return any(
            known is not atom
            and known.start < atom.start
            and known.noun is not None
            and known.noun.kind is noun.kind
            and known.noun.key == noun.key
            for known in self._atoms.values()
        )

    def _rides(self, atom: Atom) -> bool:
        """`a girl on a bicycle`: one body, told by two nouns."""
        behind = [a for a in self._facts.atoms if a.start >= atom.end][:2]
        on = len(behind) == 2 and (
            behind[0].key in ('on', 'in') or behind[0].kind is AtomKind.VERB
        )
        return on and self._taken(behind[1]) > 0

    def _lost(
        self,
        atom: Atom,
        actors: Iterable[AgentReading | UavReading],
        missing: Iterable[MissingReading],
    ) -> None:
        noun = atom.noun
        if noun is None:
            return
        words = self._facts.text(atom)
        if noun.kind in (NounKind.UNSUPPORTED, NounKind.AMBIGUOUS):
            named = any(
                overlap(atom, span) for m in missing for span in self._facts.spans(m.quote)
            )
            if not named:
                wanted = 'missing' if noun.kind is NounKind.UNSUPPORTED else 'a question'
                self._complaints.append(f'{words!r} is no agent type: expected {wanted}')
            return
        if self._facts.is_denied(atom) or speaks(atom) or _is_flight(noun):
            return
        if noun.key == AgentType.PEDESTRIAN.value and self._rides(atom):
            return
        fitting = [actor for actor in actors if may_mean(noun, actor)]
        stated = noun.count > 1 and noun.determiner is Determiner.BARE
        stated = stated and len(fitting) != noun.count  # `two vehicles, a car and a van`
        if not fitting:
            self._complaints.append(f'{words!r} names an actor, and the answer has none for it')
        elif stated and noun.count <= MOST_AGENTS and self._taken(atom) != noun.count:
            self._complaints.append(
                f'{words!r}: expected {noun.count} actors that quote it, found {self._taken(atom)}'
            )


def check_missing(reading: Reading, facts: PromptFacts, complaints: list[str]) -> tuple[Atom, ...]:
    """Return the words for what does not exist here; object to those that do exist."""
    found: list[Atom] = []
    for one in reading.missing:
        spans = facts.spans(one.quote)
        beside = [a for a in facts.atoms if any(overlap(a, s) for s in spans)]
        known = [a for a in beside if a.noun is not None and a.noun.kind not in _UNAVAILABLE]
        lacking = [
            a
            for a in beside
            if a.kind is AtomKind.UNKNOWN or (a.noun is not None and a.noun.kind in _UNAVAILABLE)
        ]
        if known or not lacking:
            complaints.append(f'missing: {one.quote!r} does not name something that is missing')
        else:
            found.append(lacking[0])
    return tuple(found)


def is_ego(noun: NounPhrase) -> bool:
    """Return whether a noun phrase means the ego vehicle."""
    if noun.kind is NounKind.EGO:
        return True
    vehicle = noun.kind in (NounKind.AGENT, NounKind.VEHICLE)
    return vehicle and (noun.determiner is Determiner.MY or 'ego' in noun.labels)


def _is_flight(noun: NounPhrase) -> bool:
    """Tell whether a noun may as well be what a UAV does: `resumes the patrol`."""
    senses = shipped_lexicon().senses(tuple(noun.head_text.split()[-1:]))
    return any(s.tag is Tag.VERB and s.key in _FLYING_VERBS for s in senses)


def may_mean(noun: NounPhrase, actor: AgentReading | UavReading) -> bool:
    """Tell whether a mention may mean an actor: by its type, or once named by a wider word."""
    if _names(noun, actor) or isinstance(actor, UavReading):
        return _names(noun, actor)
    if noun.kind is NounKind.VEHICLE:
        return actor.type not in _ON_FOOT
    again = noun.determiner in (Determiner.BARE, Determiner.DEFINITE, Determiner.MY)
    again = again and not (noun.plural or noun.count)
    return again and noun.key in _ALSO_CALLED.get(actor.type, ())


def _names(noun: NounPhrase, actor: AgentReading | UavReading) -> bool:
    if isinstance(actor, UavReading):
        return noun.kind is NounKind.UAV
    if noun.kind is NounKind.AGENT:
        return noun.key == actor.type.value
    # Nobody says what kind of vehicle it is: then it is a car.
    return noun.kind in (NounKind.EGO, NounKind.VEHICLE) and actor.type is AgentType.CAR
