# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A clause before it is understood: its atoms and how it hangs on its neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.criteria.criterion import Criterion
from aurora_core.parsing.criteria.moments import Sequel


class Link(StrEnum):
    """How a clause hangs on the one before."""

    MAIN = 'main'
    WHEN = 'when'
    WHILE = 'while'
    AFTER = 'after'
    BEFORE = 'before'
    UNTIL = 'until'
    UNLESS = 'unless'
    RELATIVE = 'relative'  # that, which, or a participle behind its noun
    PARTICIPLE = 'participle'  # `, closing from 45 m`
    INFINITIVE = 'infinitive'  # `to track it`


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """The atoms of one clause.

    Attributes:
        link: How it hangs on its neighbours.
        then: In sequence (`then`, `before landing`).
        head: The noun that a relative clause or participle speaks about.
        sentence: Number of its sentence.
        opens: First clause of its sentence, or opened by `and when …`.
        lead: Where the subordinating word begins.
        paused: A comma stands in front.
        criterion: The success condition, or the order of events, that the whole clause states.
        whole: A cause that was read word by word: nothing of it is cut off.
    """

    atoms: tuple[Atom, ...]
    link: Link = Link.MAIN
    then: bool = False
    head: Atom | None = None
    sentence: int = 0
    opens: bool = False
    lead: int | None = None
    paused: bool = False
    criterion: Criterion | Sequel | None = None
    whole: bool = False

    @property
    def start(self) -> int:
        first = min(a.start for a in self.atoms)
        return first if self.lead is None else min(self.lead, first)

    @property
    def end(self) -> int:
        return max(a.end for a in self.atoms)


MARKERS = (
    AtomKind.COMMA,
    AtomKind.CONJUNCTION,
    AtomKind.THEN,
    AtomKind.SUBORDINATOR,
    AtomKind.RELATIVE,
)


# A sentence beyond that is nobody's; looking for patterns in it would take minutes.
MOST_ATOMS = 300
# Nor is a cause beyond that: `when` after `when` would have the rest read from each of them on.
MOST_CAUSE_ATOMS = 100

TRANSPARENT = (AtomKind.FILL, AtomKind.AUXILIARY, AtomKind.NEGATION, AtomKind.FRAME)


def has_verb(atoms: Sequence[Atom]) -> bool:
    """Return whether a predicate is among the atoms."""
    return any(a.kind is AtomKind.VERB for a in atoms)


def first_solid(atoms: Sequence[Atom]) -> Atom | None:
    return next((a for a in atoms if a.kind not in TRANSPARENT), None)


def flies(atom: Atom) -> bool:
    """Return whether a UAV may be meant."""
    return atom.noun is not None and atom.noun.kind in (NounKind.UAV, NounKind.PRONOUN)
