# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whoever acts in a clause is named only in the clause behind it."""

from __future__ import annotations

from aurora_core.parsing.atoms import ACTORS, NounKind
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Piece
from aurora_core.parsing.story import Story


def named_later(story: Story, frame: Frame, following: Piece) -> None:
    """`When it sees a bus, the drone …`: a pronoun in front of its noun."""
    if any(n.kind is not NounKind.PRONOUN for n in frame.subject_nouns):
        return
    if not frame.subject_nouns or any(c.subjects or c.objects for c in story.scene.clauses):
        return
    upcoming = Frame(following, story.scene, story.resolver).subject_nouns
    if upcoming and all(n.kind in ACTORS and n.kind is not NounKind.PRONOUN for n in upcoming):
        frame.subject_nouns = upcoming


def acts_later(story: Story, frame: Frame, following: Piece) -> None:
    """`While following a van, the drone …`: who follows is named behind."""
    gerund = frame.verb is not None and frame.verb.form is VerbForm.ING
    if gerund and not frame.subject_nouns and frame.piece.head is None:
        upcoming = Frame(following, story.scene, story.resolver).subject_nouns
        if upcoming and all(n.kind in ACTORS for n in upcoming):
            frame.subject_nouns = upcoming
