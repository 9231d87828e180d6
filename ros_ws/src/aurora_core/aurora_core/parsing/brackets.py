# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Brackets and `, which …,`: values stay where they are, what says more is a clause."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.measures import SPEED
from aurora_core.parsing.pieces import TRANSPARENT, has_verb

_OPENING, _CLOSING = '(', ')'


@dataclass(frozen=True, slots=True, kw_only=True)
class Aside:
    """`the truck (40 m in front)`: the words in brackets and the noun that they are about."""

    atoms: tuple[Atom, ...]
    head: Atom


def take_out(atoms: Sequence[Atom]) -> tuple[list[Atom], list[Aside]]:
    """Return a sentence without the brackets that are clauses, and those."""
    kept: list[Atom] = []
    asides: list[Aside] = []
    i = 0
    while i < len(atoms):
        stop = _closing(atoms, i)
        relative = None if stop is not None else _relative(atoms, i)
        if relative is not None:
            before = next((a for a in reversed(kept) if a.kind not in TRANSPARENT), None)
            assert before is not None
            asides.append(Aside(atoms=tuple(atoms[i + 2 : relative]), head=before))
            i = relative + 1
            continue
        if stop is None:
            kept.append(atoms[i])
            i += 1
            continue
        inner = tuple(atoms[i + 1 : stop])
        head = next((a for a in reversed(kept) if a.kind not in TRANSPARENT), None)
        if head is not None and head.is_actor and (_says_more(inner) or _speed_of(head, inner)):
            asides.append(Aside(atoms=inner, head=head))
        else:
            kept += [
                replace(a, kind=AtomKind.FILL) if a.kind is AtomKind.COMMA else a for a in inner
            ]
        i = stop + 1
    return kept, asides


def _closing(atoms: Sequence[Atom], i: int) -> int | None:
    if atoms[i].kind is not AtomKind.FILL or atoms[i].key != _OPENING:
        return None
    for j in range(i + 1, len(atoms)):
        if atoms[j].kind is AtomKind.FILL and atoms[j].key == _CLOSING:
            return j
    return None


def _relative(atoms: Sequence[Atom], i: int) -> int | None:
    """Return the comma that ends `, which drives at 8 m/s,` between a subject and its verb."""
    opens = atoms[i].kind is AtomKind.COMMA and 0 < i < len(atoms) - 2
    if not opens or atoms[i + 1].kind is not AtomKind.RELATIVE or not atoms[i - 1].is_actor:
        return None
    for j in range(i + 2, len(atoms) - 1):
        if atoms[j].kind is AtomKind.COMMA:
            goes_on = next((a for a in atoms[j + 1 :] if a.kind is not AtomKind.FILL), None)
            finite = goes_on is not None and goes_on.kind in (AtomKind.VERB, AtomKind.AUXILIARY)
            return j if finite and has_verb(atoms[i + 2 : j]) else None
    return None


def _says_more(inner: Sequence[Atom]) -> bool:
    """A predicate or a place; an actor of its own is told inside the sentence."""
    told = has_verb(inner) or any(a.kind is AtomKind.RELATION for a in inner)
    return told and not any(a.is_actor for a in inner[:1])


def _speed_of(head: Atom, inner: Sequence[Atom]) -> bool:
    """`a bus (8 m/s) and a pedestrian`: how fast the bus is."""
    ground = head.noun is not None and head.noun.kind in (NounKind.AGENT, NounKind.EGO)
    told = [a for a in inner if a.kind not in TRANSPARENT and a.kind is not AtomKind.PREPOSITION]
    return ground and len(told) == 1 and told[0].measure is not None and told[0].key == SPEED
