# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where the predicates of triggers hold that look at states alone: near, fast, high, in sight."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.world import SurfaceKind
from aurora_core.quantities import motion
from aurora_core.quantities.actions import APART_M, CLIMBED_M, ActionRules
from aurora_core.quantities.headway import MEASURES, pair_series
from aurora_core.quantities.ledger import LinkModel
from aurora_core.quantities.phases import FlightPhases
from aurora_core.quantities.sight import sight_series
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    ArrivalTrigger,
    BatteryTrigger,
    DistanceTrigger,
    HeadwayTrigger,
    SpeedTrigger,
    TimeTrigger,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import Place

StateTrigger = (
    DistanceTrigger
    | HeadwayTrigger
    | TimeTrigger
    | AltitudeTrigger
    | VisibilityTrigger
    | SpeedTrigger
    | ArrivalTrigger
    | BatteryTrigger
)

BoolArray = npt.NDArray[np.bool_]

# Triggers that ask for a change.
_CHANGES = frozenset({'distance_above', 'speed_below', 'occluded'})


def needs_change(trigger: StateTrigger) -> bool:
    """Tell whether the predicate of a trigger must have been false at an earlier tick."""
    return trigger.on in _CHANGES or arrives_on_sidewalk(trigger)


def arrives_on_sidewalk(trigger: StateTrigger) -> bool:
    """Tell whether a trigger waits for somebody to step onto a sidewalk: any, it has no point."""
    return isinstance(trigger, ArrivalTrigger) and trigger.place == Place.SIDEWALK


@dataclass(frozen=True, slots=True, kw_only=True)
class EventRules:
    """What the moments of events are measured with.

    Attributes:
        brake_mps2: Loss of speed that counts as braking.
        arrival_m: Distance from a place at which an agent is there.
        crosswalk_m: Distance from the outline of a crosswalk at which a person is there; None: as
            of any other place.
        onset_mps2: Change of speed with which slowing down or speeding up begins.
        actions: When the actions of ground agents are complete; None where no event is judged.
        flights: Phases of each UAV's flight.
        captured: Gives the tick at which a UAV has captured its first mission, or the one of an
            id; None if never.
        links: Links of the specification.
        touchdown_m: Height below which a UAV that reports landed is down.
    """

    brake_mps2: float
    onset_mps2: float
    arrival_m: float
    actions: ActionRules | None
    flights: dict[str, FlightPhases]
    captured: Callable[[str, str | None], int | None]
    links: tuple[LinkModel, ...]
    touchdown_m: float = 0.0
    crosswalk_m: float | None = None


def trigger_series(
    view: RunView,
    trigger: StateTrigger,
    rules: EventRules,
) -> BoolArray | None:
    """Return where the predicate of a state trigger holds, (T,); None for an unknown place."""
    match trigger:
        case DistanceTrigger():
            apart = motion.distance(view, trigger.a, trigger.b)
            near = trigger.on == 'distance_below'
            limit_m = trigger.value_m.value
            mask = apart <= limit_m if near else apart >= limit_m + APART_M
            return mask & view.present(trigger.a) & view.present(trigger.b)
        case HeadwayTrigger():
            seconds = pair_series(view, MEASURES[trigger.on], trigger.a, trigger.b)
            return seconds <= trigger.value_s.value
        case TimeTrigger():
            first = whole_ticks(trigger.at_s.value, view.dt_s)
            return np.arange(view.ticks) >= first
        case AltitudeTrigger():
            reached_m = trigger.value_m.value - CLIMBED_M
            return motion.altitude(view, view.body(trigger.uav)) >= reached_m
        case VisibilityTrigger():
            sight = sight_series(view, trigger.observer, trigger.target).visible
            mask = sight if trigger.on == 'visible' else ~sight
            if not view.body(trigger.observer).is_uav:
                return mask
            flight = rules.flights.get(trigger.observer)
            ready = None if flight is None else flight.ascent_end_tick
            if ready is None:
                return np.zeros(view.ticks, dtype=np.bool_)
            # Before the ascent has ended neither "visible" nor "occluded" can have been seen, and
            # on its way home a UAV has stopped looking.
            counted = np.arange(view.ticks) >= ready
            if flight is not None and flight.landing_tick is not None:
                counted &= np.arange(view.ticks) < flight.landing_tick
            return mask & counted
        case SpeedTrigger():
            values = motion.speed(view, view.body(trigger.who))
            below = trigger.on == 'speed_below'
            limit_mps = trigger.value_mps.value
            mask = values <= limit_mps if below else values >= limit_mps
            return mask & view.present(trigger.who)
        case BatteryTrigger():
            left = motion.battery_series(view, view.body(trigger.uav), rules.touchdown_m)
            return left < trigger.value.value
        case ArrivalTrigger() if arrives_on_sidewalk(trigger):
            points = view.reference(trigger.who)[:, :2]
            on = view.geometry.surfaces(SurfaceKind.SIDEWALK).contains(points)
            return on & view.present(trigger.who)
        case ArrivalTrigger():
            if view.geometry.place_point(trigger.place) is None:
                return None
            walks = view.body(trigger.who).entry.is_person
            if rules.crosswalk_m is not None and walks and trigger.place == Place.CROSSWALK:
                points = view.reference(trigger.who)[:, :2]
                apart = view.geometry.crosswalk_distance(points)
                return (apart <= rules.crosswalk_m) & view.present(trigger.who)
            apart = motion.distance(view, trigger.who, trigger.place, on_road=True)
            return (apart <= rules.arrival_m) & view.present(trigger.who)
