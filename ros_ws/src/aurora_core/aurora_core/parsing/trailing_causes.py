# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A cause behind its effect: `alerts the ego when …`, `tracks the bus until …`."""

from __future__ import annotations

from dataclasses import replace

from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.constructions import actions, messages
from aurora_core.parsing.constructions.demands import demands
from aurora_core.parsing.constructions.distances import DistanceCause
from aurora_core.parsing.constructions.flight_details import flight_details
from aurora_core.parsing.constructions.triggers import Cause, cause
from aurora_core.parsing.effects import told_to
from aurora_core.parsing.events import complete_event, settled
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.main_clause import main_clause, shared_words
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.scene import ClauseDraft, EventDraft, UntilDraft
from aurora_core.parsing.sequence import answered_within
from aurora_core.parsing.story import Story
from aurora_core.parsing.told_pieces import again, delay_of
from aurora_core.spec.scenario import AgentAction, EventAction, SendMessage, UavAction
from aurora_core.spec.vocabulary import BehaviorKind, ClauseStatus

_STANDING = (BehaviorKind.WAIT, BehaviorKind.PARK, BehaviorKind.STOP)


def effect_then_cause(story: Story, piece: Piece, because: Piece) -> None:
    """`… alerts the ego when the van comes within 20 m`."""
    frame = story.open(piece)
    effect_clause = story.scene.clause
    shared_words(frame)
    if because.link is Link.UNTIL:
        _until(story, frame, because)
        return
    if told_to(story, frame):
        _cause_of_message(story, frame, because)
        return
    action = actions.action(frame)
    if action is None:
        main_clause(frame)
    messages.link_values(frame)
    demands(frame)
    limit = answered_within(frame, action)
    story.close(frame)
    second = story.open(because)
    if isinstance(action, SendMessage):
        receiver = story.scene.by_id(action.receiver)
        second.avoid = (receiver,) if receiver is not None else ()
    if action is None and because.link is Link.AFTER and second.verb is not None:
        story.close(second)
        return
    delay = delay_of(second)
    late = action is None and frame.key == 'start'
    found = (cause(second) or again(story, second)) if action is not None or late else None
    found = _about_the_told(story, second, found, action)
    if found is None or action is None:
        if action is not None:
            effect_clause.notes.append('its cause was not understood')
            effect_clause.ids[story.scene.add_event(action, frame.span).id] = None
        story.close(second)
        return
    story.scene.clause.status = ClauseStatus.ENCODED
    clause = story.scene.clause
    event = complete_event(story.scene, found, action, frame.span, (effect_clause, clause))
    if event is not None:
        event.delay = delay or limit
        _shared_cause(story, event, effect_clause)
        flight_details(second)  # `follows it when it starts, for 1 min`
    messages.link_values(second)
    story.close(second)


def _cause_of_message(story: Story, frame: Frame, because: Piece) -> None:
    """`tells the truck to stop when it sees a bus`: the cause is that of the message."""
    story.close(frame)
    told = story.scene.events[-2]
    second = story.open(because)
    if isinstance(told.action, SendMessage) and not second.subject_nouns:
        second.heir = story.scene.by_id(told.action.sender)
    found = cause(second)
    if found is not None and told.trigger is None and told.action is not None:
        told.trigger = settled(story.scene, found, told.action)
        story.scene.clause.ids[told.id] = None
        story.scene.clause.status = ClauseStatus.ENCODED
    story.close(second)


def _about_the_told(
    story: Story, frame: Frame, found: Cause | None, action: EventAction | None
) -> Cause | None:
    """`alerts it when it is closer than 60 m to a bus`: no UAV drives up to a bus."""
    if not isinstance(found, DistanceCause) or not isinstance(action, SendMessage):
        return found
    told = story.scene.by_id(action.receiver)
    reported = story.scene.reported.get(action.sender)
    if found.b == action.sender and reported not in (None, found.a.id) and _of_it(frame):
        return replace(found, b=reported)  # `warns it of a truck when it is 80 m away from it`
    pronoun = all(n.kind is NounKind.PRONOUN for n in frame.subject_nouns)
    if told is None or told.is_uav or not found.a.is_uav or not pronoun:
        return found
    return found if found.b in (None, told.id) else replace(found, a=told)


def _of_it(frame: Frame) -> bool:
    nouns = [n for a in frame.adjuncts for n in a.nouns]
    return bool(nouns) and all(n.kind is NounKind.PRONOUN for n in nouns)


def _shared_cause(story: Story, event: EventDraft, clause: ClauseDraft) -> None:
    """`alerts the ego and the ego slows when …`: the cause is that of both effects."""
    events = story.scene.events
    number = story.scene.clauses.index(clause)
    if len(events) < 2 or number < 1:
        return
    before = events[-2]
    earlier = story.scene.clauses[number - 1]
    same = earlier.sentence == clause.sentence and before.id in earlier.ids
    if same and before.trigger is None and before.action is not None:
        before.trigger = event.trigger
        clause.ids[before.id] = None


def _until(story: Story, frame: Frame, because: Piece) -> None:
    """`tracks the bus until it stops`: the phase ends with the event."""
    scene = story.scene
    before = len(scene.missions)
    main_clause(frame)
    story.close(frame)
    second = story.open(because)
    made = scene.missions[before:]
    agents = [e for e in scene.clauses[-2].subjects if not e.is_uav]
    found = cause(second) if made or len(agents) == 1 else None
    if found is not None and made:
        for mission in made:
            action = UavAction(do='land', uav=mission.uav.id)
            event = complete_event(scene, found, action, frame.span, ())
            if event is not None:
                waits = frame.key == 'wait' and mission.target is None and mission.altitude is None
                until = UntilDraft(mission=mission, event=event, only_waits=waits)
                scene.untils.append(until)
    elif found is not None:
        # `waits until it is green`: then it goes; `drives until the bus brakes`: then it stops
        last = agents[0].behaviors[-1].kind if agents[0].behaviors else None
        then = AgentAction(do='start' if last in _STANDING else 'stop', agent=agents[0].id)
        complete_event(scene, found, then, frame.span, ())
    story.close(second)
