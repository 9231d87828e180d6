# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a sentence says of the radio link without naming the quantity.

`one message in five is lost`, `each takes 0.6 s`, `nothing gets through beyond 120 m`: loss,
latency, range and retransmissions, written out with their names.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import by_sentence, runs
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.measures import COUNT, LENGTH, RATIO, TIME, Measure
from aurora_core.spec.parameter import Bound

_BREAKS = (AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)
_NAMED = ('loss', 'latency', 'radio_range', 'retransmissions')


@lru_cache(maxsize=1)
def _words() -> dict[str, re.Pattern[str]]:
    sections = read_data('lexicon.yaml')['radio']
    return {
        name: re.compile(r'\b(?:' + '|'.join(map(re.escape, words)) + r')\b')
        for name, words in sections.items()
        if name != 'shares'
    }


@lru_cache(maxsize=1)
def _shares() -> tuple[dict[str, int], tuple[re.Pattern[str], ...]]:
    told = read_data('lexicon.yaml')['radio']['shares']
    numbers = {str(word): int(number) for word, number in told.items()}
    word = '(' + '|'.join(numbers) + ')'
    what = r'(?:\w+\s+)?'
    return numbers, (
        re.compile(rf'\bevery\s+{word}\b'),
        re.compile(rf'\b(?:one|1|a)\s+{what}(?:in|out of|of every|in every|per)\s+{word}\b'),
        re.compile(rf'\b(?:of|out of|from)\s+{word}\s+\w+,?\s+one\b'),
    )


def radio(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with what is said of messages as named values of the link."""
    return by_sentence(atoms, lambda sentence: _sentence(sentence, prompt))


def _sentence(atoms: list[Atom], prompt: str) -> list[Atom]:
    if not atoms:
        return atoms
    text = prompt[atoms[0].start : atoms[-1].end].lower()
    if _words()['about'].search(text) is None:
        return atoms
    written: list[Atom] = []
    for chunk, joint in runs(atoms, *_BREAKS):
        written += _chunk(chunk, prompt)
        if joint is not None:
            written.append(joint)
    return written


def _chunk(atoms: list[Atom], prompt: str) -> list[Atom]:
    if not atoms or any(_keeps(a) for a in atoms):
        return atoms
    start, end = atoms[0].start, atoms[-1].end
    text = prompt[start:end].lower()
    told = _value(atoms, text, start)
    if told is None:
        return atoms
    name, measure = told
    link = Atom(kind=AtomKind.LINK, key='link', start=start, end=start + 1)
    thing = Atom(kind=AtomKind.THING, key=name, start=start, end=start + 1)
    value = Atom(
        kind=AtomKind.MEASURE,
        key=measure.dimension,
        start=measure.start,
        end=measure.end,
        measure=measure,
    )
    return [link, thing, value]


def _keeps(atom: Atom) -> bool:
    """Return whether a clause has its own reading: causes, actors, names of what is measured."""
    named = atom.noun is not None and atom.is_actor and atom.noun.kind is not NounKind.PRONOUN
    thing = atom.kind is AtomKind.THING and atom.key in _NAMED
    return named or thing or atom.is_place or atom.kind in (AtomKind.SUBORDINATOR, AtomKind.WORLD)


def _value(atoms: Sequence[Atom], text: str, start: int) -> tuple[str, Measure] | None:
    words = _words()
    share = _share(text, start)
    measures = [a.measure for a in atoms if a.measure is not None]
    lost = words['lost'].search(text) is not None
    if share is not None and lost:
        return 'loss', share
    if not measures and words['whole'].search(text) is not None:
        return 'loss', _none(RATIO, atoms)
    if not measures and words['not_again'].search(text) is not None:
        return 'retransmissions', _none(COUNT, atoms)
    if len(measures) != 1 or words['demanded'].search(text) is not None:
        return None
    measure = measures[0]
    if measure.dimension == RATIO and lost:
        return 'loss', measure
    if measure.dimension == RATIO and words['arrives'].search(text) and 'only' in text.split():
        return 'loss', replace(measure, value=round(1.0 - measure.value, 6))
    compared = any(a.kind is AtomKind.NEGATION or a.key in ('beyond', 'below') for a in atoms)
    plain = measure.bound is Bound.EXACTLY and not compared
    if measure.dimension == TIME and plain and words['late'].search(text):
        return 'latency', measure
    if measure.dimension == LENGTH and words['reaches'].search(text):
        return 'radio_range', replace(measure, bound=Bound.EXACTLY)
    if measure.dimension == COUNT and words['again'].search(text):
        return 'retransmissions', replace(measure, bound=Bound.EXACTLY)
    return None


def _none(dimension: str, atoms: Sequence[Atom]) -> Measure:
    return Measure(dimension=dimension, value=0.0, start=atoms[0].start, end=atoms[-1].end)


def _share(text: str, start: int) -> Measure | None:
    numbers, patterns = _shares()
    for pattern in patterns:
        found = pattern.search(text)
        if found is not None:
            return Measure(
                dimension=RATIO,
                value=1.0 / numbers[found[1]],
                start=start + found.start(),
                end=start + found.end(),
            )
    return None
