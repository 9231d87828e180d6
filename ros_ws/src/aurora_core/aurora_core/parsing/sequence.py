# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What happens after what, when no `when` says so: `later`, `then`, who was told acts."""

from __future__ import annotations

import re

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.constructions import actions
from aurora_core.parsing.constructions.triggers import cause
from aurora_core.parsing.criteria.sequels import Sequels
from aurora_core.parsing.criteria.words import criteria_words
from aurora_core.parsing.events import complete_event
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.pieces import Link, Piece
from aurora_core.parsing.pronouns import anything, mobile
from aurora_core.parsing.reactions import REACTIONS, reaction
from aurora_core.parsing.scene import EventDraft, Scene
from aurora_core.parsing.told_pieces import PHASES, is_phase, without_link
from aurora_core.spec.events import comes_to_an_end
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    EventAction,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    UavAction,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import MissionMode

_BESIDE = 24  # characters around a clause, where its word of sequence stands
_MOMENTS = (EventDoneTrigger, MessageTrigger, AltitudeTrigger, ArrivalTrigger, VisibilityTrigger)
# What a UAV does at once.
_ANSWERS = ('ascend', 'descend', 'land', 'alert', 'send', 'report')


def later(frame: Frame) -> bool:
    """`…; ten seconds later, the bus starts`: so long after the last event."""
    scene = frame.scene
    adjunct = _lag(frame)
    if adjunct is None or adjunct.measure is None:
        return False
    if not _known_event(frame):
        _ends_phase(frame, adjunct)
        return False
    if not values.accepts('delay', adjunct.measure):
        return False
    adjunct.used = True  # no duration of what begins then
    action = actions.action(frame)
    adjunct.used = action is not None
    if action is None:
        return False
    lag = values.explicit('delay', adjunct.measure)
    if adjunct.prep == 'within':
        lag = values.rebound(lag, Bound.AT_MOST)
    first = scene.events[-1]
    if isinstance(action, AgentAction) and first.action == action and len(scene.events) > 1:
        first = scene.events[-2]
    done = EventDoneTrigger(on='event_done', event=first.id)
    event = complete_event(scene, done, action, frame.span, ())
    if event is not None:
        event.delay = lag
    return True


def _ends_phase(frame: Frame, adjunct: Adjunct) -> None:
    """`it tracks a bus; 30 s later it hovers`: so long it has tracked the bus."""
    measure = adjunct.measure
    acting = frame.subjects() if frame.subject_nouns else frame.inherited()
    phases = frame.scene.missions_of(acting[0]) if len(acting) == 1 else []
    behind = frame.scene.prompt[adjunct.end :].lstrip(' ,').lower()
    last = behind.startswith(tuple(shipped_lexicon().turns['from_the_last']))
    begins = frame.key in PHASES | {'navigate', 'land'}
    if not phases or measure is None or not begins or not last:
        return
    adjunct.used = True  # how long the next phase takes it does not say
    stays = phases[-1].mode is not MissionMode.NAVIGATE and phases[-1].duration is None
    if stays and values.accepts('mission_duration', measure):
        phases[-1].duration = values.explicit('mission_duration', measure)
    else:
        frame.flag(adjunct.start, adjunct.end)


def _lag(frame: Frame) -> Adjunct | None:
    """Return the time of `5 s later`, `with a delay of 5 s`, `then … within 5 s`."""
    adjunct = frame.time('', 'after')
    if adjunct is not None:
        words = shipped_lexicon().turns
        behind = frame.scene.prompt[adjunct.end :].lstrip(' ,').lower()
        lag = rf'\b(?:{"|".join(sorted(words["lag"]))}) (?:of )?$'
        last = behind.startswith(tuple(words['from_the_last']))
        if last or re.search(lag, _in_front(frame, adjunct)):
            return adjunct
    delayed = frame.attribute('latency')
    if delayed is not None and not frame.has_mark(AtomKind.LINK.value) and frame.key in REACTIONS:
        return delayed
    soon = frame.time('within')
    return soon if soon is not None and frame.piece.then and frame.key in REACTIONS else None


def _in_front(frame: Frame, adjunct: Adjunct) -> str:
    start = adjunct.measure.start if adjunct.measure is not None else adjunct.start
    return frame.scene.prompt[max(0, start - 24) : start].lower()


def _known_event(frame: Frame) -> bool:
    """Return whether something happened before; a plain `brakes` in front becomes an event."""
    scene = frame.scene
    if scene.events:
        return True
    for clause in reversed(scene.clauses[:-1]):
        for entity in clause.subjects:
            done = [b for b in entity.behaviors if b.kind.value in REACTIONS]
            if not done or entity.is_uav:
                continue
            entity.behaviors.remove(done[-1])
            action = reaction(done[-1].kind.value, entity.id, done[-1].speed_mps)
            clause.ids[scene.add_event(action, clause.span).id] = None
            return True
    return False


