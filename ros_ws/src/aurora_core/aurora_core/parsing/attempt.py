# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One reading of a prompt: from its atoms to a settled scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.reader import Reader
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.rewriting.rewrite import Rewritten, rewrite
from aurora_core.parsing.rules import settle
from aurora_core.parsing.scene import ClauseDraft, Scene
from aurora_core.parsing.segments import segment
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import ClauseStatus

# A question leaves the whole prompt unread: more than any clause of it.
_A_QUESTION = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class Attempt:
    """A prompt as it was read.

    Attributes:
        atoms: What was read; a second look may have left words out.
        told: The atoms in the order and wording in which clauses were cut.
        resolver: Whom the nouns mean.
    """

    scene: Scene
    atoms: tuple[Atom, ...]
    told: Rewritten
    resolver: Resolver

    @property
    def unread(self) -> tuple[Span, ...]:
        """Clauses that were not understood, and words that stay open."""
        drafts = self.scene.clauses
        spans = [c.span for c in drafts if c.status is ClauseStatus.NOT_ENCODED]
        return (*spans, *(doubt.span for doubt in self.scene.doubts))

    @property
    def unread_words(self) -> int:
        """How much was not understood, in words."""
        prompt = self.scene.prompt
        open_words = sum(len(prompt[s.start : s.end].split()) for s in self.unread)
        return open_words + (_A_QUESTION if self.scene.questions else 0)

    @property
    def said(self) -> int:
        """How many elements its clauses became; an actor counts when it does or is something."""
        idle = {e.id for e in self.scene.entities if not e.behaviors and not e.placements}
        return len({one for clause in self.scene.clauses for one in clause.ids} - idle)


def attempt(prompt: str, context: ParseContext, atoms: Sequence[Atom]) -> Attempt:
    """Read atoms into a scene and apply the scene rules.

    Args:
        prompt: The request; spans refer to its characters.
        context: Map name and landmarks that names are looked up in.
        atoms: The tagged words that are read.
    """
    scene = Scene(prompt, context)
    told = rewrite(tuple(atoms), prompt)
    _look_ahead(scene, told.atoms)
    reader = Reader(scene)
    reader.read(segment(told.atoms))
    _note_left_out(scene, told)
    if not scene.refusals:
        settle(scene)
    return Attempt(scene=scene, atoms=tuple(atoms), told=told, resolver=reader.resolver)


def _look_ahead(scene: Scene, atoms: Sequence[Atom]) -> None:
    """Note what the whole prompt says of flying: clauses may leave the flyer out."""
    heights = ('altitude', 'altitude_suffix')
    scene.altitude_stated = any(a.kind is AtomKind.THING and a.key in heights for a in atoms)
    scene.uav_nouns = tuple(
        a.noun for a in atoms if a.noun is not None and a.noun.kind is NounKind.UAV
    )


def _note_left_out(scene: Scene, told: Rewritten) -> None:
    for span in told.taken_back:
        scene.clauses.append(
            ClauseDraft(
                span=span, status=ClauseStatus.NO_REQUIREMENT, notes=['the speaker took it back']
            )
        )
    for span in told.background:
        scene.clauses.append(ClauseDraft(span=span, status=ClauseStatus.NO_REQUIREMENT))
