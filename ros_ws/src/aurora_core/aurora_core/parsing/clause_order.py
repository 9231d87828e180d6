# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clauses in the order in which they are read; phrases that hang on one are given to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.measures import RATIO, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.new_clauses import is_inverted, is_placed
from aurora_core.parsing.pieces import Link, Piece, first_solid, flies, has_verb

# What only flights have.
_FLOWN = ('altitude', 'altitude_suffix', 'standoff', 'radius')


def delays_to_causes(pieces: list[Piece]) -> list[Piece]:
    """`the drone lands 5 s after the bus stops`: the time belongs to `after`."""
    moved = list(pieces)
    for k in range(len(moved) - 1):
        behind = moved[k + 1]
        atoms = list(moved[k].atoms)
        while atoms and atoms[-1].kind is AtomKind.FILL:
            atoms.pop()
        if behind.link not in (Link.AFTER, Link.WHEN) or not atoms or atoms[-1].key != TIME:
            continue
        if len(atoms) > 1 and atoms[-2].kind is AtomKind.PREPOSITION:
            continue
        time = atoms.pop()
        # `…, 20 s after the climb it lands`: of what follows
        next_one = k + 2 < len(moved) and moved[k + 2].link is Link.MAIN and not moved[k + 2].opens
        of_next = next_one and bool(atoms) and atoms[-1].kind is AtomKind.COMMA
        opens = behind.opens or not atoms or of_next
        moved[k + 1] = replace(behind, atoms=(time, *behind.atoms), opens=opens)
        moved[k] = replace(moved[k], atoms=tuple(atoms))
    return [p for p in moved if p.atoms]


def causes_first(pieces: list[Piece]) -> list[Piece]:
    """`brakes when a boy who crosses the street comes near`: the cause, then who he is."""
    ordered = list(pieces)
    for k in range(1, len(ordered) - 1):
        told, cause = ordered[k], ordered[k + 1]
        same = told.link is Link.RELATIVE and cause.link is Link.WHEN and not cause.opens
        own = told.head is None and cause.head is not None and cause.head in told.atoms
        if same and own:
            head = cause.head
            assert head is not None
            rest = tuple(a for a in told.atoms if a is not head)
            ordered[k] = replace(cause, atoms=(head, *cause.atoms), head=None)
            ordered[k + 1] = replace(told, atoms=rest, head=head, lead=None)
    return ordered


def causes_of_next(pieces: list[Piece]) -> list[Piece]:
    """`a drone tracks it, when it stops the drone lands`: the cause is that of what follows."""
    marked = list(pieces)
    for k in range(1, len(pieces) - 1):
        cause, behind = pieces[k], pieces[k + 1]
        if cause.link not in (Link.WHEN, Link.AFTER) or behind.link is not Link.MAIN:
            continue
        if behind.opens:
            continue
        told, first = first_solid(pieces[k - 1].atoms), first_solid(behind.atoms)
        if told is None or first is None or not told.is_actor:
            continue
        command = first.kind is AtomKind.VERB and first.form is VerbForm.BASE
        if command or (cause.paused and first.is_actor and has_verb(behind.atoms)):
            marked[k] = replace(cause, opens=True)
    return marked


def descriptions_first(pieces: list[Piece]) -> list[Piece]:
    """`alerts it when a van | that drives at 10 m/s | comes near`: effect and cause meet."""
    moved = list(pieces)
    for k in range(1, len(moved) - 1):
        told, cause = moved[k], moved[k + 1]
        described = told.link is Link.RELATIVE and cause.head is not None
        if described and cause.link in (Link.WHEN, Link.AFTER, Link.UNTIL) and not cause.opens:
            if cause.head is None:  # `alerts the bus | waiting there | when …`
                moved[k], moved[k + 1] = cause, told
            else:
                moved[k - 1], moved[k] = moved[k], moved[k - 1]
    return moved


def attach_adjuncts(pieces: list[Piece]) -> list[Piece]:
    """Give `At 30 m,` and `20 m ahead of it,` to the clause that they modify."""
    joined: list[Piece] = []
    waiting: tuple[Atom, ...] = ()
    for k, piece in enumerate(pieces):
        atoms = _paused(waiting, piece.atoms)
        waiting = ()
        alone = not has_verb(piece.atoms) and piece.link is Link.MAIN and _is_adjunct(piece.atoms)
        if alone and not piece.then:
            if (
                k + 1 < len(pieces)
                and pieces[k + 1].link is Link.MAIN
                and piece.opens
                and not joined
                and not _of_another(piece.atoms, pieces[k + 1].atoms)
            ):
                waiting = atoms
                continue
            if joined:
                joined[-1] = replace(joined[-1], atoms=joined[-1].atoms + atoms)
                continue
        joined.append(replace(piece, atoms=atoms))
    return joined


def _paused(waiting: tuple[Atom, ...], atoms: tuple[Atom, ...]) -> tuple[Atom, ...]:
    """`next to it, in the next lane, a bus`: the comma tells that the bus is who is there."""
    if not waiting or has_verb(atoms):
        return waiting + atoms
    comma = Atom(kind=AtomKind.COMMA, key=',', start=waiting[-1].end, end=atoms[0].start)
    return (*waiting, comma, *atoms)


def _is_adjunct(atoms: Sequence[Atom]) -> bool:
    """A phrase that needs a clause: a measure or place that no actor or world word leads."""
    solid = first_solid(atoms)
    if solid is None or solid.is_actor or (solid.kind is AtomKind.UNKNOWN and is_placed(atoms)):
        return False
    if is_inverted(atoms):
        return False
    if any(a.kind in (AtomKind.WORLD, AtomKind.NO_TRAFFIC, AtomKind.SCENARIO) for a in atoms):
        return False
    if any(a.kind is AtomKind.IN_VIEW for a in atoms) and any(a.key == RATIO for a in atoms):
        return False  # `visible at least 60 %`
    return any(
        a.kind in (AtomKind.MEASURE, AtomKind.RELATION, AtomKind.THING) or a.noun is not None
        for a in atoms
    )


def _of_another(values: Sequence[Atom], ahead: Sequence[Atom]) -> bool:
    """`altitude 100 ft, truck doing 25 mph`: a height is not that of a truck."""
    high = any(a.kind is AtomKind.THING and a.key in _FLOWN for a in values)
    solid = first_solid(ahead)
    grounded = solid is not None and solid.is_actor and not flies(solid)
    return high and grounded


def names_others(piece: Piece) -> bool:
    """`a truck (25 m behind my car) tailgates it`: named in brackets, meant outside."""
    nouns = [a.noun for a in piece.atoms if a.noun is not None and a.is_actor]
    return bool(nouns) and all(n.kind is not NounKind.PRONOUN for n in nouns)


def of_a_cause(aside: Piece, pieces: Sequence[Piece]) -> bool:
    """`when the child, who crosses after 10 s, …`: what it does is told before what follows."""
    causes = [p for p in pieces if p.link in (Link.WHEN, Link.AFTER, Link.UNTIL)]
    placed = any(a.kind is AtomKind.RELATION for a in aside.atoms)  # beside whom is told before
    return not placed and any(aside.head in p.atoms for p in causes)
