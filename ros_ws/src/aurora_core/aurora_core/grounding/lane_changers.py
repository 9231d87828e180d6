# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles that are to change lane: who they are, and what that asks of their streets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.pace import stated_times_s
from aurora_core.grounding.sites import ANY_CLASS, SeatedAgent, with_another_lane
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.route_path import RouteSegment
from aurora_core.quantities.lane_changes import ROOM_S, ids_beside
from aurora_core.spec.own_events import keeps_to_lanes, overtakings, own_events
from aurora_core.spec.parking import parks
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    Event,
    GroundAgent,
    ScenarioSpec,
    SpeedTrigger,
)
from aurora_core.spec.vocabulary import LaneSide

# Share of a lane's length that its ends are apart where it is straight.
_STRAIGHT = 0.995

# From rest one gains so much (m/s^2), and one is where one is then to so much (m).
_GAINS_MPS2 = 2.6
_UNSURE_M = 8.0

# Who is told to stop or to slow down is slow by so much later (s).
_SLOW_S = 3.0

# SUMO bit set: no change of lane but the ordered one, which minds the others.
ORDERED_CHANGES = 512


def changes_lane(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a vehicle may be told to change lane, by itself or by an event."""
    passes = any(one == agent.id for one, _ in overtakings(spec))
    return _is_ordered(spec, agent) or (passes and keeps_to_lanes(agent))


def needs_lane(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a vehicle has to change lane: who is parked is passed in one's own."""
    parked = {other.id for other in spec.agents if parks(spec, other)}
    passes = any(one == agent.id and other not in parked for one, other in overtakings(spec))
    return _is_ordered(spec, agent) or (passes and keeps_to_lanes(agent))


def first_side(spec: ScenarioSpec, agent: GroundAgent) -> LaneSide | None:
    """Return to which side a vehicle is to change lane first, None where nobody says."""
    return next((action.side for action in _orders(spec, agent)), None)


def _is_ordered(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    return keeps_to_lanes(agent) and bool(_orders(spec, agent))


def _orders(spec: ScenarioSpec, agent: GroundAgent) -> list[AgentAction]:
    """Return the changes of lane of a vehicle, as listed."""
    return [
        e.action
        for e in (*spec.events, *own_events(spec))
        if isinstance(e.action, AgentAction)
        and e.action.do == 'change_lane'
        and e.action.agent == agent.id
    ]


def with_lane_beside(lanes: Sequence[Lane], side: LaneSide | None) -> list[Lane]:
    """Return the lanes for cars that have another one of these beside them, on a side."""
    found = with_another_lane(lanes)
    ids = {lane.id for lane in found}
    return [lane for lane in found if side is None or ids & set(ids_beside(lane.id, side))]


def share_with_another_lane(
    spec: ScenarioSpec, network: RoadNetwork, seat: SeatedAgent, way_m: float, pace_mps: float
) -> float:
    """Return the share of the way ahead of a vehicle on which it can change lane, in [0, 1].

    Curves do not count: the box of a long vehicle is off the middle of its lane there.

    Args:
        spec: The request.
        network: Road network.
        seat: Where it stands.
        way_m: How much of its way counts, metres.
        pace_mps: How fast it drives; a change of lane takes its way.
    """
    low, high, room_m = seat.arc_m, seat.arc_m + way_m, ROOM_S * pace_mps
    streets = _wide_streets(network, seat, first_side(spec, seat.agent))
    open_m = sum(max(0.0, min(high, s.end_m - room_m) - max(low, s.start_m)) for s in streets)
    return min(1.0, open_m / way_m)


def changes_in_time(
    spec: ScenarioSpec, network: RoadNetwork, seat: SeatedAgent, pace_mps: float
) -> float:
    """Return whether a vehicle is where it can change lane when it is to, in [0, 1].

    At a stated time it has driven so far, as when somebody slows down then for whom it changes
    lane; when a UAV is up it has hardly begun to.

    Args:
        spec: The request.
        network: Road network.
        seat: Where it stands.
        pace_mps: How fast it drives.
    """
    times_s = stated_times_s(spec)
    due: list[tuple[float, LaneSide | None]] = []
    for e in spec.events:
        if not isinstance(e.action, AgentAction):
            continue
        if (e.action.do, e.action.agent) != ('change_lane', seat.agent.id):
            continue
        if e.id in times_s:
            due.append((times_s[e.id], e.action.side))
        if isinstance(e.trigger, AltitudeTrigger):
            due.append((0.0, e.action.side))
        due += [(at_s, e.action.side) for at_s in _slow_by_s(spec, e, times_s)]
    lags_m = pace_mps * pace_mps / (2.0 * _GAINS_MPS2)
    fit = 0
    for at_s, side in due:
        low_m = seat.arc_m + max(0.0, pace_mps * at_s - lags_m)
        high_m = low_m + ROOM_S * pace_mps + _UNSURE_M
        fit += any(
            s.start_m <= max(seat.arc_m, low_m - _UNSURE_M) and high_m <= s.end_m
            for s in _wide_streets(network, seat, side)
        )
    return fit / len(due) if due else 1.0


def _slow_by_s(spec: ScenarioSpec, event: Event, times_s: Mapping[str, float]) -> list[float]:
    """Return when somebody begins to slow down at a stated time, and is slow, as is waited for."""
    trigger = event.trigger
    if not isinstance(trigger, SpeedTrigger) or trigger.on != 'speed_below':
        return []
    begins_s = [
        times_s[e.id]
        for e in spec.events
        if isinstance(e.action, AgentAction)
        and (e.action.agent, e.id in times_s) == (trigger.who, True)
        and e.action.do in ('stop', 'brake', 'slow')
    ]
    return [at_s + later_s for at_s in begins_s for later_s in (0.0, _SLOW_S)]


def _wide_streets(
    network: RoadNetwork, seat: SeatedAgent, side: LaneSide | None
) -> list[RouteSegment]:
    several = {lane.id for lane in with_lane_beside(network.driving_lanes(ANY_CLASS), side)}
    return [
        s
        for s in seat.path.segments
        if s.lane_id in several and not s.is_lane_change and _is_straight(network.lane(s.lane_id))
    ]


def _is_straight(lane: Lane) -> bool:
    (ax, ay), (bx, by) = lane.polyline[0], lane.polyline[-1]
    return norm2(bx - ax, by - ay) >= _STRAIGHT * lane.arc_length_m
