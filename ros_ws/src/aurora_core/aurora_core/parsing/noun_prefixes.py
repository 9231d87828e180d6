# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What may stand before the head: determiner, count, ordinal, adjectives."""

from __future__ import annotations

from aurora_core.parsing.atoms import Determiner
from aurora_core.parsing.lexicon import Tag
from aurora_core.parsing.measures import COUNT
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.noun_words import NounWords
from aurora_core.spec.parameter import Bound


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
