# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What starts an event: `when the van comes within 20 m`, `once it reaches 40 m`, `after 10 s`."""

from __future__ import annotations

from typing import Literal

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind, NounKind
from aurora_core.parsing.constructions.actions import agent_action
from aurora_core.parsing.constructions.distances import DistanceCause, distance_cause, reference
from aurora_core.parsing.constructions.messages import TELLING, message
from aurora_core.parsing.constructions.missions import mission
from aurora_core.parsing.constructions.states import noun_places
from aurora_core.parsing.criteria.causes import told_cause, who_flew, who_moves
from aurora_core.parsing.criteria.onsets import sets_in
from aurora_core.parsing.criteria.thresholds import threshold
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pronouns import anything
from aurora_core.parsing.scene import Entity
from aurora_core.spec.events import shows_its_beginning
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    EventAction,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    SpeedTrigger,
    TimeTrigger,
    Trigger,
    UavAction,
    VisibilityTrigger,
)

Cause = DistanceCause | Trigger
# `when 10 s have passed`
ELAPSED = ('overtake', 'drive', 'finish', 'elapse')


def cause(frame: Frame) -> Cause | None:
    """Read the clause behind `when`, None when it is none that can be watched."""
    if frame.negated:
        return _sight(frame) or threshold(frame) or told_cause(frame)
    found: Cause | None = (
        distance_cause(frame)
        or _altitude(frame)
        or _speed(frame)
        or _sight(frame)
        or _message(frame)
        or _arrival(frame)
        or _done(frame)
        or _did_so(frame)
        or _climbed(frame)
        or _elapsed(frame)
    )
    if found is not None:
        noun_places(frame)
    if found is None or frame.leftovers():
        found = told_cause(frame) or threshold(frame) or found
    return found or _behavior(frame)


def time_adjunct(frame: Frame) -> tuple[TimeTrigger, Adjunct] | None:
    """Take `after 10 s`, `at t = 10 s`, `10 seconds into the run` from a main clause."""
    start = frame.has_mark(AtomKind.FROM_START.value)
    adjunct = frame.time('after', 'at') or (frame.time('', 'in') if start else None)
    if adjunct is None or adjunct.measure is None or frame.piece.then:
        return None
    if frame.verb is not None and adjunct.prep == 'after':
        between = frame.scene.prompt[adjunct.end : frame.verb.start].strip()
        if between == 'of':  # `after 20 s of hovering`: how long, not when
            adjunct.prep = 'for'
            return None
    if not values.accepts('trigger_time', adjunct.measure):
        return None
    adjunct.used = True
    frame.mark(AtomKind.FROM_START.value)
    at = TimeTrigger(on='time', at_s=values.explicit('trigger_time', adjunct.measure))
    return at, adjunct


def _altitude(frame: Frame) -> AltitudeTrigger | None:
    if frame.key not in ('reach', 'ascend', 'be', 'come', 'exceed', 'visit', 'overtake', 'cross'):
        return None
    adjunct = frame.attribute('altitude')
    if adjunct is None:
        adjunct = frame.length('', 'to', 'at', 'through')
    if adjunct is None or adjunct.measure is None:
        return None
    if not values.accepts('altitude', adjunct.measure):
        return None
    uavs = frame.subjects(lambda e: e.is_uav)
    if len(uavs) != 1:
        return None
    adjunct.used = True
    return AltitudeTrigger(
        on='altitude_reached',
        uav=uavs[0].id,
        value_m=values.explicit('altitude', adjunct.measure),
    )


def _speed(frame: Frame) -> SpeedTrigger | None:
    adjunct = frame.attribute('speed')
    above = frame.key in ('exceed', 'reach', 'accelerate', 'drive', 'come')
    below = frame.key in ('fall_below', 'slow', 'stop')  # `stops (< 0.5 m/s)`
    if adjunct is None or adjunct.measure is None:
        return None
    compared = frame.key in ('', 'be') and adjunct.prep in ('below', 'within', 'beyond')
    if not (above or below or compared):
        return None
    if adjunct.prep in ('below', 'within'):
        above, below = False, True
    elif adjunct.prep == 'beyond':
        above, below = True, False
    if not values.accepts('trigger_speed', adjunct.measure):
        return None
    who = who_moves(frame, frame.subjects())
    if len(who) != 1:
        return None
    adjunct.used = True
    return SpeedTrigger(
        on='speed_above' if above else 'speed_below',
        who=who[0].id,
        value_mps=values.explicit('trigger_speed', adjunct.measure),
    )


