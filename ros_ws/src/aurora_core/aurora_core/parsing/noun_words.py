# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The words of a prompt as the readers of noun phrases look at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.lexicon import Lexicon, Sense, Tag
from aurora_core.parsing.measures import MeasureReader
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.tokens import Token, TokenKind

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
