# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What happened in a run, as a short numbered list of moments with their places."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from aurora_core.outcomes.condition import Condition
from aurora_core.report.scene.caption import Failure
from aurora_core.report.scene.tracks import Track
from aurora_core.spec.flight_order import stays_where_it_is
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    BatteryTrigger,
    BehaviorDoneTrigger,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    HeadwayTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    SpeedTrigger,
    TimeTrigger,
    UavAction,
    UavMission,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UavPhase
from aurora_core.trace.records import EventRecord, LinkEventKind, LinkRecord, ScenarioEventKind
from aurora_core.trace.trace import Trace

_MOST_MOMENTS = 13


class Tone(StrEnum):
    """How a moment is shown."""

    FLIGHT = 'flight'
    MOTION = 'motion'
    EVENT = 'event'
    FAULT = 'fault'
    FAILURE = 'failure'


# What is left out first when there is too much to tell.
_RANK = (Tone.MOTION, Tone.FLIGHT, Tone.EVENT, Tone.FAULT, Tone.FAILURE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """Something that happened.

    Attributes:
        tick: When; -1 when it has no time of its own.
        text: A few words.
        place_m: Where, ENU metres in the plane; None when it has no place.
    """

    tick: int
    text: str
    tone: Tone
    place_m: tuple[float, float] | None = None


def moments_of(
    trace: Trace,
    tracks: tuple[Track, ...],
    spec: ScenarioSpec | None,
    failures: tuple[Failure, ...],
    altitudes: Mapping[str, float],
) -> tuple[Moment, ...]:
    """Return the moments in order of time, at most a dozen or so; failures are never left out.

    Args:
        trace: The run.
        tracks: Its bodies.
        spec: The request, for the words of missions and triggers.
        failures: Conditions that do not hold.
        altitudes: Realised altitude in metres by mission.
    """
    by_name = {track.name: track for track in tracks}
    found = [
        *_flights(trace, by_name, spec, altitudes),
        *_releases(trace, by_name),
        *_events(trace, by_name, spec),
        *_messages(trace, by_name),
        *_faults(trace, by_name),
        *_failures(trace, failures),
    ]
    for tone in _RANK[:-1]:
        while len(found) > _MOST_MOMENTS and any(m.tone is tone for m in found):
            found.remove(next(m for m in reversed(found) if m.tone is tone))
    # A failure without a time comes last.
    return tuple(sorted(found, key=lambda m: (m.tick < 0, m.tick, _RANK.index(m.tone))))


def realised_altitudes(conditions: tuple[Condition, ...]) -> dict[str, float]:
    """Return the altitude that each mission was grounded to."""
    missions = (condition.arguments.mission for condition in conditions)
    return {mission.mission: mission.altitude_m for mission in missions if mission is not None}


def _flights(
    trace: Trace,
    by_name: dict[str, Track],
    spec: ScenarioSpec | None,
    altitudes: Mapping[str, float],
) -> list[Moment]:
    """Take-off, each mission, landing and touch-down of every UAV."""
    found = []
    for record in trace.events:
        if record.kind is not ScenarioEventKind.PHASE or record.subject not in by_name:
            continue
        track = by_name[record.subject]
        if record.detail == 'ascent':
            text = 'takes off'
        elif record.detail == 'landing':
            text = 'mission done, goes to land'
        else:
            text = _mission_words(record.detail, spec, altitudes)
        found.append(
            Moment(
                tick=record.tick,
                text=f'{track.name} {text}',
                tone=Tone.FLIGHT,
                place_m=track.at(record.tick),
            )
        )
    for track in by_name.values():
        if track.is_uav:
            landing = np.flatnonzero((track.phase >= UavPhase.LANDING) & ~track.airborne)
            if len(landing):
                tick = int(landing[0])
                found.append(
                    Moment(
                        tick=tick,
                        text=f'{track.name} has landed',
                        tone=Tone.FLIGHT,
                        place_m=track.at(tick),
                    )
                )
    return found


def _mission_words(
    mission_id: str, spec: ScenarioSpec | None, altitudes: Mapping[str, float]
) -> str:
    mission = next((m for m in spec.missions if m.id == mission_id), None) if spec else None
    if mission is None:
        return f'begins {mission_id}'
    altitude_m = altitudes.get(mission_id, mission.altitude_m.value)
    words = mission_words(mission, stays=spec is not None and stays_where_it_is(spec, mission))
    return f'at {altitude_m:g} m, {words}'


def mission_words(mission: UavMission, *, stays: bool = False) -> str:
    """Return what a UAV does in a mission, such as `tracks bus1 from 35 m`.

    Args:
        mission: Which.
        stays: It hovers where the one before has led its UAV.
    """
    target = _plain(mission.target) if mission.target else 'the scene'
    if mission.mode is MissionMode.TRACK:
        standoff = mission.standoff_m.value if mission.standoff_m is not None else 0.0
        return f'tracks {target}' + (f' from {standoff:g} m' if standoff else '')
    if mission.mode is MissionMode.HOVER:
        return 'hovers where it is' if stays else f'hovers over {target}'
    pattern = mission.pattern.value if mission.pattern is not None else 'route'
    return f'flies the {pattern} around {target}' if mission.target else f'flies the {pattern}'


def _releases(trace: Trace, by_name: dict[str, Track]) -> list[Moment]:
    """Agents that start to move, those of one tick together."""
    together: dict[int, list[str]] = {}
    for record in trace.events:
        if record.kind is ScenarioEventKind.RELEASED and record.tick > 0:
            together.setdefault(record.tick, []).append(record.subject)
    found = []
    for tick, names in together.items():
        shown = ', '.join(names[:3]) + (f' and {len(names) - 3} more' if len(names) > 3 else '')
        verb = 'starts' if len(names) == 1 else 'start'
        track = by_name.get(names[0])
        found.append(
            Moment(
                tick=tick,
                text=f'{shown} {verb} to move',
                tone=Tone.MOTION,
                place_m=track.at(tick) if track is not None else None,
            )
        )
    return found


def _events(trace: Trace, by_name: dict[str, Track], spec: ScenarioSpec | None) -> list[Moment]:
    """Triggers and actions; the action of a trigger's own tick needs no moment of its own."""
    events = {event.id: event for event in spec.events} if spec else {}
    found = []
    triggered: dict[str, int] = {}
    for record in trace.events:
        event = events.get(record.subject)
        if record.kind is ScenarioEventKind.TRIGGERED:
            triggered[record.subject] = record.tick
            if event is not None and _comes_with_another(event):
                continue
            text, who = _trigger_words(event, record, events)
        elif record.kind is ScenarioEventKind.ACTION:
            at_once = triggered.get(record.subject) == record.tick
            if at_once and event is not None and isinstance(event.action, SendMessage):
                continue  # the message has a moment of its own
            text, who = _action_words(event, record, spec)
        else:
            continue
        track = by_name.get(who)
        found.append(
            Moment(
                tick=record.tick,
                text=text,
                tone=Tone.EVENT,
                place_m=track.at(record.tick) if track is not None else None,
            )
        )
    return found


def _comes_with_another(event: Event) -> bool:
    """Tell whether a trigger is an action that has a moment of its own: its, or another's."""
    trigger = event.trigger
    if isinstance(trigger, EventDoneTrigger):
        return trigger.after_s is None
    return trigger is None and event.action is not None


def _trigger_words(
    event: Event | None, record: EventRecord, events: Mapping[str, Event]
) -> tuple[str, str]:
    trigger = event.trigger if event is not None else None
    if isinstance(trigger, DistanceTrigger):
        way = 'within' if trigger.on == 'distance_below' else 'beyond'
        return f'{trigger.a} {way} {trigger.value_m.value:g} m of {_plain(trigger.b)}', trigger.a
    if isinstance(trigger, TimeTrigger):
        return f'{trigger.at_s.value:g} s reached ({record.subject})', ''
    if isinstance(trigger, BatteryTrigger):
        return f'{trigger.uav} has less than {100.0 * trigger.value.value:g} % left', trigger.uav
    if isinstance(trigger, BehaviorDoneTrigger):
        return (
            f'the stated time of {trigger.who} to {_plain(trigger.behavior)} is over',
            trigger.who,
        )
    if isinstance(trigger, AltitudeTrigger):
        return f'{trigger.uav} reaches {trigger.value_m.value:g} m', trigger.uav
    if isinstance(trigger, VisibilityTrigger):
        verb = 'sees' if trigger.on == 'visible' else 'loses sight of'
        return f'{trigger.observer} {verb} {_plain(trigger.target)}', trigger.observer
    if isinstance(trigger, ArrivalTrigger):
        return f'{trigger.who} arrives at {_plain(trigger.place)}', trigger.who
    if isinstance(trigger, MessageTrigger):
        return f'{trigger.by} has received the message', trigger.by
    if isinstance(trigger, HeadwayTrigger):
        what = 'headway' if trigger.on == 'headway_below' else 'time to collision'
        return f'{what} of {trigger.a} below {trigger.value_s.value:g} s', trigger.a
    if isinstance(trigger, SpeedTrigger):
        way = 'below' if trigger.on == 'speed_below' else 'above'
        return f'{trigger.who} {way} {trigger.value_mps.value:g} m/s', trigger.who
    if isinstance(trigger, MissionDoneTrigger):
        return f'{trigger.uav} has flown its missions', trigger.uav
    if isinstance(trigger, EventDoneTrigger) and trigger.after_s is not None:
        awaited = events.get(trigger.event)
        words, who = _action_words(awaited, record, None)
        return f'{trigger.after_s.value:g} s after {words}', who
    return f'{record.subject} triggered', ''


def _action_words(
    event: Event | None, record: EventRecord, spec: ScenarioSpec | None
) -> tuple[str, str]:
    action = event.action if event is not None else None
    if isinstance(action, SendMessage):
        return f'{action.sender} alerts {action.receiver}', action.sender
    if isinstance(action, AgentAction):
        return f'{action.agent}: {action.do.replace("_", " ")}', action.agent
    if isinstance(action, UavAction) and action.do == 'change_mission' and spec is not None:
        mission = next((m for m in spec.missions if m.id == action.mission), None)
        if mission is not None:
            words = mission_words(mission, stays=stays_where_it_is(spec, mission))
            return f'{action.uav} goes over: {words}', action.uav
    if isinstance(action, UavAction):
        return f'{action.uav}: {action.do.replace("_", " ")}', action.uav
    return f'{record.subject} acts', ''


def _messages(trace: Trace, by_name: dict[str, Track]) -> list[Moment]:
    """One moment per message: sent, and what became of it."""
    ledger: dict[int, list[LinkRecord]] = {}
    for record in trace.links:
        ledger.setdefault(record.message, []).append(record)
    found = []
    for records in ledger.values():
        sent = next((r for r in records if r.kind is LinkEventKind.SENT), records[0])
        done = next((r for r in records if r.kind is LinkEventKind.DELIVERED), None)
        text = f'{sent.sender} → {sent.receiver}: message '
        if done is not None:
            delay_s = (done.tick - sent.tick) * trace.roster.dt_s
            text += f'delivered after {delay_s:.2f} s'
        else:
            attempts = sum(r.kind is LinkEventKind.ATTEMPT_LOST for r in records)
            text += f'lost ({attempts} attempts)' if attempts else 'not delivered'
        track = by_name.get(sent.sender)
        found.append(
            Moment(
                tick=sent.tick,
                text=text,
                tone=Tone.EVENT if done is not None else Tone.FAILURE,
                place_m=track.at(sent.tick) if track is not None else None,
            )
        )
    return found


def _faults(trace: Trace, by_name: dict[str, Track]) -> list[Moment]:
    found = []
    for record in trace.events:
        if record.kind is ScenarioEventKind.FAULT:
            track = by_name.get(record.subject)
            whom = 'every link' if record.subject == '*' else record.subject
            # The body may be gone with this very tick: the last place is the right one.
            places = (track.at(tick) for tick in range(record.tick, -1, -1)) if track else ()
            found.append(
                Moment(
                    tick=record.tick,
                    text=f'injected fault: {record.fault_kind.replace("_", " ")} ({whom})',
                    tone=Tone.FAULT,
                    place_m=next((place for place in places if place is not None), None),
                )
            )
    return found


def _failures(trace: Trace, failures: tuple[Failure, ...]) -> list[Moment]:
    found = []
    for failure in failures:
        tick = -1
        if failure.time_s is not None and trace.roster.dt_s > 0:
            tick = round(failure.time_s / trace.roster.dt_s)
        place = failure.place_m[:2] if failure.place_m is not None else None
        found.append(
            Moment(tick=tick, text=f'✗ {failure.sentence}', tone=Tone.FAILURE, place_m=place)
        )
    return found


def _plain(reference: str) -> str:
    return reference.removeprefix('landmark:').replace('_', ' ')