def _sight(frame: Frame) -> VisibilityTrigger | None:
    seen = frame.key in ('see', 'appear') or (
        frame.key in ('be', '') and frame.mark(AtomKind.IN_VIEW.value) is not None
    )
    if not seen and frame.key not in ('lose', 'vanish'):
        return None
    subjects = frame.subjects()
    observer: Entity | None = None
    target: str | None = None
    if frame.key in ('see', 'lose'):
        observer = subjects[0] if subjects else None
        taken = frame.take(AdjunctKind.OBJECT) or frame.take(AdjunctKind.PHRASE, 'of')
        target = reference(frame, taken.nouns) if taken is not None else None
    else:
        target = subjects[0].id if subjects else None
        phrase = frame.take(AdjunctKind.PHRASE, 'to', 'from', 'of')
        named = frame.objects(phrase.nouns) if phrase is not None else ()
        observer = named[0] if named else None
        if observer is None and len(frame.scene.uavs) == 1:
            observer = frame.scene.uavs[0]
    if observer is None or not observer.is_uav or target is None:
        return None  # only UAVs have a camera
    in_sight = seen is not frame.negated  # `once it no longer sees the van`
    return VisibilityTrigger(
        on='visible' if in_sight else 'occluded', observer=observer.id, target=target
    )


def _message(frame: Frame) -> MessageTrigger | None:
    told = [e.action.receiver for e in frame.scene.events if isinstance(e.action, SendMessage)]
    warned = frame.verb is not None and frame.verb.form is VerbForm.PAST
    if frame.key == 'alert' and warned and not frame.subject_nouns and not frame.passive:
        heir = frame.inherited() if not told and not frame.adjuncts else ()
        by = told[-1] if told else heir[0].id if len(heir) == 1 else None
        if by is not None:  # `once warned`
            return MessageTrigger(on='message_received', by=by, sender=None)
    if frame.key == 'alert' and frame.passive:
        return _warned(frame)
    arrived = frame.key in ARRIVES and frame.has_mark(AtomKind.MESSAGE.value)
    if frame.key != 'receive' and (not arrived):
        return None
    who = frame.subjects(anything)
    if frame.key in ARRIVES and not frame.subject_nouns and told:
        receiver = frame.scene.by_id(told[-1])  # `as soon as the message is there`
        who = (receiver,) if receiver is not None else who
    for adjunct in frame.free(AdjunctKind.OBJECT):
        adjunct.used = False
    for adjunct in frame.free(AdjunctKind.OBJECT) + frame.free(AdjunctKind.PHRASE, 'to'):
        found = frame.objects([n for n in adjunct.nouns if n.kind in ACTORS]) if arrived else ()
        if found and found[0].id in told:  # `once the message has reached the car`
            adjunct.used = True
            who = found
    refers = all(n.kind is NounKind.PRONOUN for n in frame.subject_nouns)
    if refers and told and all(e.id not in told for e in who):
        receiver = frame.scene.by_id(told[-1])  # `when it gets the message`: who was told
        who = (receiver,) if receiver is not None else who
    frame.mark(AtomKind.MESSAGE.value)
    phrase = frame.take(AdjunctKind.PHRASE, 'from', 'of')
    senders = frame.objects(phrase.nouns) if phrase is not None else ()
    if len(who) != 1 or who == senders:
        return None
    return MessageTrigger(
        on='message_received', by=who[0].id, sender=senders[0].id if senders else None
    )


ARRIVES = ('reach', 'come', 'be', 'contain', 'keep')


def _warned(frame: Frame) -> MessageTrigger | None:
    """`once the car has been warned (by the drone)`."""
    patient = frame.take(AdjunctKind.OBJECT)
    receivers = frame.objects(patient.nouns) if patient is not None else ()
    if len(receivers) != 1:
        return None
    senders = frame.subjects() if frame.subject_nouns else ()
    if receivers == senders:
        return None
    return MessageTrigger(
        on='message_received', by=receivers[0].id, sender=senders[0].id if senders else None
    )


def _arrival(frame: Frame) -> ArrivalTrigger | None:
    if frame.key not in ('reach', 'drive', 'come', 'be', 'walk', 'step_onto'):
        return None
    for adjunct in frame.free(AdjunctKind.OBJECT) + frame.free(
        AdjunctKind.PHRASE, 'at', 'to', 'in', 'on'
    ):
        for noun in adjunct.nouns:
            place = frame.resolver.place(noun)
            who = who_moves(frame, frame.subjects()) if place is not None else ()
            if noun.key == 'there' and place is not None:
                who, place = _under_way(frame, who, place)
            if place is not None and len(who) == 1:
                adjunct.used = True
                return ArrivalTrigger(on='arrives', who=who[0].id, place=place)
    return None


def _under_way(
    frame: Frame, who: tuple[Entity, ...], place: str
) -> tuple[tuple[Entity, ...], str]:
    """`a bus drives to the station; once it is there, …`: who is going to a place, and which."""
    refers = all(n.kind is NounKind.PRONOUN for n in frame.subject_nouns)
    known = [e for e in frame.scene.agents if e in who or refers]
    for entity in reversed(known):
        goals = [b.target for b in entity.behaviors if b.target is not None]
        if goals and frame.scene.by_id(goals[-1]) is None:
            return (entity,), goals[-1]
    return who, place


