# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a scenario may take: an upper bound from slow, but possible, speeds.

Runs end when everything is done, so a generous bound costs nothing; it only caps a run that does
not get there.
"""

from __future__ import annotations

from math import ceil

from aurora_core.grounding.places import has_point
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.settings import FlightDefaults
from aurora_core.quantities.actions import climbed_mps
from aurora_core.spec.flight_order import begun_by
from aurora_core.spec.own_events import own_events
from aurora_core.spec.scenario import (
    ArrivalTrigger,
    BatteryTrigger,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    UavAction,
    UavMission,
)
from aurora_core.spec.vocabulary import MissionMode, Pattern

# Slow speeds and times used for the bound: the most that a plan counts on, and the share of the
# rates that the multirotor is flown at.
_CLIMB_MPS = 1.5
_SINK_MPS = 0.8
_CLIMB_SHARE = 0.375
_SINK_SHARE = 0.32
_CORNER_S = 8.0
_TRANSIT_S = 40.0
_EVENT_S = 45.0
# Where nobody flies: so much longer for each event that a red light may hold up.
_HELD_UP_S = 60.0
_SLOWEST_MPS = 0.2
# Between two places of a map, with its bends (m), and what a vehicle needs for it (s).
_ACROSS_M = 2000.0
_DRIVES_THERE_S = 240.0
_BY_TRAFFIC = (ArrivalTrigger, DistanceTrigger)


def horizon_s(spec: ScenarioSpec, limits: Limits, flight: FlightDefaults | None = None) -> float:
    """Return the stated duration, else an upper bound of the time needed (whole seconds).

    Args:
        spec: What is asked for.
        limits: Limits in force.
        flight: Rates at which the multirotor is flown, within what it was measured to do.
    """
    if spec.world.duration_s is not None:
        return spec.world.duration_s.value
    up_and_down = _seconds_per_m(flight)
    by_uav: dict[str, float] = {}
    for mission in spec.missions:
        first = mission.uav not in by_uav
        need = by_uav.get(mission.uav, 0.0) + _mission_s(mission)
        if first:
            need += mission.altitude_m.value * up_and_down + _TRANSIT_S
        by_uav[mission.uav] = need
    latest = max(
        (e.trigger.at_s.value for e in spec.events if isinstance(e.trigger, TimeTrigger)),
        default=0.0,
    )
    latest += max(
        (
            (1.0 - e.trigger.value.value) * limits.uav_endurance_s
            for e in spec.events
            if isinstance(e.trigger, BatteryTrigger)
        ),
        default=0.0,
    )
    # Who waits for an event may have to wait for all that the others do.
    waits = any(begun_by(spec, m) is not None for m in spec.missions)
    flown_s = sum(by_uav.values()) if waits else max(by_uav.values(), default=0.0)
    events = (*spec.events, *own_events(spec))
    need = flown_s + latest + sum(_event_s(spec, e, up_and_down) for e in events)
    lasting = (sum(b.duration_s.value for b in a.behaviors if b.duration_s) for a in spec.agents)
    need += max(lasting, default=0.0)
    goes = any(has_point(b.target) for agent in spec.agents for b in agent.behaviors)
    need = max(need, up_and_down + _TRANSIT_S + _DRIVES_THERE_S) if goes else need
    need = max(limits.horizon_inferred_min_s, ceil(need)) + patience_s(spec)
    return float(min(limits.duration_max_s, need))


def patience_s(spec: ScenarioSpec) -> float:
    """Return how long before its inferred horizon a run without UAVs may end, once all is done."""
    if spec.world.duration_s is not None or spec.missions:
        return 0.0
    return _HELD_UP_S * sum(isinstance(e.trigger, _BY_TRAFFIC) for e in spec.events)


def _seconds_per_m(flight: FlightDefaults | None) -> float:
    """Return the time for one metre up and down again."""
    if flight is None:
        return 1.0 / _CLIMB_MPS + 1.0 / _SINK_MPS
    climb_mps = min(_CLIMB_MPS, _CLIMB_SHARE * flight.climb_mps)
    sink_mps = min(_SINK_MPS, _SINK_SHARE * flight.descent_mps)
    return 1.0 / climb_mps + 1.0 / sink_mps


def _event_s(spec: ScenarioSpec, event: Event, up_and_down: float) -> float:
    """Return the time for an event to come about, with its stated delays and its message."""
    need = _EVENT_S + event.waits_s
    if isinstance(event.trigger, EventDoneTrigger) and event.trigger.after_s is not None:
        need += event.trigger.after_s.value
    if isinstance(event.action, UavAction) and event.action.altitude_m is not None:
        asked, per_m = event.action.vertical_mps, up_and_down
        if asked is not None and asked.value > 0.0:
            per_m = max(per_m, 1.0 / climbed_mps(asked))
        need += event.action.altitude_m.value * per_m
    if isinstance(event.action, SendMessage):
        pair = (event.action.sender, event.action.receiver)
        for link in spec.links:
            if (link.sender, link.receiver) == pair:
                tries = link.retransmissions.value * link.retransmission_interval_s.value
                need += link.latency_s.value + tries
    return need


def _mission_s(mission: UavMission) -> float:
    if mission.mode is not MissionMode.NAVIGATE:
        assert mission.duration_s is not None
        return _TRANSIT_S + mission.duration_s.value
    assert mission.speed_mps is not None
    lap_s = 1.5 * _route_m(mission) / max(_SLOWEST_MPS, mission.speed_mps.value)
    asked_s = 0.0 if mission.duration_s is None else mission.duration_s.value
    return _TRANSIT_S + max(asked_s, lap_s + 4.0 * _CORNER_S)


def _route_m(mission: UavMission) -> float:
    if mission.start is not None:
        return _ACROSS_M
    length, width = (p.value for p in mission.size_m) if mission.size_m else (100.0, 60.0)
    radius = mission.radius_m.value if mission.radius_m is not None else 30.0
    if mission.pattern is Pattern.RECTANGLE:
        return 2.0 * (length + width)
    if mission.pattern is Pattern.LINE:
        return length
    if mission.pattern is Pattern.LAWNMOWER:
        return length * (width / 20.0 + 2.0) + width
    turns = mission.turns.value if mission.turns is not None else 1.0
    return 6.3 * radius * max(1.0, turns)
