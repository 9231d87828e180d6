# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds: of which quantity they are, and on which side of them it is to be."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.doubts.clauses import meet, over, sentences
from aurora_core.parsing.measures import COUNT
from aurora_core.spec.parameter import Bound, Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, StatedCondition

# Words for what lies between two, and for a height.
_APART = frozenset({'gap', 'radio_range', 'separation', 'standoff'})
_FLIES = re.compile(r'\b(?:climb|descend|fl(?:y|ies|ying|own)|hover|land|orbit|ris|sink)')
_DISTANCES = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE)
_HIGH = re.compile(r'\s*(?:high|up|above|agl|in the air|of altitude|of height|altitude)\b')
# On which side of a number these say that a value is: -1 below it.
_SIDES = {
    (AtomKind.PREPOSITION, 'below'): -1,
    (AtomKind.PREPOSITION, 'within'): -1,
    (AtomKind.PREPOSITION, 'over'): 1,
    (AtomKind.PREPOSITION, 'beyond'): 1,
    (AtomKind.VERB, 'exceed'): 1,
    (AtomKind.VERB, 'fall_below'): -1,
}
_DENIES = re.compile(
    r'\b(?:no|nor|not|never|neither|none|nobody|cannot|fail(?:s|ed|ure)?|'
    r"(?:are|ca|could|did|do|does|is|may|must|need|sha|should|was|were|wo|would)n['’]?t)\b"
)
_ASKED = {'<': -1, '<=': -1, '>': 1, '>=': 1}


def distances_as_heights(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the distance to the van is always below 60 m and always above 40 m`: 40 m above ground?"""
    for sentence in sentences(atoms):
        subject = ''
        for atom in sentence:
            if atom.kind is AtomKind.THING:
                subject = 'apart' if atom.key in _APART else atom.key
            elif atom.kind is AtomKind.VERB and _FLIES.match(atom.words):
                subject = 'altitude'
            elif subject == 'apart' and atom.measure is not None:
                made = _condition_of(spec, atom)
                if made is not None and made.quantity == QuantityName.ALTITUDE:
                    yield over(atom, atom)


def heights_as_bounds_of_distance(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`flies to the hospital at least 60 m high` that became 60 m away from it."""
    for atom in atoms:
        made = _condition_of(spec, atom) if atom.measure is not None else None
        if made is not None and made.quantity in _DISTANCES:
            behind = _HIGH.match(spec.prompt.lower(), atom.end)
            if behind is not None:
                yield Span(start=atom.start, end=behind.end())


def sides_turned(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`the distance stays below 40 m and must never be below 10 m`, of which `never` turned both.

    A number without a word of a side of its own, as in `at most 40 m`, is not looked at; who says
    `never below 10 m or above 40 m` denies both.
    """
    for sentence in sentences(atoms):
        side, denied, was, joined = 0, False, False, False
        for atom in sentence:
            negated = atom.kind is AtomKind.NEGATION or _DENIES.search(atom.words) is not None
            denied = denied or negated
            if atom.measure is None or atom.measure.dimension == COUNT:
                side = _SIDES.get((atom.kind, atom.key), side)
                joined = joined or (atom.kind, atom.key) == (AtomKind.CONJUNCTION, 'or')
                continue
            made = _condition_of(spec, atom)
            asked = _ASKED.get(made.op, 0) if made is not None else 0
            was = denied or (joined and was)
            plain = atom.measure.bound is Bound.EXACTLY
            if side and asked and plain and asked != (-side if was else side):
                yield over(atom, atom)
            side, denied, joined = 0, False, False


def _condition_of(spec: ScenarioSpec, atom: Atom) -> StatedCondition | None:
    """Return the stated condition whose number stands in some words."""
    own = over(atom, atom)
    for stated in spec.conditions:
        if stated.value.span is not None and meet(stated.value.span, own):
            return stated
    return None