def _done(frame: Frame) -> MissionDoneTrigger | None:
    completes = frame.key == 'trace' and frame.verb is not None and _COMPLETES in _said(frame)
    if frame.key not in ('finish', 'land') and not completes:
        return None
    uavs = frame.subjects(lambda e: e.is_uav)
    if not uavs and not frame.subject_nouns:
        uavs = tuple(frame.scene.uavs)  # `message the bus when done`
    if len(uavs) != 1:
        return None
    if frame.verb is not None and _tells_more(frame):
        over = told_cause(frame)
        if isinstance(over, MissionDoneTrigger):
            return over  # `has finished its pattern`: the flight that was told before
        if frame.key == 'finish' or completes:
            mission(frame)  # `when finished with its orbit of the market`
    for mark in frame.free(AdjunctKind.MARK, AtomKind.ROUTE.value, AtomKind.PATTERN.value):
        mark.used = True
    return MissionDoneTrigger(on='mission_done', uav=who_flew(frame.scene, uavs[0]).id)


def _did_so(frame: Frame) -> EventDoneTrigger | None:
    """`only after the van has done so`: the last event in which the van acted."""
    if frame.key != 'keep' or not _said(frame).startswith('d'):
        return None
    who = frame.subjects()
    for event in reversed(frame.scene.events):
        actor = getattr(event.action, 'agent', None) or getattr(event.action, 'uav', None)
        if len(who) == 1 and actor == who[0].id:
            return EventDoneTrigger(on='event_done', event=event.id)
    return None


def _climbed(frame: Frame) -> EventDoneTrigger | None:
    """`20 s after the climb`: the last one that was told; how high it went was told there."""
    if frame.key != 'ascend' or frame.length() is not None:
        return None
    who = [e.id for e in frame.subjects(lambda e: e.is_uav)]
    for event in reversed(frame.scene.events):
        climb = event.action
        if isinstance(climb, UavAction) and climb.do == 'ascend' and climb.uav in who:
            return EventDoneTrigger(on='event_done', event=event.id)
    return None


_COMPLETES = 'complet'


def _said(frame: Frame) -> str:
    assert frame.verb is not None
    return frame.scene.prompt[frame.verb.start : frame.verb.end].lower()


def _tells_more(frame: Frame) -> bool:
    """`when finished with its orbit of the market`: the flight is told here."""
    route = AtomKind.ROUTE.value
    return any(not a.used and a.key != route and not _refers(a) for a in frame.adjuncts)


def _refers(adjunct: Adjunct) -> bool:
    return bool(adjunct.nouns) and all(n.kind is NounKind.PRONOUN for n in adjunct.nouns)


def _elapsed(frame: Frame) -> TimeTrigger | None:
    """`once 10 s have passed`."""
    adjunct = frame.time('')
    if adjunct is None or adjunct.measure is None or frame.subject_nouns:
        return None
    if frame.key not in ELAPSED or not values.accepts('trigger_time', adjunct.measure):
        return None
    adjunct.used = True
    return TimeTrigger(on='time', at_s=values.explicit('trigger_time', adjunct.measure))


def _behavior(frame: Frame) -> EventDoneTrigger | None:
    """`when the bus brakes`: an event of its own, whose cause the prompt does not state."""
    scene = frame.scene
    if frame.key in TELLING:
        return _telling(frame)
    action = agent_action(frame)
    if action is None:
        return None
    on: Literal['event_done', 'event_begun'] = 'event_begun' if sets_in(frame) else 'event_done'
    if not shows_its_beginning(action):
        on = 'event_done'
    for event in scene.events:
        if event.action == action or _is_same_act(event.action, action):
            return EventDoneTrigger(on=on, event=event.id)
    made = scene.add_event(action, frame.span)
    made.clauses.append(scene.clause_number)
    scene.became(made.id)
    return EventDoneTrigger(on=on, event=made.id)


def _is_same_act(told: EventAction | None, again: AgentAction) -> bool:
    """`it slows to 5 m/s. Once it has slowed, …`: to what speed is told once."""
    if not isinstance(told, AgentAction) or again.value_mps is not None:
        return False
    return (told.do, told.agent) == (again.do, again.agent)


def _telling(frame: Frame) -> EventDoneTrigger | None:
    """`once the drone has warned the ego`: told before, or a message whose cause stays open."""
    scene = frame.scene
    who = frame.subjects()
    for event in reversed(scene.events):
        if isinstance(event.action, SendMessage) and who and event.action.sender == who[0].id:
            for adjunct in frame.free(AdjunctKind.OBJECT) + frame.free(AdjunctKind.PHRASE, 'to'):
                adjunct.used = bool(frame.objects(adjunct.nouns))
            frame.mark(AtomKind.MESSAGE.value)
            return EventDoneTrigger(on='event_done', event=event.id)
    sent = message(frame) if frame.subject_nouns else None
    if sent is None:
        return None
    made = scene.add_event(sent, frame.span)
    made.clauses.append(scene.clause_number)
    scene.became(made.id)
    return EventDoneTrigger(on='event_done', event=made.id)
