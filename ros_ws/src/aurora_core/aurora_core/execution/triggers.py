# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the trigger of an event holds at a tick, on recomputed quantities only."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from aurora_core.execution.observe import Observation
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.quantities.actions import APART_M, CLIMBED_M
from aurora_core.quantities.doing import DoingWatch
from aurora_core.quantities.motion import battery
from aurora_core.quantities.state_triggers import arrives_on_sidewalk, needs_change
from aurora_core.spec.scenario import (
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
    SpeedTrigger,
    TimeTrigger,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import Place


@dataclass(frozen=True, slots=True, kw_only=True)
class BatteryRule:
    """What the level of a battery is counted by.

    Attributes:
        endurance_s: For how long a full one lasts in the air.
        touchdown_m: Height below which a UAV that reports landed is down.
    """

    endurance_s: float
    touchdown_m: float


@dataclass(slots=True)
class Progress:
    """What has happened so far, for triggers that follow other events."""

    arrival_m: float  # an agent this close to a place is there
    crosswalk_m: float | None = None  # a person this close to the outline of a crosswalk
    endurance_s: float = inf  # of a full battery
    airborne_ticks: dict[str, int] = field(default_factory=dict)  # by UAV id
    begun_tick: dict[str, int] = field(default_factory=dict)  # its action has set in
    done_tick: dict[str, int] = field(default_factory=dict)
    received: set[tuple[str, str]] = field(default_factory=set)  # (receiver, sender)
    missions_done: set[str] = field(default_factory=set)  # UAV ids
    was_false: set[str] = field(default_factory=set)  # event ids
    pairs: dict[str, float] = field(default_factory=dict)  # event -> headway, ttc at the tick (s)
    doing: dict[str, DoingWatch] = field(default_factory=dict)  # by event
    rests_s: dict[str, float] = field(default_factory=dict)  # by event, after a stop
    looking: set[str] = field(default_factory=set)  # UAVs between their ascent and way home


def holds(
    event: Event, tick: int, dt_s: float, observation: Observation, progress: Progress
) -> bool:
    """Return whether the event's trigger is true at `tick`; an event without one starts at 0."""
    trigger = event.trigger
    if trigger is None:
        return True
    if isinstance(trigger, TimeTrigger):
        return tick * dt_s >= trigger.at_s.value - 1e-9
    if isinstance(trigger, EventDoneTrigger):
        begun = trigger.on == 'event_begun'
        done = (progress.begun_tick if begun else progress.done_tick).get(trigger.event)
        wait = 0.0 if trigger.after_s is None else trigger.after_s.value
        wait = max(wait, progress.rests_s.get(event.id, 0.0))
        return done is not None and (tick - done) * dt_s >= wait - 1e-9
    if isinstance(trigger, MissionDoneTrigger):
        return trigger.uav in progress.missions_done
    if isinstance(trigger, MessageTrigger):
        return any(
            receiver == trigger.by and trigger.sender in (None, sender)
            for receiver, sender in progress.received
        )
    if isinstance(trigger, BehaviorDoneTrigger):
        watch = progress.doing.get(event.id)
        return watch is not None and watch.step(observation.speed_mps(trigger.who))
    if isinstance(trigger, BatteryTrigger):
        flown = float(progress.airborne_ticks.get(trigger.uav, 0))
        return battery(flown, dt_s, progress.endurance_s) < trigger.value.value
    if isinstance(trigger, HeadwayTrigger):
        return progress.pairs.get(event.id, inf) <= trigger.value_s.value
    now = _state_holds(trigger, observation, progress)
    # Only who looks can lose sight.
    looks = not isinstance(trigger, VisibilityTrigger) or _looks(trigger, observation, progress)
    if not now and looks:
        progress.was_false.add(event.id)
    # Getting far, getting slow and losing sight are changes: what held from the start is none.
    return now and (not needs_change(trigger) or event.id in progress.was_false)


def _state_holds(
    trigger: DistanceTrigger | AltitudeTrigger | SpeedTrigger | ArrivalTrigger | VisibilityTrigger,
    observation: Observation,
    progress: Progress,
) -> bool:
    if isinstance(trigger, DistanceTrigger):
        distance = observation.distance_m(trigger.a, trigger.b)
        if distance is None:
            return False
        if trigger.on == 'distance_below':
            return distance <= trigger.value_m.value
        return distance >= trigger.value_m.value + APART_M
    if isinstance(trigger, AltitudeTrigger):
        point = observation.position(trigger.uav)
        return point is not None and point[2] >= trigger.value_m.value - CLIMBED_M
    if isinstance(trigger, SpeedTrigger):
        speed = observation.speed_mps(trigger.who)
        if speed is None:
            return False
        if trigger.on == 'speed_below':
            return speed <= trigger.value_mps.value
        return speed >= trigger.value_mps.value
    if isinstance(trigger, ArrivalTrigger):
        if arrives_on_sidewalk(trigger):
            return observation.is_on(SurfaceKind.SIDEWALK, trigger.who)
        near_m, crosswalk = progress.crosswalk_m, trigger.place == Place.CROSSWALK
        if near_m is not None and crosswalk and observation.walks(trigger.who):
            return observation.crosswalk_m(trigger.who) <= near_m
        distance = observation.distance_m(trigger.who, trigger.place, on_road=True)
        return distance is not None and distance <= progress.arrival_m
    if not _looks(trigger, observation, progress):
        return False
    seen = observation.visible(trigger.observer, trigger.target)
    return seen if trigger.on == 'visible' else not seen


def _looks(trigger: VisibilityTrigger, observation: Observation, progress: Progress) -> bool:
    """Tell whether an observer looks out: on the ground all along, a UAV once it is up."""
    return trigger.observer in progress.looking or not observation.flies(trigger.observer)
