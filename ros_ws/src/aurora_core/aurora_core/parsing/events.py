# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Puts cause and effect together."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.constructions.distances import DistanceCause
from aurora_core.parsing.constructions.triggers import Cause
from aurora_core.parsing.scene import ClauseDraft, Doubt, EventDraft, Scene
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    DistanceTrigger,
    EventAction,
    EventDoneTrigger,
    MessageTrigger,
    SendMessage,
    Trigger,
    UavAction,
)
from aurora_core.spec.vocabulary import ClauseStatus


def complete_event(
    scene: Scene, found: Cause, action: EventAction, span: Span, clauses: Sequence[ClauseDraft]
) -> EventDraft | None:
    """Add the event; `once it is at 40 m it tracks …` is the sequence that every mission has."""
    if _is_climb_before_mission(scene, found, action):
        for clause in clauses:
            assert isinstance(action, UavAction)
            clause.ids[str(action.mission)] = None
            clause.status = ClauseStatus.ENCODED
        return None
    trigger = _heard(scene, settled(scene, found, action), action)
    # `after the car brakes … The car brakes at 25 s`: one event, told in two places.
    known = [e for e in scene.events if e.trigger is None and e.action == action]
    told = [e for e in scene.events if e.trigger == trigger and e.action == action]
    if told and trigger is not None:  # `until the bus arrives …; once it has, it lands`
        event = told[0]
    elif known and trigger is not None and isinstance(action, AgentAction | SendMessage):
        event = known[0]
        event.trigger = trigger
    else:
        event = scene.add_event(action, span, trigger)
    for clause in (*clauses, scene.clause):
        clause.ids[event.id] = None
        clause.status = ClauseStatus.ENCODED
    return event


def _heard(scene: Scene, trigger: Trigger | None, action: EventAction) -> Trigger | None:
    """`when the drone warns the car, the car brakes`: whoever is told acts on the message."""
    if not isinstance(trigger, EventDoneTrigger) or trigger.after_s is not None:
        return trigger
    told = next((e.action for e in scene.events if e.id == trigger.event), None)
    acting = (getattr(action, name, None) for name in ('agent', 'uav', 'sender'))
    if not isinstance(told, SendMessage) or told.receiver not in acting:
        return trigger
    return MessageTrigger(on='message_received', by=told.receiver, sender=told.sender)


def same_cause(
    scene: Scene, first: EventDraft, action: EventAction, span: Span, *, then: bool
) -> EventDraft:
    """Add a second effect: of the same cause, or after the first effect when `then` says so."""
    trigger: Trigger | None = first.trigger
    if then:
        trigger = EventDoneTrigger(on='event_done', event=first.id)
    if trigger == first.trigger and action == first.action:
        scene.became(first.id)
        return first
    event = scene.add_event(action, span, trigger)
    scene.became(event.id)
    return event


def _is_climb_before_mission(scene: Scene, found: Cause, action: EventAction) -> bool:
    if not isinstance(found, AltitudeTrigger) or not isinstance(action, UavAction):
        return False
    if action.do != 'change_mission' or action.uav != found.uav:
        return False
    mission = next(m for m in scene.missions if m.id == action.mission)
    if mission.altitude is not None and mission.altitude.value != found.value_m.value:
        return False
    mission.altitude = mission.altitude or found.value_m
    return True


def settled(scene: Scene, found: Cause, action: EventAction) -> Trigger | None:
    """Return the trigger of a cause; None, with a doubt, when its other end stays open."""
    if not isinstance(found, DistanceCause):
        return found
    other = found.b or _other_end(scene, found, action)
    if other is None:
        span = found.value_m.span
        assert span is not None
        question = f'How far from whom should {found.a.id} be?'
        scene.doubts.append(Doubt(span=span, question=question))
        return None
    return DistanceTrigger(
        on='distance_below' if found.below else 'distance_above',
        a=found.a.id,
        b=other,
        value_m=found.value_m,
    )


def _other_end(scene: Scene, found: DistanceCause, action: EventAction) -> str | None:
    """Return whom `comes within 20 m` means: who is told, who acts, who is followed, the ego."""
    a = found.a
    if isinstance(action, SendMessage):
        told = scene.by_id(action.receiver)
        if told is not None and told is not a:
            return told.id
    if isinstance(action, AgentAction) and action.agent != a.id:
        return action.agent
    if isinstance(action, UavAction) and action.uav != a.id:
        return action.uav
    for behavior in a.behaviors:
        if behavior.target is not None and scene.by_id(behavior.target) is not None:
            return behavior.target
    if scene.ego is not None and scene.ego is not a:
        return scene.ego.id
    others = [e for e in scene.agents if e is not a]
    return others[0].id if len(others) == 1 else None
