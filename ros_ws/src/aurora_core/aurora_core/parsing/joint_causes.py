# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two causes of one effect: `when the van turns off and the drone cannot see it, it climbs`.

An event has one cause. A second one that means the same is read, any other one is admitted; it is
never what the first one brings about.
"""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.constructions.messages import TELLING
from aurora_core.parsing.constructions.triggers import cause
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.story import HeldCause, Story
from aurora_core.spec.vocabulary import ClauseStatus


def joint_causes(pieces: Sequence[Piece], i: int) -> int:
    """Return how many clauses behind the cause at i are causes of the same effect."""
    k = i + 1
    while k + 1 < len(pieces) and _is_second(pieces[k], pieces[i]):
        k += 1
    effect = pieces[k]
    told = effect.sentence == pieces[i].sentence and effect.link is Link.MAIN and not effect.opens
    return k - i - 1 if told else 0


def _is_second(piece: Piece, first: Piece) -> bool:
    if piece.sentence != first.sentence or piece.link is not Link.MAIN or piece.criterion:
        return False
    verb = next((a.key for a in piece.atoms if a.kind is AtomKind.VERB), '')
    joined = piece.opens or piece.atoms[0].kind is AtomKind.CONJUNCTION
    return joined and not piece.paused and not piece.then and verb not in TELLING


def second_cause(story: Story, piece: Piece) -> None:
    """Read a cause beside the one that waits for its effect, or is not known."""
    frame = story.open(piece)
    clause = story.scene.clause
    found = cause(frame)
    held = story.held
    if found is not None and (held is None or held.cause == found):
        clause.status = ClauseStatus.ENCODED
        if held is None:
            story.unknown_cause = -1
            story.held = HeldCause(cause=found, clause=clause, sentence=piece.sentence, delay=None)
    else:
        clause.status = ClauseStatus.NOT_ENCODED
        clause.notes.append('only one cause of an event can be told')
    story.close(frame)


def is_joint_word(sentence: Sequence[Atom], i: int) -> bool:
    """Return whether the `and` at i joins two causes that stand in front of their effect."""
    begin = i
    while begin and sentence[begin - 1].kind not in (AtomKind.COMMA, AtomKind.SUBORDINATOR):
        begin -= 1
    caused = begin > 0 and sentence[begin - 1].kind is AtomKind.SUBORDINATOR
    told = sum(a.kind is AtomKind.VERB for a in sentence[begin:i])
    effect = sum(a.kind is AtomKind.VERB for a in sentence[i:])
    return caused and told == 1 and effect > 1
