# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Cuts a sentence into clauses where its markers and comparisons say so."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.criteria.causes import cause_end
from aurora_core.parsing.new_clauses import opened_clause
from aurora_core.parsing.pieces import MARKERS, TRANSPARENT, Link, Piece, has_verb

_CAUSES = (Link.WHEN, Link.AFTER, Link.UNTIL)


def cut_at_markers(atoms: list[Atom]) -> list[Piece]:
    """Cut at commas, conjunctions and subordinating words that open a clause."""
    pieces: list[Piece] = []
    current: list[Atom] = []
    state = Piece(atoms=(), opens=True)
    i = 0
    while i < len(atoms):
        if atoms[i].kind not in MARKERS:
            current.append(atoms[i])
            i += 1
            continue
        run = i
        while run < len(atoms) and (
            atoms[run].kind in MARKERS
            or (
                atoms[run].kind in (AtomKind.FILL, AtomKind.FRAME)
                and run + 1 < len(atoms)
                and atoms[run + 1].kind in MARKERS
            )
        ):
            run += 1
        markers = [a for a in atoms[i:run] if a.kind in MARKERS]
        following = _next_run(atoms, run)
        upcoming = opened_clause(current, markers, following)
        if upcoming is None:
            current += atoms[i:run]
        else:
            if current:
                pieces.append(replace(state, atoms=tuple(current)))
            opens = (
                not pieces or upcoming.then or any(m.kind is AtomKind.CONJUNCTION for m in markers)
            )
            comma = bool(markers) and markers[0].kind is AtomKind.COMMA
            state = replace(upcoming, opens=opens, paused=comma)
            current = []
            end = run + cause_end(atoms[run:]) if upcoming.link in _CAUSES else run
            # In front, only a pause can tell where the cause ends and the effect begins.
            if end > run and (pieces or end < len(atoms)):
                pieces.append(replace(state, atoms=tuple(atoms[run:end]), whole=True))
                state = Piece(atoms=())
                run = end + (end < len(atoms) and atoms[end].kind is AtomKind.COMMA)
        i = run
    if current:
        pieces.append(replace(state, atoms=tuple(current)))
    return pieces


def _next_run(atoms: Sequence[Atom], start: int) -> list[Atom]:
    ahead = []
    for atom in atoms[start:]:
        if atom.kind in MARKERS and atom.kind is not AtomKind.RELATIVE:
            break
        ahead.append(atom)
    return ahead


def cut_behind_comparison(piece: Piece) -> list[Piece]:
    """`if ego > 15 m/s drone warns it`: a cause without a verb ends with its number."""
    atoms = piece.atoms
    if piece.link is not Link.WHEN or piece.whole:
        return [piece]
    for i in range(1, len(atoms) - 2):
        solid = [a for a in atoms[i + 1 :] if a.kind not in TRANSPARENT]
        acts = len(solid) > 1 and solid[0].is_actor and solid[1].kind is AtomKind.VERB
        if atoms[i].kind is AtomKind.MEASURE and acts and not has_verb(atoms[:i]):
            return [replace(piece, atoms=atoms[: i + 1]), Piece(atoms=atoms[i + 1 :])]
    return [piece]
