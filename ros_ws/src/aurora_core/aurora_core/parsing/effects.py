# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Effects: of a cause in front, of the same cause as the effect before, of a message told."""

from __future__ import annotations

import re

from aurora_core.parsing.atoms import AtomKind, NounKind
from aurora_core.parsing.constructions import actions, messages
from aurora_core.parsing.constructions.demands import demands
from aurora_core.parsing.constructions.triggers import Cause, time_adjunct
from aurora_core.parsing.events import complete_event, same_cause
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.main_clause import main_clause, shared_words
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import Link
from aurora_core.parsing.scene import Entity, EventDraft
from aurora_core.parsing.sequence import answered_within, later
from aurora_core.parsing.story import Story
from aurora_core.parsing.told_pieces import FLOWN
from aurora_core.spec.scenario import (
    AgentAction,
    EventAction,
    MessageTrigger,
    SendMessage,
    TimeTrigger,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import ClauseStatus

_UNTIL_THEN = re.compile(
    r'(?:and |but )?(?:(?:up )?until then|till then|before that|before then)\b'
)
# What only a UAV is told to do.
_COMMANDED = FLOWN | {'land', 'ascend', 'descend', 'visit'}
# What a relative clause tells of somebody who is told something: where he is, no reaction.
_STAYING = frozenset({'wait', 'park', 'be'})
_WAS_DOING = re.compile(r'\b(?:was|were|had been|has been|have been)\s+\w+ing\b')


_GROUND = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def effect_of_held(story: Story, frame: Frame) -> None:
    assert story.held is not None
    held, story.held = story.held, None
    found, clause, delay, sentence = held.cause, held.clause, held.delay, held.sentence
    shared_words(frame)
    frame.watched = not isinstance(found, MessageTrigger)
    if messages.is_command(frame) or _is_flight_command(frame):
        frame.heir = _told_to_fly(story, found) or frame.heir
    action = actions.action(frame)
    if action is not None and story.last is not None and story.last[0].action == action:
        messages.link_values(frame)
        demands(frame)
        return
    if action is None:
        clause.status = ClauseStatus.NOT_ENCODED
        clause.notes.append('what should happen then was not understood')
        main_clause(frame)
        grounded = any(n.kind in _GROUND for n in frame.subject_nouns)
        if story.scene.clause.status is ClauseStatus.NOT_ENCODED and not grounded:
            story.held = held  # `when it stops, the drone gives up and orbits the park`
        return
    event = complete_event(story.scene, found, action, frame.span, (clause,))
    if event is not None:
        event.delay = delay
        story.last = (event, sentence)
    messages.link_values(frame)
    demands(frame)
    if event is not None and event.delay is None:
        event.delay = answered_within(frame, action)


def _is_flight_command(frame: Frame) -> bool:
    """`if the van vanishes, climb to 80 m`: no van climbs."""
    told = frame.verb is not None and frame.verb.form is VerbForm.BASE
    return told and not frame.subject_nouns and frame.key in _COMMANDED


def _told_to_fly(story: Story, found: Cause) -> Entity | None:
    """Return whom a command means: who sees it happen, else the only UAV."""
    if isinstance(found, VisibilityTrigger):
        return story.scene.by_id(found.observer)
    flying = story.scene.uavs
    return flying[0] if len(flying) == 1 else None


def without_cause(story: Story, frame: Frame) -> None:
    """The effect of a cause that was not understood must not hold without it."""
    shared_words(frame)
    action = actions.action(frame)
    if action is None:
        story.scene.clause.notes.append('its cause was not understood')
        story.scene.clause.status = ClauseStatus.NOT_ENCODED
        frame.subjects()
        return
    found = time_adjunct(frame)  # `unless it has stopped, it is warned at 25 s`
    trigger = found[0] if found is not None else None
    story.scene.became(story.scene.add_event(action, frame.span, trigger).id)


def note_fronted_time(story: Story, frame: Frame, before: int) -> None:
    """`After 15 s the bus stops and …`: the time holds for what follows, too."""
    made = story.scene.events[before:]
    if any(a.kind is AtomKind.RELATIVE for a in frame.piece.atoms):
        return  # `the truck, which after 10 s stops, is tracked`
    if not made or not isinstance(made[-1].trigger, TimeTrigger) or frame.verb is None:
        return
    stated = made[-1].trigger.at_s.span
    if stated is not None and stated.end <= frame.verb.start:
        story.last = (made[-1], frame.piece.sentence)


def so_much_later(story: Story, frame: Frame) -> bool:
    """`…, and 5 s later it starts again`: also where the sentence has a cause."""
    if not later(frame):
        return False
    story.last = None
    return True


def told_to(story: Story, frame: Frame) -> bool:
    """`the RSU tells the truck to stop`: the receiver acts when the message arrives."""
    if frame.piece.link is not Link.INFINITIVE or frame.subject_nouns:
        return False
    ids = story.scene.clauses[-2].ids if len(story.scene.clauses) > 1 else {}
    told = [e for e in story.scene.events if e.id in ids]
    if not told or not isinstance(told[-1].action, SendMessage):
        return False
    message = told[-1].action
    receiver = story.scene.by_id(message.receiver)
    if receiver is None:
        return False
    frame.heir = receiver
    action = actions.action(frame)
    if action is None:
        return False
    heard = MessageTrigger(on='message_received', by=message.receiver, sender=message.sender)
    complete_event(story.scene, heard, action, frame.span, ())
    return True


def follows_event(story: Story, frame: Frame) -> bool:
    """`When …, the drone alerts the ego and the ego brakes`: a second effect of one cause."""
    if story.last is None or story.last[1] != frame.piece.sentence:
        return False
    if _is_earlier_state(frame):
        return False
    if frame.piece.link is not Link.MAIN and not _told_head(story, frame):
        return False
    shared_words(frame)
    action = actions.action(frame)
    if action is None:
        return False
    event = _when_told(story, frame, action) or same_cause(
        story.scene, story.last[0], action, frame.span, then=frame.piece.then
    )
    story.last = (event, frame.piece.sentence)
    messages.link_values(frame)
    demands(frame)
    return True


def _told_head(story: Story, frame: Frame) -> bool:
    """`…, it messages the van, which then stops`: whoever is told is the head."""
    before = story.last[0].action if story.last is not None else None
    head = frame.piece.head
    if frame.piece.link is not Link.RELATIVE or head is None or head.noun is None:
        return False
    if frame.key in _STAYING and not frame.piece.then:
        return False  # `…, it messages the van, which is waiting there`
    known = [e.id for e in story.resolver.known(head.noun)]
    return isinstance(before, SendMessage) and known == [before.receiver]


def _when_told(story: Story, frame: Frame, action: EventAction) -> EventDraft | None:
    """`…, the drone warns the car and the car brakes`: once it has the message."""
    before = story.last[0].action if story.last is not None else None
    who = action.agent if isinstance(action, AgentAction) else None
    who = action.sender if isinstance(action, SendMessage) else who  # it passes it on
    who = action.uav if isinstance(action, UavAction) else who
    if not isinstance(before, SendMessage) or before.receiver != who:
        return None
    heard = MessageTrigger(on='message_received', by=before.receiver, sender=before.sender)
    return complete_event(story.scene, heard, action, frame.span, ())


def _is_earlier_state(frame: Frame) -> bool:
    """`…, until then it follows the bus`: what holds before the event is no effect of it."""
    told = frame.scene.prompt[frame.piece.start : frame.piece.end].lower()
    return _UNTIL_THEN.match(told) is not None or _WAS_DOING.search(told) is not None
