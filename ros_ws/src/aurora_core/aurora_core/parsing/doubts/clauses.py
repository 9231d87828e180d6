# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where words stand: sentences, the clauses that hold them, the events of a clause."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import accumulate

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import Clause, Event, ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

# What a message is told by.
TOLD = frozenset({'alert', 'report', 'send'})
# What is done at some moment: `stops`, not `drives`.
MOMENTS = frozenset(
    {
        *('accelerate', 'brake', 'change_lane', 'cross', 'overtake', 'slow', 'start', 'stop'),
        *('turn_left', 'turn_right', 'yield'),
    }
)
# What ends a stretch of words that one verb is for.
BREAKS = frozenset(
    {
        *(AtomKind.COMMA, AtomKind.STOP, AtomKind.CONJUNCTION, AtomKind.THEN),
        *(AtomKind.SUBORDINATOR, AtomKind.RELATIVE),
    }
)


# A length behind this may be a distance or a height, unless one of these words follows.
_BARE = re.compile(r'\bat(?: (?:about|approximately|around|exactly|roughly))?\s*$')
_DISTANCE = re.compile(r'(?:ahead|away|behind|beside|distance|from|off|standoff)')


class Same:
    """A key for what is worked out of a specification: equal to itself alone, without a hash of
    all that is in it."""

    def __init__(self, spec: ScenarioSpec) -> None:
        self.spec = spec

    def __hash__(self) -> int:
        return id(self.spec)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and self.spec is other.spec


def sentences(atoms: Sequence[Atom]) -> Iterator[list[Atom]]:
    """Yield the atoms of each sentence; a semicolon ends none."""
    sentence: list[Atom] = []
    for atom in atoms:
        if atom.kind is AtomKind.STOP and atom.key != ';':
            yield sentence
            sentence = []
        else:
            sentence.append(atom)
    yield sentence


def stretch(sentence: Sequence[Atom], start: int) -> list[Atom]:
    """Return the atoms from one on, up to the next that breaks."""
    for k in range(start, len(sentence)):
        if sentence[k].kind in BREAKS:
            return list(sentence[start:k])
    return list(sentence[start:])


def within(atoms: Sequence[Atom], span: Span) -> list[Atom]:
    """Return the atoms that lie wholly within some characters."""
    first = bisect_left(atoms, span.start, key=_start)
    last = bisect_left(atoms, span.end, key=_start)
    return [a for a in atoms[first:last] if a.end <= span.end]


def _start(atom: Atom) -> int:
    return atom.start


def clause_of(spec: ScenarioSpec, atom: Atom) -> Clause | None:
    """Return the encoded clause that holds a word, None where it is unread or in no clause."""
    holding = _index(Same(spec)).holding(atom)
    if any(c.status is ClauseStatus.NOT_ENCODED for c in holding):
        return None
    return next((c for c in holding if c.ids), None)


class _Index:
    """Finds the clauses that hold a word without a look at all of them."""

    def __init__(self, clauses: tuple[Clause, ...]) -> None:
        self._places = sorted(enumerate(clauses), key=lambda one: one[1].span.start)
        self._starts = [c.span.start for _, c in self._places]
        self._ends = list(accumulate((c.span.end for _, c in self._places), max))

    def holding(self, atom: Atom) -> list[Clause]:
        """Return them in the order of the specification."""
        found = []
        k = bisect_right(self._starts, atom.start) - 1
        while k >= 0 and self._ends[k] >= atom.end:
            if self._places[k][1].span.end >= atom.end:
                found.append(self._places[k])
            k -= 1
        return [clause for _, clause in sorted(found, key=lambda one: one[0])]


@lru_cache(maxsize=2)
def _index(key: Same) -> _Index:
    return _Index(key.spec.clauses)


def stands_bare(prompt: str, told: Span) -> bool:
    """Return whether a length stands behind a mere `at`: a distance, or a height."""
    before, behind = prompt[: told.start].lower(), prompt[told.end :].lstrip().lower()
    return _BARE.search(before[-20:]) is not None and not _DISTANCE.match(behind)


def events_in(spec: ScenarioSpec, clause: Clause) -> list[Event]:
    """Return the events that a clause became."""
    return [e for e in spec.events if e.id in clause.ids]


def meet(one: Span, other: Span) -> bool:
    """Return whether two stretches share a character."""
    return one.start < other.end and other.start < one.end


def inside(inner: Span | None, outer: Span) -> bool:
    """Return whether one stretch, where there is one, lies within another."""
    return inner is not None and outer.start <= inner.start and inner.end <= outer.end


def over(first: Atom, last: Atom) -> Span:
    """Return the characters from one word to another one behind it."""
    return Span(start=first.start, end=last.end)
