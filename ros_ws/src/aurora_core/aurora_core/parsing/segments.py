# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clauses: one predicate each, with the word that links it to its neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import runs
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.brackets import take_out
from aurora_core.parsing.clause_cuts import cut_at_markers, cut_behind_comparison
from aurora_core.parsing.clause_openings import plain_prepositions
from aurora_core.parsing.clause_order import (
    attach_adjuncts,
    causes_first,
    causes_of_next,
    delays_to_causes,
    descriptions_first,
    names_others,
    of_a_cause,
)
from aurora_core.parsing.criteria.spans import stretches
from aurora_core.parsing.gaps import fill_gaps
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.predicates import cut_at_verbs


def segment(atoms: Sequence[Atom]) -> tuple[Piece, ...]:
    """Cut a prompt's atoms into clauses, in the order of the text."""
    pieces: list[Piece] = []
    sentences = [sentence for sentence, _ in runs(atoms, AtomKind.STOP) if sentence]
    for number, sentence in enumerate(sentences):
        pieces += _sentence(tuple(sentence), number)
    return tuple(pieces)


# A second look reads the other sentences of a prompt again and again.
@lru_cache(maxsize=64)
def _sentence(atoms: tuple[Atom, ...], number: int) -> tuple[Piece, ...]:
    """Cut out the conditions that a sentence states, then read what stands around them."""
    pieces: list[Piece] = []
    for stretch in stretches(atoms):
        if stretch.criterion is None:
            pieces += clauses(stretch.atoms, number)
        else:
            told = Piece(atoms=stretch.atoms, sentence=number, criterion=stretch.criterion)
            pieces.append(told)
    return tuple(pieces)


def clauses(atoms: Sequence[Atom], number: int) -> list[Piece]:
    """Cut a sentence, or a stretch of one, into clauses."""
    plain, asides = take_out(list(atoms))
    raw = cut_at_markers(plain_prepositions(plain))
    parts = [part for whole in raw for part in cut_behind_comparison(whole)]
    pieces = [p for part in parts for p in ([part] if part.whole else cut_at_verbs(part))]
    pieces = attach_adjuncts(delays_to_causes(fill_gaps(pieces)))
    pieces = causes_of_next(causes_first(pieces))
    told = [Piece(atoms=a.atoms, link=Link.RELATIVE, head=a.head) for a in asides]
    first = [p for p in told if names_others(p) or of_a_cause(p, pieces)]
    pieces = first + pieces + [p for p in told if p not in first]
    return [replace(p, sentence=number) for p in descriptions_first(pieces) if p.atoms]
