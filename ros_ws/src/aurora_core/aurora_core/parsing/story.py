# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What was told so far: the scene, and what of the last clauses waits for the next one."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.constructions.states import adjectives, noun_places
from aurora_core.parsing.constructions.triggers import Cause
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import ClauseDraft, EventDraft, Scene
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import VisibilityTrigger
from aurora_core.spec.vocabulary import ClauseStatus

# Links of clauses that go on with the story; the others only describe or condition.
_TELLING = (Link.MAIN, Link.INFINITIVE, Link.PARTICIPLE, Link.WHILE)

# `they have granted us 120 m`: who asks for the scenario need not be in it.
_SPEAKER = ('us', 'me', 'i')


@dataclass(frozen=True, slots=True, kw_only=True)
class HeldCause:
    """A cause that waits for its effect.

    Attributes:
        cause: What it was understood as.
        clause: Its clause, which is not understood when no effect follows.
        sentence: Number of its sentence; the effect stands in the same one.
        delay: How long after the cause the effect comes, in s.
    """

    cause: Cause
    clause: ClauseDraft
    sentence: int
    delay: Parameter | None


@dataclass(frozen=True, slots=True, kw_only=True)
class LateStart:
    """`must not begin its task before drone A is done`: what a UAV's first phase waits for.

    Attributes:
        cause: What it was understood as.
        clauses: Those that say so, which are not understood when no phase follows.
    """

    cause: Cause
    clauses: tuple[ClauseDraft, ...]


# Nouns that name somebody, and nobody who has to be looked for.
_TAKE_PART = (NounKind.AGENT, NounKind.UAV, NounKind.EGO)


class Story:
    """The scene as it grows, and what the next clause may refer to.

    Attributes:
        scene: What was understood.
        resolver: Whom nouns mean.
        held: A cause in front of its effect.
        unknown_cause: Number of the sentence whose leading cause was not understood, or -1.
        seen: What a UAV saw by the clause in front, when it tells so.
        before: The clause in front.
        last: The last event that a leading cause started, and the number of its sentence.
        late: What the first phase of a UAV waits for, by its id.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.resolver = Resolver(scene)
        self.held: HeldCause | None = None
        self.unknown_cause = -1
        self.seen: VisibilityTrigger | None = None
        self.before: Piece | None = None
        self.last: tuple[EventDraft, int] | None = None
        self.late: dict[str, LateStart] = {}

    def drop_held(self, sentence: int) -> None:
        """A cause whose effect never came was not understood."""
        if self.held is not None and self.held.sentence != sentence:
            self.held.clause.status = ClauseStatus.NOT_ENCODED
            self.held.clause.notes.append('no effect follows')
            self.held = None

    def open(self, piece: Piece) -> Frame:
        """Begin a clause of the scene."""
        frame = Frame(piece, self.scene, self.resolver)
        self.scene.clauses.append(
            ClauseDraft(
                span=frame.span,
                sentence=piece.sentence,
                describes=piece.link not in _TELLING,
                passive=frame.passive,
            )
        )
        return frame

    def close(self, frame: Frame) -> None:
        """End a clause: what of it was not understood becomes one of its own."""
        adjectives(frame)
        noun_places(frame)
        clause = self.scene.clause
        if clause.status is not ClauseStatus.ENCODED:
            self._cast(frame)
            return
        for span in frame.leftovers():
            self.scene.clauses.append(
                ClauseDraft(
                    span=span,
                    sentence=frame.piece.sentence,
                    subjects=clause.subjects,
                    objects=clause.objects,
                    places=clause.places,
                    notes=['this part of the clause was not understood'],
                )
            )

    def _cast(self, frame: Frame) -> None:
        """Whoever a clause names takes part, also when it was not understood what they do."""
        named = [n for n in frame.nouns() if n.kind in _TAKE_PART and n.key not in _SPEAKER]
        if not frame.negated or frame.key == 'lose':  # who is not lost is there
            self.resolver.actors(named)
