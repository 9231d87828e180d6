# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where words stand: sentences, the clauses that hold them, the events of a clause."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

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
    return [a for a in atoms if span.start <= a.start and a.end <= span.end]


def clause_of(spec: ScenarioSpec, atom: Atom) -> Clause | None:
    """Return the encoded clause that holds a word, None where it is unread or in no clause."""
    holding = [c for c in spec.clauses if c.span.start <= atom.start and atom.end <= c.span.end]
    if any(c.status is ClauseStatus.NOT_ENCODED for c in holding):
        return None
    return next((c for c in holding if c.ids), None)


def events_in(spec: ScenarioSpec, clause: Clause) -> list[Event]:
    """Return the events that a clause became."""
    return [e for e in spec.events if e.id in clause.ids]


def meet(one: Span, other: Span) -> bool:
    """Return whether two stretches share a character."""
    return one.start < other.end and other.start < one.end


def over(first: Atom, last: Atom) -> Span:
    """Return the characters from one word to another one behind it."""
    return Span(start=first.start, end=last.end)
