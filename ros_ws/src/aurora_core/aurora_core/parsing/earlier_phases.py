# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Phases that are told second and flown first: `tracks a van, but before that it hovers`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.lexicon import shipped_lexicon


def before_that(atoms: Sequence[Atom]) -> list[Atom]:
    """Return the atoms with `before that`, `before this` as one word."""
    written: list[Atom] = []
    for atom in atoms:
        last = written[-1] if written else None
        opens = last is not None and last.kind is AtomKind.SUBORDINATOR and last.key == 'before'
        if last is not None and opens and atom.words in ('this', 'that'):
            written[-1] = replace(last, kind=AtomKind.FILL, key='before that', end=atom.end)
        elif not (atom.kind is AtomKind.COMMA and last is not None and _refers(last)):
            written.append(atom)
    return written


def _refers(atom: Atom) -> bool:
    return atom.kind is AtomKind.FILL and atom.key in shipped_lexicon().turns['before_that']


def tells_before(frame: Frame) -> bool:
    """Return whether a clause tells what comes before what was told last."""
    return any(_refers(a) for a in frame.piece.atoms)


def earlier_phase(frame: Frame, before: int) -> None:
    """Put the missions that a clause added in front of the one that was told before it.

    Args:
        frame: The clause.
        before: Number of missions that were told before the clause.
    """
    word = next((a for a in frame.piece.atoms if _refers(a)), None)
    if word is None:
        return
    missions = frame.scene.missions
    made = missions[before:]
    known = [m for m in missions[:before] if made and m.uav is made[0].uav]
    if not made or not known:
        if not made:
            frame.flag(word.start, word.end)
        return
    at = missions.index(known[-1])
    missions[before:] = []
    missions[at:at] = made