def who_was_told(frame: Frame) -> bool:
    """`it sends the car a message, and the car then yields`: when the message arrives."""
    events = frame.scene.events
    message = events[-1].action if events else None
    if frame.negated or not (frame.piece.then or _answers_at_once(frame)):
        return False
    if not isinstance(message, SendMessage):
        return frame.piece.then and _reacts(frame)
    fits = mobile if frame.key in REACTIONS else anything
    acting = frame.subjects(fits) if frame.subject_nouns or frame.piece.head else ()
    if [e.id for e in acting] != [message.receiver]:
        return False
    action = actions.action(frame)
    if action is None:
        return False
    heard = MessageTrigger(on='message_received', by=message.receiver, sender=message.sender)
    complete_event(frame.scene, heard, action, frame.span, ())
    return True


def _answers_at_once(frame: Frame) -> bool:
    """`the drone warns the bus at 10 s, and it stops`, `…, which stops`: in the same sentence."""
    clauses = frame.scene.clauses
    if frame.key not in REACTIONS or frame.piece.link not in (Link.MAIN, Link.RELATIVE):
        return False
    if len(clauses) < 2 or not frame.scene.events:
        return False
    told = clauses[-2]
    same = told.sentence == frame.piece.sentence and frame.scene.events[-1].id in told.ids
    return same and frame.time('at', 'after', 'in', '') is None


def after_told(frame: Frame, before: Piece | None) -> bool:
    """`it gets a message. Then it accelerates`, `the second car slows afterwards`."""
    scene = frame.scene
    told = scene.prompt[frame.piece.start : frame.piece.end].lower()
    later_on = frame.piece.then or criteria_words()['later_words'].search(told)
    if not later_on or before is None or frame.negated:
        return False
    if behind_landing(frame, before):
        return True
    if frame.key not in (*REACTIONS, 'land'):
        return False
    count = len(scene.events)
    earlier = Frame(without_link(before, Link.AFTER), scene, frame.resolver)
    found = cause(earlier)
    if not isinstance(found, _MOMENTS):
        if not scene.events:
            return False
        found = EventDoneTrigger(on='event_done', event=scene.events[-1].id)
    action: EventAction | None = actions.agent_action(frame)
    if frame.key == 'land' and any(a.key in REACTIONS for a in before.atoms):
        action = actions.action(frame)
    told_so = [e.action for e in scene.events if e.id == getattr(found, 'event', None)]
    if action is None or action in told_so:
        del scene.events[count:]
        return False
    complete_event(scene, found, action, frame.span, ())
    return True


def behind_landing(frame: Frame, landing: Piece) -> bool:
    """`drone A lands. Then drone B lands`: what another does when a flight is over."""
    if frame.key not in (*REACTIONS, *_ANSWERS) or not any(a.key == 'land' for a in landing.atoms):
        return False
    scene, acting = frame.scene, frame.scene.clause.subjects
    over = cause(Frame(without_link(landing, Link.AFTER), scene, frame.resolver))
    scene.clause.subjects = acting
    if not isinstance(over, MissionDoneTrigger):
        return False
    action = actions.action(frame)
    if action is None or (isinstance(action, UavAction) and action.uav == over.uav):
        return False
    complete_event(scene, over, action, frame.span, ())
    return True


def before_told(frame: Frame, before: Piece | None) -> None:
    """`the truck must brake | before the bus stops`: what is told second happens second."""
    scene = frame.scene
    if before is None or behind_landing(frame, before):
        return
    second = actions.agent_action(frame)
    if second is None:
        return
    acting = scene.clause.subjects
    first = actions.agent_action(Frame(before, scene, frame.resolver))
    scene.clause.subjects = acting
    if first is None or first == second:
        return
    one, other = (_event_of(scene, action, frame) for action in (first, second))
    Sequels(scene, frame.span).chain(one, other)
    scene.became(other.id)


def _event_of(scene: Scene, action: AgentAction, frame: Frame) -> EventDraft:
    known = next((e for e in scene.events if e.action == action), None)
    if known is None:
        known = scene.add_event(action, frame.span)
    scene.became(known.id)
    return known


def soon(frame: Frame, before: int) -> None:
    """`…, within 4 s`, `at most 20 s later`: the deadline of what the clause makes happen."""
    events = frame.scene.events
    made = events[before:] or [e for e in events if e.id in frame.scene.clause.ids]
    if not made or made[-1].delay is not None:
        return
    if isinstance(made[-1].trigger, EventDoneTrigger | MissionDoneTrigger | AltitudeTrigger):
        made[-1].delay = _deadline(frame)


def answered_within(frame: Frame, action: EventAction | None) -> Parameter | None:
    """Take the time within which somebody has begun, or done, what he is told."""
    at_once = isinstance(action, AgentAction) and action.do in ('brake', 'start')
    return _deadline(frame) if at_once or comes_to_an_end(action) else None


def _deadline(frame: Frame) -> Parameter | None:
    for adjunct in frame.free(AdjunctKind.MEASURE, TIME):
        measure = adjunct.measure
        assert measure is not None
        bounded = measure.bound is Bound.AT_MOST or adjunct.prep in ('within', 'below')
        if bounded and values.accepts('delay', measure):
            adjunct.used = True
            return values.rebound(values.explicit('delay', measure), Bound.AT_MOST)
    return None


