# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What events change of the flight of a UAV: which missions wait for one, which ones it ends.

A UAV flies its missions in the order listed. One that is the object of `change_mission` is entered
only when that event acts: it ends the one before, or the hold after that.
"""

from __future__ import annotations

from aurora_core.spec.events import (
    ArrivalTrigger,
    BehaviorDoneTrigger,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    HeadwayTrigger,
    MissionDoneTrigger,
    SendMessage,
    SpeedTrigger,
    Trigger,
    UavAction,
    VisibilityTrigger,
    bodies_of_cause,
)
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.parking import parks, stands
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode

# Triggers by what bodies do or where they are, not by a clock or another event.
_OF_STATES = (DistanceTrigger, HeadwayTrigger, VisibilityTrigger, SpeedTrigger, ArrivalTrigger)


def is_next_anyway(event: Event) -> bool:
    """Tell whether a change of mission waits for nothing but the end of the mission before."""
    action, trigger = event.action, event.trigger
    if not isinstance(action, UavAction) or action.do != 'change_mission':
        return False
    return trigger is None or (
        isinstance(trigger, MissionDoneTrigger) and trigger.uav == action.uav
    )


def climbs_last(event: Event) -> bool:
    """Tell whether a UAV is to climb once its missions are over, and not during one of them."""
    action, trigger = event.action, event.trigger
    return (
        isinstance(action, UavAction)
        and action.do == 'ascend'
        and isinstance(trigger, MissionDoneTrigger)
        and trigger.uav == action.uav
    )


def counts_from_capture(spec: ScenarioSpec, event: Event) -> bool:
    """Tell whether an event that changes a flight counts only once its UAV is where it should be.

    "Hovers at 20 m; when it sees a person it climbs to 50 m": a person in sight on the way up
    ends no hover that has not begun. What a clock or an altitude triggers does not wait.
    """
    if not isinstance(event.action, UavAction):
        return False
    if not isinstance(event.trigger, _OF_STATES):
        return False
    first = next((m for m in spec.missions if m.uav == event.action.uav), None)
    return first is not None and begun_by(spec, first) is None


def begun_by(spec: ScenarioSpec, mission: UavMission) -> Event | None:
    """Return the event that a mission waits for, None when it follows the one before."""
    return next(
        (
            e
            for e in spec.events
            if isinstance(e.action, UavAction)
            and e.action.mission == mission.id
            and e.action.uav == mission.uav
            and not is_next_anyway(e)
        ),
        None,
    )


def end_of(spec: ScenarioSpec, element: str) -> Trigger | None:
    """Return what an event waits for that comes after another one, or after a UAV's last mission.

    None where nothing tells that end: of an event without an action, of a mission that its UAV
    goes on from.
    """
    event = next((e for e in spec.events if e.id == element), None)
    if event is not None:
        done = EventDoneTrigger(on='event_done', event=element)
        return None if event.action is None else done
    mission = next((m for m in spec.missions if m.id == element), None)
    if mission is None or [m.id for m in spec.missions if m.uav == mission.uav][-1] != element:
        return None
    return MissionDoneTrigger(on='mission_done', uav=mission.uav)


def mission_after(spec: ScenarioSpec, mission: UavMission) -> UavMission | None:
    """Return the next mission of the same UAV, None after the last one."""
    own = [m for m in spec.missions if m.uav == mission.uav]
    # A mission that grounding has raised, or moved, is still the one of its id.
    number = next(k for k, m in enumerate(own) if m.id == mission.id)
    return next(iter(own[number + 1 :]), None)


def stays_where_it_is(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a hover holds where the mission before has led its UAV: no place is named."""
    if mission.mode is not MissionMode.HOVER or mission.target is not None:
        return False
    return next(m.id for m in spec.missions if m.uav == mission.uav) != mission.id


