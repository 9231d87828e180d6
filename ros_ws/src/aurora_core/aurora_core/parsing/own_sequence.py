# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events that only tell the order in which a UAV's phases follow each other anyway."""

from __future__ import annotations

from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.scene import EventDraft, Scene
from aurora_core.spec.scenario import (
    EventDoneTrigger,
    MissionDoneTrigger,
    TimeTrigger,
    UavAction,
)
from aurora_core.spec.vocabulary import MissionMode


def own_sequence(scene: Scene) -> None:
    """`when its hover is over, it orbits the park`: the sequence that every UAV's phases have."""
    for event in scene.events:
        _phase_over(scene, event)
    for event in tuple(reversed(scene.events)):
        action = event.action
        if not isinstance(action, UavAction) or event.delay is not None:
            continue
        if not _ends_flight(scene, event, action) and not _follows(scene, event, action):
            continue
        waits = any(getattr(e.trigger, 'event', None) == event.id for e in scene.events)
        ordered = any(event.id in (o.first, o.then) for o in scene.orders)
        if not waits and not ordered:
            _leave_out(scene, event, action)


def _phase_over(scene: Scene, event: EventDraft) -> None:
    """`follows it for 45 s. When those 45 s are over, …`: the phase, not 45 s of the run."""
    over = event.trigger
    stated = over.at_s.span if isinstance(over, TimeTrigger) else None
    if not isinstance(over, TimeTrigger) or stated is None:
        return
    in_front = scene.prompt[: stated.start].lower().split()[-1:]
    if not in_front or in_front[0] not in shipped_lexicon().turns['the_same']:
        return
    for mission in reversed(scene.missions):
        told = mission.duration
        if told is None or told.span is None or told.value != over.at_s.value:
            continue
        if told.span.end <= stated.start:
            scene.understood.append(stated)
            event.trigger = MissionDoneTrigger(on='mission_done', uav=mission.uav.id)
            return


def _follows(scene: Scene, event: EventDraft, action: UavAction) -> bool:
    """Return whether a phase begins, or the flight ends, when the former phase is over."""
    over = event.trigger
    if not isinstance(over, MissionDoneTrigger) or over.uav != action.uav:
        return False
    phases = [m.id for m in scene.missions if m.uav.id == action.uav]
    if action.do == 'change_mission':
        return action.mission in phases[1:]
    return bool(phases) and action.do == 'land'


def _ends_flight(scene: Scene, event: EventDraft, action: UavAction) -> bool:
    """`…, then it hovers there for 15 s, and then it lands`: after the 15 s, as every flight."""
    done = event.trigger
    if not isinstance(done, EventDoneTrigger) or action.do != 'land':
        return False
    first = next((e.action for e in scene.events if e.id == done.event), None)
    if not isinstance(first, UavAction) or first.uav != action.uav:
        return False
    phase = next((m for m in scene.missions if m.id == first.mission), None)
    last = [m for m in scene.missions if m.uav.id == action.uav][-1:]
    bounded = phase is not None and (
        phase.duration is not None or phase.mode is MissionMode.NAVIGATE
    )
    return bounded and last == [phase]


def _leave_out(scene: Scene, event: EventDraft, action: UavAction) -> None:
    phases = [m.id for m in scene.missions if m.uav.id == action.uav]
    scene.events.remove(event)
    for clause in scene.clauses:
        if event.id in clause.ids:
            del clause.ids[event.id]
            clause.ids[action.mission or phases[-1]] = None
