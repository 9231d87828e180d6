# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A cause in front of its effect: it waits in the story until the effect comes."""

from __future__ import annotations

from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.constructions.messages import TELLING
from aurora_core.parsing.constructions.triggers import cause
from aurora_core.parsing.constructions.world import world_words
from aurora_core.parsing.criteria.causes import is_flight
from aurora_core.parsing.criteria.moments import Moment
from aurora_core.parsing.criteria.sequels import Sequels
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.main_clause import main_clause
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.reactions import REACTIONS
from aurora_core.parsing.scene import EventDraft
from aurora_core.parsing.story import HeldCause, Story
from aurora_core.parsing.told_pieces import FLOWN, HAPPENS, PHASES, again, delay_of, named_later
from aurora_core.spec.scenario import EventDoneTrigger
from aurora_core.spec.vocabulary import ClauseStatus


def leading(story: Story, piece: Piece, following: Piece) -> None:
    """`When the van comes within 20 m, …`: the effect comes next."""
    frame = story.open(piece)
    gerund = frame.verb is not None and frame.verb.form is VerbForm.ING and not frame.subject_nouns
    gerund = gerund and not is_flight(piece.atoms, piece.link)
    if frame.key == 'finish' and not frame.subject_nouns:
        actors = Frame(following, story.scene, story.resolver).subject_nouns
        frame.subject_nouns = actors
        gerund = False
    known_event = _told_before(story, frame) if gerund else None
    if known_event is not None:
        delay = delay_of(frame)
        frame.taken()
        story.scene.became(known_event.id)
        story.held = HeldCause(
            cause=EventDoneTrigger(on='event_done', event=known_event.id),
            clause=story.scene.clause,
            sentence=piece.sentence,
            delay=delay,
        )
        story.close(frame)
        return
    if gerund and piece.link is not Link.UNTIL:
        actors = Frame(following, story.scene, story.resolver).subject_nouns
        sent = frame.key in TELLING and bool(story.scene.events)
        known = frame.key in HAPPENS or sent or (_dated(piece) and frame.key not in PHASES)
        if known or piece.link is Link.WHEN:
            frame.subject_nouns = actors
            gerund = False
    if gerund or piece.link is Link.UNTIL:
        upcoming = Frame(following, story.scene, story.resolver)
        if not frame.subject_nouns and upcoming.subject_nouns:
            frame.subject_nouns = upcoming.subject_nouns
        if piece.link is Link.AFTER:
            main_clause(frame)
        story.close(frame)
        return
    if frame.has_mark(AtomKind.MESSAGE.value) and not frame.subject_nouns:
        # `once the message has arrived, the ego slows`: with whom, is said behind
        frame.subject_nouns = Frame(following, story.scene, story.resolver).subject_nouns
    if frame.key == 'alert' and not frame.subject_nouns:  # `only if warned does the ego brake`
        told = story.resolver.actors(Frame(following, story.scene, story.resolver).subject_nouns)
        frame.heir = told[0] if len(told) == 1 else None
    named_later(story, frame, following)
    delay = delay_of(frame)
    found = cause(frame) or again(story, frame)
    if found is not None:
        world_words(frame)
        story.scene.clause.status = ClauseStatus.ENCODED
        story.held = HeldCause(
            cause=found, clause=story.scene.clause, sentence=piece.sentence, delay=delay
        )
    elif (
        piece.link is Link.AFTER
        or frame.has_mark(AtomKind.LINK.value)
        or (frame.verb is not None and frame.verb.form is VerbForm.ING and frame.key in FLOWN)
    ):
        # `when tracking the bus, the drone …`: a phase that goes on
        main_clause(frame)  # `if the link loses 20 % of the messages`: no event, a value
        if story.scene.clause.status is not ClauseStatus.ENCODED and not gerund:
            story.unknown_cause = piece.sentence
    else:
        story.unknown_cause = piece.sentence
    story.close(frame)


def _dated(piece: Piece) -> bool:
    """`5 s after braking, it …`: what the time counts from has happened."""
    return piece.atoms[0].measure is not None and piece.atoms[0].key == TIME


def _told_before(story: Story, frame: Frame) -> EventDraft | None:
    """`within 6 s of the braking, …`: of whoever was told to brake."""
    before = story.scene.prompt[: frame.verb.start].split() if frame.verb is not None else []
    if before[-1:] != ['the'] or frame.key not in REACTIONS:
        return None
    return Sequels(story.scene, frame.span).event(Moment(key=frame.key))
