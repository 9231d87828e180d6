# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of a noun phrase: what may stand before its head, and the head."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from aurora_core.parsing.atoms import Determiner, NounKind
from aurora_core.parsing.lexicon import Lexicon, Sense, Tag
from aurora_core.parsing.measures import COUNT, MeasureReader
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.tokens import Token, TokenKind
from aurora_core.spec.parameter import Bound

NOUN_KINDS = {
    Tag.EGO: NounKind.EGO,
    Tag.UAV: NounKind.UAV,
    Tag.AGENT: NounKind.AGENT,
    Tag.VEHICLE: NounKind.VEHICLE,
    Tag.UNSUPPORTED: NounKind.UNSUPPORTED,
    Tag.AMBIGUOUS: NounKind.AMBIGUOUS,
    Tag.PLACE: NounKind.PLACE,
    Tag.STREET: NounKind.STREET,
    Tag.SURROUNDINGS: NounKind.SURROUNDINGS,
    Tag.LANDMARK_NOUN: NounKind.MISSING_LANDMARK,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class NounWords:
    """Tokens with their spelling put right, and what the lexicon and the measures say of them."""

    tokens: Sequence[Token]
    words: Sequence[str]
    lexicon: Lexicon
    measures: MeasureReader

    def longest(self, i: int, *tags: Tag) -> tuple[int, Sense] | None:
        """Return the longest phrase of one of the classes at word i, and its length in words."""
        return self.lexicon.longest_of(self.words, i, tags)

    def has(self, i: int, *tags: Tag) -> bool:
        """Return whether a phrase of one of the classes begins at word i."""
        return self.longest(i, *tags) is not None

    def matches(self, i: int) -> Sequence[tuple[int, tuple[Sense, ...]]]:
        """Return all known phrases at word i, longest first."""
        return self.lexicon.matches(self.words, i)

    def is_predicate(self, i: int) -> bool:
        """Return whether a verb in the third person stands there."""
        return any(
            s.tag is Tag.VERB and s.form is VerbForm.THIRD
            for _, senses in self.matches(i)
            for s in senses
        )

    def is_unknown(self, i: int) -> bool:
        """Return whether nobody knows the word."""
        return self.tokens[i].kind is TokenKind.WORD and not self.matches(i)


class Head(NamedTuple):
    """What a noun phrase is about.

    Attributes:
        kind: What sort of thing it names.
        key: Type, or name of the landmark.
        text: Its words.
        plural: The noun is in the plural.
        stop: Index of the word behind it.
    """

    kind: NounKind
    key: str
    text: str
    plural: bool
    stop: int


class HeadReader:
    """Reads the heads of noun phrases."""

    def __init__(self, said: NounWords, landmarks: Mapping[tuple[str, ...], str]) -> None:
        self._said = said
        self._landmarks = landmarks
        self._longest_landmark = max((len(words) for words in landmarks), default=0)

    def read(self, j: int) -> Head | None:
        """Return the head that starts at word j, None if none does."""
        named = self._landmark(j)
        matches = self._said.matches(j)
        if named is not None and (not self._is_agent_beyond(matches, named[1] - j)):
            name, stop = named
            return Head(NounKind.LANDMARK, name, name, False, stop)
        if not matches:
            return None
        length, senses = matches[0]
        if length > 1 and self._acts_here(j, length):
            length, senses = matches[-1]
        for tag, kind in NOUN_KINDS.items():
            for sense in senses:
                if sense.tag is tag and not self._is_verb_here(j, senses, length):
                    text = ' '.join(self._said.words[j : j + length])
                    return Head(kind, sense.key, text, sense.plural, j + length)
        return None

    @staticmethod
    def _is_agent_beyond(matches: Sequence[tuple[int, tuple[Sense, ...]]], length: int) -> bool:
        """`a school bus` is no school, although the map has one."""
        return bool(matches) and matches[0][0] > length and matches[0][1][0].tag is Tag.AGENT

    def _acts_here(self, j: int, length: int) -> bool:
        """`a pedestrian crossing at the …`: somebody who crosses, not the place."""
        after = self._said.words[j + length] if j + length < len(self._said.words) else ''
        person = self._said.has(j, Tag.PLACE) and any(
            s.tag is Tag.AGENT for s in self._said.lexicon.senses((self._said.words[j],))
        )
        return person and after in ('at', 'the', 'a', 'in', 'on', 'over', 'from')

    def _is_verb_here(self, j: int, senses: tuple[Sense, ...], length: int) -> bool:
        """`tank`, `crane`, `zone` are nouns; `crossing` before a noun phrase is a verb."""
        if not any(s.tag is Tag.VERB for s in senses):
            return False
        before = self._said.words[j - 1] if j else ''
        after = self._said.words[j + length] if j + length < len(self._said.words) else ''
        article = (Tag.DEFINITE, Tag.INDEFINITE, Tag.LABEL)
        if j and self._said.has(j - 1, *article):
            return False
        articles = ('the', 'a', 'an', 'at', 'in', 'over')
        return after in articles or before not in ('at', 'to', 'zebra', 'pedestrian', 'on', 'near')

    def _landmark(self, j: int) -> tuple[str, int] | None:
        for length in range(min(self._longest_landmark, len(self._said.words) - j), 0, -1):
            name = self._landmarks.get(tuple(self._said.words[j : j + length]))
            if name is not None:
                return name, j + length
        return None

    def behind_place(self, kind: NounKind, stop: int) -> int:
        """`the hospital's roof`, `the hospital helipad`: the part adds nothing."""
        if kind is not NounKind.LANDMARK:
            return stop
        j = stop + 1 if stop < len(self._said.words) and self._said.words[stop] == "'s" else stop
        part = self._said.longest(j, Tag.PLACE_PART)
        return stop if part is None else j + part[0]


def prefix(said: NounWords, j: int, determiner: Determiner) -> tuple[str, str, int] | None:
    """Return what the word at j says of the noun: a class, its value and the next index."""
    if tuple(said.words[j : j + 2]) == ('the', 'other'):
        return 'determiner', Determiner.OTHER, j + 2
    matches = said.matches(j)
    tags = {s.tag: (length, s) for length, senses in reversed(matches) for s in senses}
    for tag, value in (
        (Tag.ANOTHER, Determiner.ANOTHER),
        (Tag.ALL, Determiner.ALL),
        (Tag.EGO_POSSESSIVE, Determiner.MY),
    ):
        if tag in tags:
            return 'determiner', value, j + tags[tag][0]
    if Tag.COLLECTIVE in tags:
        return 'label', '', j + tags[Tag.COLLECTIVE][0]
    if Tag.BACKGROUND in tags:
        return 'background', '', j + tags[Tag.BACKGROUND][0]
    counted = _count(said, j)
    if counted is not None:
        return 'count', str(counted[0]), counted[1]
    if determiner in (Determiner.BARE,):
        if Tag.DEFINITE in tags:
            return 'determiner', Determiner.DEFINITE, j + tags[Tag.DEFINITE][0]
        if Tag.INDEFINITE in tags:
            return 'determiner', Determiner.INDEFINITE, j + tags[Tag.INDEFINITE][0]
    if Tag.ORDINAL in tags:
        return 'ordinal', tags[Tag.ORDINAL][1].key, j + tags[Tag.ORDINAL][0]
    if Tag.STATE in tags:
        return 'state', tags[Tag.STATE][1].key, j + tags[Tag.STATE][0]
    if Tag.LABEL in tags:
        return 'label', said.words[j], j + tags[Tag.LABEL][0]
    if said.words[j] == 'ego':
        return 'label', 'ego', j + 1
    for length, senses in matches:
        for sense in senses:
            if sense.tag is Tag.VERB and sense.form is VerbForm.ING:
                return 'state', sense.key, j + length
    return None


def _count(said: NounWords, j: int) -> tuple[int, int] | None:
    if said.words[j] in ('a', 'an', 'second'):
        phrase = said.longest(j, Tag.NUMBER)
        if phrase is None:
            return None
    read = said.measures.read(j)
    if read is None:
        return None
    measure, stop = read
    exact = measure.bound is Bound.EXACTLY and not measure.approximate
    if (
        measure.dimension != COUNT
        or not exact
        or measure.upper is not None
        or measure.second is not None
        or measure.value != int(measure.value)
        or not 1 <= measure.value <= 100_000
    ):
        return None
    return int(measure.value), stop