def begins_where_it_is(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a pattern begins where the mission before has led its UAV: no place is named.

    Where a tracking ends that an event may end nobody knows before the run.
    """
    nowhere = mission.target is None and mission.start is None and mission.pattern is not None
    if not nowhere or mission.over_streets:
        return False
    own = [m for m in spec.missions if m.uav == mission.uav]
    # A mission that grounding has raised is still the one of its id.
    number = next(k for k, m in enumerate(own) if m.id == mission.id)
    placed = [m for m in own[:number] if not stays_where_it_is(spec, m)]
    if not placed:
        return False
    return placed[-1].mode is not MissionMode.TRACK or left_by(spec, placed[-1]) is None


def keeps_altitude(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a UAV that stays where it is stays as high, too: no altitude is stated."""
    is_open = mission.altitude_m.provenance is not Provenance.EXPLICIT
    return is_open and stays_where_it_is(spec, mission)


def begins_as_high(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a mission without a place and a stated altitude begins as high as its UAV is.

    "Hovers at 120 m, then flies a line of 400 m": it flies that at 120 m.
    """
    is_open = mission.altitude_m.provenance is not Provenance.EXPLICIT
    return is_open and (stays_where_it_is(spec, mission) or begins_where_it_is(spec, mission))


def left_by(spec: ScenarioSpec, mission: UavMission) -> Event | None:
    """Return the event that may end a mission, None when only its own end does."""
    after = mission_after(spec, mission)
    if after is not None:
        return begun_by(spec, after)
    return next(iter(ending_landings(spec, mission.uav)), None)


def cut_by(spec: ScenarioSpec, mission: UavMission) -> Event | None:
    """Return the event that may end a mission, also one whose length is stated.

    "Tracks the van for 90 s; when the bus stops it lands": then it does.
    """
    event = left_by(spec, mission)
    if event is not None or mission_after(spec, mission) is not None:
        return event
    landings = (e for e in spec.events if isinstance(e.action, UavAction) and e.action.lands)
    return next(
        (
            e
            for e in landings
            if e.action is not None
            and getattr(e.action, 'uav', None) == mission.uav
            and e.trigger is not None
            and not _waits_for_missions(spec, e, mission.uav)
        ),
        None,
    )


def ending_landings(spec: ScenarioSpec, uav: str) -> tuple[Event, ...]:
    """Return the landings told of an event that a UAV awaits: nobody states when that is.

    "Hovers until the bus stops": the event stands in the place of the duration. A landing that
    waits for the end of the missions themselves ends nothing.
    """
    landings = _awaited(spec, uav, ('land', 'return_home'))
    return tuple(
        e for e in landings if e.trigger is not None and not _waits_for_missions(spec, e, uav)
    )


def _waits_for_missions(spec: ScenarioSpec, event: Event, uav: str) -> bool:
    """Tell whether an event, or one that it waits for, comes after the missions of a UAV."""
    seen: set[str] = set()
    while event.id not in seen:
        seen.add(event.id)
        trigger = event.trigger
        if isinstance(trigger, MissionDoneTrigger):
            return trigger.uav == uav
        if isinstance(trigger, EventDoneTrigger):
            event = next(e for e in spec.events if e.id == trigger.event)
    return False


def lasts_until_event(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether only an event ends a phase, or a patrol: nobody states how long it is."""
    return _has_no_length(mission) and left_by(spec, mission) is not None


def patrols_until_told(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a route is flown again until its UAV has reported what it came near or saw."""
    routed = mission.mode is MissionMode.NAVIGATE and mission_after(spec, mission) is None
    reports = (e for e in awaits_reports(spec, mission.uav) if mission.uav in bodies_of_cause(e))
    return routed and _has_no_length(mission) and any(True for _ in reports)


def awaits_reports(spec: ScenarioSpec, uav: str) -> tuple[Event, ...]:
    """Return the reports that a UAV is to send of what it watches before it lands.

    "Patrols the market and tells the police when a truck comes near": nobody states how long that
    takes, and a UAV that has landed sees nothing.
    """
    last = next((m for m in reversed(spec.missions) if m.uav == uav), None)
    if last is None or not _has_no_length(last):
        return ()
    return tuple(
        e
        for e in spec.events
        if isinstance(e.action, SendMessage)
        and e.action.sender == uav
        and isinstance(e.trigger, (*_OF_STATES, BehaviorDoneTrigger))
        and not (e.trigger.on == 'distance_above' and _gets_far_itself(spec, e, last))
    )


def _gets_far_itself(spec: ScenarioSpec, event: Event, last: UavMission) -> bool:
    """Tell whether a UAV may get far from somebody by its own flight, or by going home.

    One that hovers stays where it is: whoever moves gets far from it.
    """
    others = bodies_of_cause(event) - {last.uav}
    agents = [a for a in spec.agents if a.id in others]
    leaves = any(not stands(a) and not parks(spec, a) for a in agents)
    hovers = last.mode is MissionMode.HOVER
    return last.uav in bodies_of_cause(event) and not (hovers and leaves)


def _has_no_length(mission: UavMission) -> bool:
    """Tell whether nobody states how long a mission is."""
    duration = mission.duration_s
    return mission.turns is None and (duration is None or _is_default(duration))


def awaits_climbs(spec: ScenarioSpec, uav: str) -> tuple[Event, ...]:
    """Return the climbs that a UAV awaits before it lands: nobody states when that is."""
    return tuple(e for e in _awaited(spec, uav, ('ascend',)) if not climbs_last(e))


def returns_home(spec: ScenarioSpec, uav: str) -> tuple[Event, ...]:
    """Return the events that send a UAV back to where it started."""
    return tuple(
        e
        for e in spec.events
        if isinstance(e.action, UavAction) and (e.action.do, e.action.uav) == ('return_home', uav)
    )


def _awaited(spec: ScenarioSpec, uav: str, do: tuple[str, ...]) -> tuple[Event, ...]:
    """Return the events of a UAV's actions, none where its last mission has a stated length."""
    last = next((m for m in reversed(spec.missions) if m.uav == uav), None)
    if last is None or (last.duration_s is not None and not _is_default(last.duration_s)):
        return ()
    return tuple(
        e
        for e in spec.events
        if isinstance(e.action, UavAction) and e.action.do in do and e.action.uav == uav
    )


def _is_default(duration: Parameter) -> bool:
    return duration.provenance is Provenance.DEFAULT