def _reacts(frame: Frame) -> bool:
    """`the bus brakes at 15 s, whereupon my car stops`: caused by the event in front."""
    scene = frame.scene
    answers = frame.key in _ANSWERS  # `the van stops, whereupon the drone climbs to 60 m`
    earliest = frame.piece.sentence - answers
    same = [c for c in scene.clauses[:-1] if c.sentence >= earliest]
    told = [e for e in scene.events if any(e.id in c.ids for c in same)]
    if not frame.subject_nouns or frame.key not in (*REACTIONS, *_ANSWERS):
        return False
    if not told and _known_event(frame):
        told = [e for e in scene.events if any(e.id in c.ids for c in same)]
    if not told:
        return False
    action = actions.action(frame) if answers else actions.agent_action(frame)
    if action is None:
        return False
    if told[-1].action == action:
        scene.became(told[-1].id)  # `waits until it is green, then it starts`
        return True
    done = EventDoneTrigger(on='event_done', event=told[-1].id)
    complete_event(scene, done, action, frame.span, ())
    return True


def in_sequence(frame: Frame, before: int) -> None:
    """Give an event of this clause without a cause what happened before it as its cause."""
    events = frame.scene.events
    if len(events) != before + 1 or events[-1].trigger is not None:
        return
    relayed = _relayed(events[-1], events[:before])
    if relayed is not None:
        events[-1].trigger = relayed
    elif before and frame.piece.then:  # `after that the drone warns the ego`
        events[-1].trigger = EventDoneTrigger(on='event_done', event=events[before - 1].id)
    elif frame.piece.then:
        _after_its_phase(frame, events[-1])


def after_others(frame: Frame, flown: int, told: Piece | None) -> None:
    """`drone A hovers there. Then drone B tracks the bus`: when the phase of the other is over.

    Args:
        frame: The clause.
        flown: Number of missions that were told before the clause.
        told: The clause before: `when drone A has hovered for 20 s, drone B …`.
    """
    scene = frame.scene
    made = scene.missions[flown:]
    phase = told is not None and told.link in (Link.WHEN, Link.AFTER) and is_phase(told)
    if len(made) != 1 or not flown or not frame.piece.then or not (phase or goes_on(frame)):
        return
    before, new = scene.missions[flown - 1], made[0]
    caused = any(
        isinstance(e.action, UavAction) and e.action.mission == new.id for e in scene.events
    )
    if before.uav is new.uav or caused or scene.missions_of(new.uav) != [new]:
        return
    change = UavAction(do='change_mission', uav=new.uav.id, mission=new.id)
    over = MissionDoneTrigger(on='mission_done', uav=before.uav.id)
    complete_event(scene, over, change, frame.span, ())


def goes_on(frame: Frame) -> bool:
    """`then`, `afterwards`; `next` and `finally` may just go on with a list."""
    words = shipped_lexicon().turns['goes_on']
    begin, end = frame.piece.start, frame.piece.end
    prompt = frame.scene.prompt.lower()
    behind = re.split(r'[.;!?]', prompt[end : end + _BESIDE])[0]
    told = prompt[max(0, begin - _BESIDE) : end] + behind
    return any(re.search(rf'\b{word}\b', told) for word in words)


def _after_its_phase(frame: Frame, event: EventDraft) -> None:
    """`hovers there for 30 s and only then warns the ego`: when its phase is over."""
    action = event.action
    if not isinstance(action, SendMessage) or len(frame.scene.clauses) < 2:
        return
    sender = frame.scene.by_id(action.sender)
    last = frame.scene.missions_of(sender) if sender is not None and sender.is_uav else []
    if last and last[-1].duration is not None and last[-1].id in frame.scene.clauses[-2].ids:
        event.trigger = MissionDoneTrigger(on='mission_done', uav=action.sender)


def _relayed(event: EventDraft, earlier: list[EventDraft]) -> MessageTrigger | None:
    """`drone A sends a message to drone B, and B passes it on`: once B has it."""
    action = event.action
    if not isinstance(action, SendMessage):
        return None
    for told in reversed(earlier):
        first = told.action
        if isinstance(first, SendMessage) and first.receiver == action.sender:
            return MessageTrigger(on='message_received', by=action.sender, sender=first.sender)
    return None


def sight(frame: Frame) -> VisibilityTrigger | None:
    """`drone A sees the ambulance, sends …`: what a UAV sees in front of what it tells."""
    if frame.key != 'see' or frame.negated or frame.piece.link is not Link.MAIN:
        return None
    flying = [e for e in frame.scene.clause.subjects if e.is_uav]
    seen = frame.scene.clause.objects
    if len(flying) != 1 or len(seen) != 1 or frame.time('for', '') is not None:
        return None
    return VisibilityTrigger(on='visible', observer=flying[0].id, target=seen[0].id)


def after_sight(scene: Scene, before: int, seen: VisibilityTrigger | None) -> None:
    """Let a message without a cause be caused by what its sender saw in the clause before."""
    if seen is None:
        return
    for event in scene.events[before:]:
        action = event.action
        tells = isinstance(action, SendMessage) and action.sender == seen.observer
        if event.trigger is None and tells:
            event.trigger = seen
