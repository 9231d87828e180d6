# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Walks over atoms: their words, runs up to a mark, the next one that is no small word."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from aurora_core.parsing.atoms import Atom, AtomKind

LOOSE = (AtomKind.FILL, AtomKind.FRAME)
HELPERS = (AtomKind.AUXILIARY, *LOOSE)


def text_of(atom: Atom, prompt: str) -> str:
    """Return the words of an atom in lower case."""
    return prompt[atom.start : atom.end].lower()


def skip(atoms: Sequence[Atom], i: int, kinds: tuple[AtomKind, ...] = LOOSE) -> int:
    """Return the index of the next atom from i on that is of none of the kinds."""
    while i < len(atoms) and atoms[i].kind in kinds:
        i += 1
    return i


def runs(atoms: Sequence[Atom], *ends: AtomKind) -> Iterator[tuple[list[Atom], Atom | None]]:
    """Yield the atoms up to every mark of these kinds, with the mark; the last run has none."""
    run: list[Atom] = []
    for atom in atoms:
        if atom.kind in ends:
            yield run, atom
            run = []
        else:
            run.append(atom)
    yield run, None


def by_sentence(atoms: Sequence[Atom], turn: Callable[[list[Atom]], Sequence[Atom]]) -> list[Atom]:
    """Return the atoms with every sentence turned; the marks between them stay."""
    written: list[Atom] = []
    for sentence, stop in runs(atoms, AtomKind.STOP):
        written += turn(sentence)
        if stop is not None:
            written.append(stop)
    return written


def stop_at(atom: Atom) -> Atom:
    """Return the end of a sentence that takes the characters of an atom."""
    return Atom(kind=AtomKind.STOP, key=';', start=atom.start, end=atom.end)
