# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The head of a noun phrase: a known noun, a landmark, or a part of a place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.lexicon import Sense, Tag
from aurora_core.parsing.noun_words import NOUN_KINDS, NounWords


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
