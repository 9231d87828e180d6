# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One clause as predicate, subject and adjuncts, and what of it was understood."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from aurora_core.parsing.adjunct_reader import AdjunctReader, fits
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.measures import LENGTH, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Piece
from aurora_core.parsing.pronouns import Fits, anything
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import Entity, Scene
from aurora_core.parsing.subjects import split_subject
from aurora_core.spec.parameter import Span

_TRANSITIVE = frozenset(
    {
        'follow',
        'tailgate',
        'overtake',
        'approach',
        'lead',
        'trail',
        'track',
        'observe',
        'orbit',
        'alert',
        'send',
        'report',
        'see',
        'receive',
        'navigate',
        'visit',
        'reach',
        'trace',
        'cross',
        'circulate',
        'lose',
        'put',
        'fly',
    }
)
# What is done to others only.
_OF_OTHERS = frozenset({'follow', 'track', 'tailgate', 'overtake', 'trail', 'observe', 'approach'})
# Marks and nouns that add nothing when no construction takes them.
_NEUTRAL_MARKS = frozenset({'scenario', 'world_noun', 'route', 'frame', 'from_start'})
_NEUTRAL_NOUNS = frozenset({NounKind.SURROUNDINGS, NounKind.STREET})


class Frame:
    """A clause ready for the constructions."""

    def __init__(self, piece: Piece, scene: Scene, resolver: Resolver) -> None:
        self.piece = piece
        self.scene = scene
        self.resolver = resolver
        atoms = piece.atoms
        at = next((i for i, a in enumerate(atoms) if a.kind is AtomKind.VERB), None)
        self.verb: Atom | None = None if at is None else atoms[at]
        before = atoms if at is None else atoms[:at]
        after = () if at is None else atoms[at + 1 :]
        self.negated = any(
            a.kind is AtomKind.NEGATION and not _of_weather(atoms, i) for i, a in enumerate(atoms)
        )
        self.subject_nouns, rest = split_subject(before, scene.prompt)
        ahead = AdjunctReader(rest).read()
        # By place in the sentence: reordered words keep the characters that they were read from.
        self._ahead = frozenset(id(a) for a in ahead)
        self.adjuncts = ahead + AdjunctReader(after).read()
        self.flagged: list[tuple[int, int]] = []
        self.avoid: tuple[Entity, ...] = ()
        self.watched = False  # the effect of something that a UAV can see
        self.heir: Entity | None = None  # who acts when the clause names nobody
        self._deny_weather(atoms)
        self._named_values()
        self._owner()
        self._impersonal()
        self.passive = self._is_passive(before)
        self._reorder()
        self._later_verbs(after)
        self.avoid = self._itself()

    @property
    def key(self) -> str:
        """Meaning of the predicate, empty for a clause without one."""
        return self.verb.key if self.verb is not None else ''

    @property
    def span(self) -> Span:
        """Characters of the clause."""
        return Span(start=self.piece.start, end=self.piece.end)

    def _deny_weather(self, atoms: Sequence[Atom]) -> None:
        """`no rain` beside other words: what is denied is not asked for."""
        denied = {atoms[i + 1].start for i in range(len(atoms)) if _of_weather(atoms, i)}
        self.adjuncts = [a for a in self.adjuncts if a.start not in denied]

    def _named_values(self) -> None:
        """`the radius is 80 m`: name and number stand on two sides of the verb."""
        if self.key != 'be' or self.verb is None:
            return
        for name, value in self._around_the_verb():
            around = id(name) in self._ahead and id(value) not in self._ahead
            thing = name.kind is AdjunctKind.MARK and name.key == 'thing'
            measure = value.measure
            plain = value.kind in (AdjunctKind.MEASURE, AdjunctKind.ATTRIBUTE)
            if around and thing and plain and measure is not None and fits(name.value, measure):
                name.kind, name.key, name.measure = AdjunctKind.ATTRIBUTE, name.value, measure
                name.prep = value.prep
                self.adjuncts.remove(value)

    def _owner(self) -> None:
        """`the flying height of the drone is 40 m`: who has the value is whom it is about."""
        if self.subject_nouns:
            return
        for adjunct in self.adjuncts:
            told = adjunct.value if adjunct.kind is AdjunctKind.MARK else adjunct.key
            if told not in ('altitude', 'speed') or not adjunct.nouns:
                continue
            between = self.scene.prompt[adjunct.start : adjunct.nouns[0].start].lower().split()
            belongs = 'of' in between or adjunct.nouns[0].start < adjunct.start
            in_front = self.verb is not None and id(adjunct) in self._ahead
            if in_front and belongs and all(n.kind in ACTORS for n in adjunct.nouns):
                self.subject_nouns, adjunct.nouns = adjunct.nouns, ()
                return

    def _around_the_verb(self) -> list[tuple[Adjunct, Adjunct]]:
        """Neighbours, and `the range from the drone to the ego is 300 m`: its first measure."""
        pairs = list(pairwise(self.adjuncts))
        names = [a for a in self.adjuncts if a.kind is AdjunctKind.MARK and a.key == 'thing']
        measures = [a for a in self.adjuncts if a.measure is not None]
        if len(names) == len(measures) == 1:
            pairs.append((names[0], measures[0]))
        return pairs

    def _impersonal(self) -> None:
        """`it is foggy`: the pronoun means nobody."""
        world = any(
            a.kind is AdjunctKind.MARK and a.key == AtomKind.WORLD.value for a in self.adjuncts
        )
        # `it is the van that the drone tracks`
        cleft = self.key == 'be' and self.piece.atoms[-1].kind is AtomKind.RELATIVE
        if cleft or (world and self.key in ('be', 'come', 'keep', '')):
            self.subject_nouns = tuple(
                n for n in self.subject_nouns if n.kind is not NounKind.PRONOUN
            )

    def _is_passive(self, before: Sequence[Atom]) -> bool:
        if self.verb is None or self.verb.form is not VerbForm.PAST or self.key not in _TRANSITIVE:
            return False
        helped = any(
            a.kind is AtomKind.AUXILIARY and a.key in ('be', 'get', 'have') for a in before
        )
        by = any(self._agentive(a) for a in self.adjuncts)
        helpers = ('be',) if self.key == 'lose' else ('be', 'get')  # `the packets get lost`
        is_be = any(a.kind is AtomKind.AUXILIARY and a.key in helpers for a in before)
        return (helped and is_be) or by

    @staticmethod
    def _agentive(adjunct: Adjunct) -> bool:
        return adjunct.kind is AdjunctKind.PHRASE and adjunct.key == 'by'

    def _reorder(self) -> None:
        """Passive voice and inversion: put subject and object where the active voice has them."""
        if self.passive:
            patient = self.subject_nouns
            by = next((a for a in self.adjuncts if self._agentive(a)), None)
            self.subject_nouns = by.nouns if by is not None else ()
            if by is not None:
                by.used = True
            if not patient and self.piece.head is not None and self.piece.head.noun is not None:
                patient = (self.piece.head.noun,)
            if patient:
                self.adjuncts.insert(
                    0,
                    Adjunct(
                        kind=AdjunctKind.OBJECT,
                        key='',
                        start=patient[0].start,
                        end=patient[-1].end,
                        nouns=patient,
                    ),
                )
            return
        verb = self.verb
        fronted = verb is not None and any(
            a.kind in (AdjunctKind.PLACE, AdjunctKind.PHRASE) and a.end <= verb.start
            for a in self.adjuncts
        )
        if (
            not self.subject_nouns
            and fronted
            and self.verb is not None
            and self.verb.form is VerbForm.THIRD
            and self.adjuncts[0].end <= self.verb.start
        ):  # `behind it follows an ambulance`
            inverted = next(
                (
                    a
                    for a in self.adjuncts
                    if a.kind is AdjunctKind.OBJECT and a.start >= self.verb.end
                ),
                None,
            )
            if inverted is not None:
                self.subject_nouns = inverted.nouns
                inverted.used = True

    def _itself(self) -> tuple[Entity, ...]:
        """`until a bus comes, then it follows the bus`: nobody follows himself."""
        pronoun = any(n.kind is NounKind.PRONOUN and n.key == 'it' for n in self.subject_nouns)
        if not pronoun or self.key not in _OF_OTHERS:
            return ()
        named = [n for a in self.free(AdjunctKind.OBJECT) for n in a.nouns]
        return tuple(
            e
            for e in self.scene.agents
            for n in named
            if n.key == e.type.value and n.determiner is Determiner.DEFINITE and not n.plural
        )

    def _later_verbs(self, after: Sequence[Atom]) -> None:
        """`stops moving`: a second predicate that was not cut off says nothing new or is loose."""
        for adjunct in self.adjuncts:
            if adjunct.kind is AdjunctKind.MARK and adjunct.key == AtomKind.VERB.value:
                adjunct.used = adjunct.value == 'drive' and self.key in ('stop', 'start')
                if adjunct.value in ('be', 'last') and self.verb is not None:
                    # `tracking must be within tolerance`: the participle is the subject
                    adjunct.used = self.verb.form is VerbForm.ING and not self.subject_nouns

    # --- who ----------------------------------------------------------------------------------

    def subjects(self, accept: Fits = anything) -> tuple[Entity, ...]:
        """Return the acting entities: named here, by the head noun, or by the clause before."""
        found: tuple[Entity, ...] = ()
        if self.subject_nouns:
            named = [n for n in self.subject_nouns if n.kind is not NounKind.UNKNOWN]
            found = self.resolver.actors(named, accept=accept, exclude=self.avoid)
            found = tuple(e for e in found if accept(e))
        elif self.piece.head is not None and self.piece.head.noun is not None and not self.passive:
            found = self.resolver.actors((self.piece.head.noun,), accept=accept)
            found = tuple(e for e in found if accept(e))
            found = found or self.inherited(accept)
        elif not self.passive:
            found = self.inherited(accept)
        self.scene.clause.subjects = found
        return found

    def inherited(self, accept: Fits = anything) -> tuple[Entity, ...]:
        """Return the subjects of the clause before that fit."""
        if self.heir is not None:
            return (self.heir,) if accept(self.heir) else ()
        earlier = [
            c
            for c in reversed(self.scene.clauses[:-1])
            if c.sentence == self.piece.sentence or self.piece.then
        ]
        for clause in sorted(earlier, key=lambda c: c.describes):  # main clauses first
            fitting = tuple(e for e in clause.topic if accept(e))
            if fitting:
                return fitting
        return ()

    def patient(self, accept: Fits) -> tuple[Entity, ...]:
        """Return whom the sentence is about: `… and is followed and filmed by a drone`."""
        for clause in self.scene.clauses[:-1]:
            fitting = tuple(e for e in clause.topic if accept(e))
            if clause.sentence == self.piece.sentence and fitting and not clause.describes:
                return fitting
        return ()

    def objects(
        self, nouns: Sequence[NounPhrase], accept: Fits = anything, *, fronted: bool = False
    ) -> tuple[Entity, ...]:
        """Return actors named as objects and remember them for pronouns."""
        found = self.resolver.actors(
            nouns, accept=accept, exclude=self.scene.clause.subjects, as_object=not fronted
        )
        known = self.scene.clause.objects
        self.scene.clause.objects = known + tuple(e for e in found if e not in known)
        return found

    # --- adjuncts -----------------------------------------------------------------------------

    def free(self, kind: AdjunctKind, *keys: str) -> list[Adjunct]:
        """Return adjuncts of a kind that no construction took yet."""
        return [
            a
            for a in self.adjuncts
            if not a.used and a.kind is kind and (not keys or a.key in keys)
        ]

    def take(self, kind: AdjunctKind, *keys: str) -> Adjunct | None:
        """Take the first free adjunct of a kind."""
        found = self.free(kind, *keys)
        if not found:
            return None
        found[0].used = True
        return found[0]

    def attribute(self, *names: str) -> Adjunct | None:
        """Return the first free attribute of one of the names."""
        found = self.free(AdjunctKind.ATTRIBUTE, *names)
        return found[0] if found else None

    def measure(self, dimension: str, *preps: str) -> Adjunct | None:
        """Return the first free single measure with one of the prepositions, if any are given."""
        for adjunct in self.free(AdjunctKind.MEASURE, dimension):
            measure = adjunct.measure
            single = measure is not None and measure.second is None
            if single and (not preps or adjunct.prep in preps):
                return adjunct
        return None

    def length(self, *preps: str) -> Adjunct | None:
        """Return the first free length."""
        return self.measure(LENGTH, *preps)

    def time(self, *preps: str) -> Adjunct | None:
        """Return the first free time."""
        return self.measure(TIME, *preps)

    def mark(self, kind: str, *values: str) -> Adjunct | None:
        """Take a mark of a kind."""
        for adjunct in self.free(AdjunctKind.MARK, kind):
            if not values or adjunct.value in values:
                adjunct.used = True
                return adjunct
        return None

    def has_mark(self, kind: str, *values: str) -> bool:
        """Return whether a mark of a kind stands in the clause."""
        return any(
            a.kind is AdjunctKind.MARK and a.key == kind and (not values or a.value in values)
            for a in self.adjuncts
        )

    def taken(self) -> None:
        """Note that every word of the clause was understood."""
        for adjunct in self.adjuncts:
            adjunct.used = True
        self.subject_nouns = tuple(n for n in self.subject_nouns if n.kind is not NounKind.UNKNOWN)

    def flag(self, start: int, end: int) -> None:
        """Note characters that were not understood although their clause was."""
        self.flagged.append((start, end))

    # --- what is left -------------------------------------------------------------------------

    def leftovers(self) -> list[Span]:
        """Return what no construction understood, neighbours joined."""
        loose = [_words(a) for a in self.adjuncts if not a.used and not self._is_neutral(a)]
        loose += self.flagged
        for noun in self.nouns():
            loose += noun.loose
        loose += [(n.start, n.end) for n in self.subject_nouns if n.kind is NounKind.UNKNOWN]
        merged: list[tuple[int, int]] = []
        # Words that were put in another order may end before they begin.
        for start, end in sorted((min(ends), max(ends)) for ends in loose):
            if merged and not self.scene.prompt[merged[-1][1] : start].strip(' ,-'):
                merged[-1] = (merged[-1][0], max(end, merged[-1][1]))
            elif not merged or start >= merged[-1][1]:
                merged.append((start, end))
        return [Span(start=s, end=e) for s, e in merged]

    def nouns(self) -> list[NounPhrase]:
        """Return every noun phrase of the clause once."""
        nouns = list(self.subject_nouns)
        for adjunct in self.adjuncts:
            nouns += adjunct.nouns
        return [n for i, n in enumerate(nouns) if n not in nouns[:i]]

    @staticmethod
    def _is_neutral(adjunct: Adjunct) -> bool:
        if adjunct.measure is not None:
            return False
        if adjunct.kind is AdjunctKind.MARK:
            thing = adjunct.key == 'thing' and not adjunct.nouns
            return thing or adjunct.key in _NEUTRAL_MARKS
        return bool(adjunct.nouns) and all(
            n.kind in _NEUTRAL_NOUNS or (n.kind is NounKind.PRONOUN and n.key == 'there')
            for n in adjunct.nouns
        )


def _words(adjunct: Adjunct) -> tuple[int, int]:
    """Where the words of an adjunct stand: of one put in by rewriting, those of its nouns."""
    if adjunct.start != adjunct.end or not adjunct.nouns:
        return adjunct.start, adjunct.end
    return min(n.start for n in adjunct.nouns), max(n.end for n in adjunct.nouns)


def _of_weather(atoms: Sequence[Atom], i: int) -> bool:
    """`no rain`, `without fog`: the negation is about one word only."""
    here = atoms[i].kind is AtomKind.NEGATION and atoms[i].key in ('no', 'without')
    if not here or i + 1 >= len(atoms):
        return False
    return atoms[i + 1].kind is AtomKind.WORLD and atoms[i + 1].key.startswith('weather')
