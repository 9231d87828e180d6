# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a stated speed can show: far from junctions, and before one has caught up.

Who would have caught up too soon waits until the slower one ahead has drawn away: nobody says when
they start.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from aurora_core.grounding.entries import stops_for
from aurora_core.grounding.pace import PACED, in_emergency, own_speed_mps, stated_times_s
from aurora_core.grounding.sites import SeatedAgent, Site
from aurora_core.grounding.way_limits import limits_mps, open_way_m
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.quantities.actions import SPEED_ACTIONS
from aurora_core.quantities.free_road import caught_up_m
from aurora_core.spec.doing import dated_s
from aurora_core.spec.scenario import AgentAction, GroundAgent, ScenarioSpec
from aurora_core.spec.slower import slower_mps

# A stated speed shows well when it is held for so long (s), within so much time (s).
_SHOWS_WELL_S = 8.0
LOOKED_S = 40.0
_LOOKED_TOLD_S = 15.0

# An emergency run shows on so much of its way (m), by so much more than it has to (m/s).
_EMERGENCY_WAY_M = 150.0
_OVER_MPS = 1.0

# A stated speed has shown when it was held for so long (s); what a site is worth where not.
_SHOWN_S = 2.0
_NOT_SHOWN = 0.1


def room_for(speed_mps: float, spec: ScenarioSpec, site: Site, tolerances: Tolerances) -> float:
    """Return what a site is worth for a stated speed to show, in [0, 1]: far from junctions.

    Whom an event tells something else shows it before that, and comes in with it: where it cannot,
    the site is worth little. Else half of its worth depends on it.

    Args:
        speed_mps: The speed.
        spec: The request.
        site: Where its vehicles stand.
        tolerances: In force.
    """
    told = [
        e
        for e in spec.events
        if isinstance(e.action, AgentAction)
        and e.action.do in SPEED_ACTIONS | {'yield'}
        and (seat := site.seat(e.action.agent)) is not None
        and own_speed_mps(seat.agent) is not None
    ]
    settle_m = speed_mps * speed_mps / (2.0 * tolerances.route_acceleration_mps2)
    low_m = site.origin_arc_m + (0.0 if told else settle_m)
    times_s = stated_times_s(spec)
    looked_s = min((times_s.get(e.id, _LOOKED_TOLD_S) for e in told), default=LOOKED_S)
    open_m = open_way_m(
        site.origin_path, low_m, low_m + looked_s * speed_mps, tolerances.free_road_m
    )
    if told and open_m < _SHOWN_S * speed_mps:
        return _NOT_SHOWN
    return 0.5 + 0.5 * min(1.0, open_m / (_SHOWS_WELL_S * speed_mps))


def all_show(
    spec: ScenarioSpec, site: Site, network: RoadNetwork, tolerances: Tolerances
) -> float:
    """Return what a site is worth for stated speeds, once all have their places, in [0, 1].

    Args:
        spec: The request.
        site: Where vehicles and persons stand.
        network: Its roads.
        tolerances: In force.
    """
    return _before_stopping(spec, site, network, tolerances) * _on_other_ways(site, tolerances)


def _before_stopping(
    spec: ScenarioSpec, site: Site, network: RoadNetwork, tolerances: Tolerances
) -> float:
    """Return what a site is worth for those who stop where somebody crosses, in [0, 1].

    A crosswalk is at a junction, so their way to it has to begin far enough from both.
    """
    kerbs = [
        walker.path.line.at(network.lane(walker.path.lane_id).arc_length_m)[:2]
        for walker in site.walkers
        if walker.path.crossing_id is not None
    ]
    for seat in site.seated:
        speed_mps = own_speed_mps(seat.agent)
        if not speed_mps or not stops_for(spec, seat.agent):
            continue
        for kerb in kerbs:  # it comes in with its speed
            high_m, _ = seat.path.line.project(*kerb)
            open_m = open_way_m(seat.path, seat.arc_m, high_m, tolerances.free_road_m)
            if high_m > seat.arc_m and open_m < _SHOWN_S * speed_mps:
                return _NOT_SHOWN
    return 1.0


def _on_other_ways(site: Site, tolerances: Tolerances) -> float:
    """Return what a site is worth for the stated speeds of those on other ways, in [0, 1]."""
    worth = 1.0
    for seat in site.others:
        speed_mps = own_speed_mps(seat.agent)
        if speed_mps:
            low_m = seat.arc_m + speed_mps * speed_mps / (2.0 * tolerances.route_acceleration_mps2)
            high_m = low_m + _LOOKED_TOLD_S * speed_mps
            open_m = open_way_m(seat.path, low_m, high_m, tolerances.free_road_m)
            worth = min(worth, max(_NOT_SHOWN, min(1.0, open_m / (_SHOWN_S * speed_mps))))
    return worth


def shows_before(site: Site, network: RoadNetwork, tolerances: Tolerances) -> float:
    """Return which share of the time that a speed needs to show each one has before, in [0, 1].

    Args:
        site: Where the vehicles of a request stand.
        network: Its roads.
        tolerances: In force.
    """
    return min(
        (_share_before(chase, tolerances) for chase in _chases(site, network, tolerances)),
        default=1.0,
    )


def _share_before(chase: _Chase, tolerances: Tolerances) -> float:
    speed_mps, rear = chase.speed_mps, chase.rear
    settle_m = speed_mps * speed_mps / (2.0 * tolerances.route_acceleration_mps2)
    way_m = speed_mps * (chase.gap_m - chase.closed_m) / (speed_mps - chase.slow_mps)
    open_m = open_way_m(
        rear.path, rear.arc_m + settle_m, rear.arc_m + way_m, tolerances.free_road_m
    )
    return min(1.0, open_m / (_SHOWN_S * speed_mps))


def head_starts(
    spec: ScenarioSpec,
    site: Site,
    types: Mapping[str, AgentTypeRecord],
    network: RoadNetwork,
    tolerances: Tolerances,
) -> tuple[tuple[str, str, float], ...]:
    """Return who waits until which slower one has got how far away (reference points, m).

    Args:
        spec: The request.
        site: Where its vehicles stand.
        types: Agent sizes and dynamics.
        network: With the speed limits.
        tolerances: In force.
    """
    found = []
    for chase in _chases(site, network, tolerances):
        rear, front = chase.rear.agent, chase.front.agent
        if chase.slow_mps <= 0.0 or _are_tied(spec, rear, front):
            continue
        speed_mps, slow_mps = chase.speed_mps, chase.slow_mps
        gains, lags = types[rear.type.value].accel_mps2, types[front.type.value].accel_mps2
        reached_m = speed_mps * speed_mps / (2.0 * gains) - slow_mps * speed_mps / gains
        shown_m = _SHOWN_S * (speed_mps - slow_mps)
        needed_m = chase.closed_m + max(0.0, reached_m) + shown_m
        lag_m = slow_mps * slow_mps / (2.0 * lags)
        bumper_m = chase.gap_m - types[front.type.value].length_m
        if bumper_m < needed_m + lag_m:
            beyond_m = max(needed_m, bumper_m + lag_m) + types[front.type.value].length_m
            found.append((rear.id, front.id, beyond_m))
    return tuple(found)


def _are_tied(spec: ScenarioSpec, rear: GroundAgent, front: GroundAgent) -> bool:
    """Tell whether it is said how two follow each other, or when one of them does something."""
    pair = {rear.id, front.id}
    follows = any(b.kind in PACED and b.target == front.id for b in rear.behaviors)
    kept = any(
        p.keeps_distance and p.of in pair for agent in (rear, front) for p in agent.placements
    )
    bound = any(pair <= set(one.of) for one in spec.conditions)
    timed = any(
        dated_s(spec, e) is not None
        and isinstance(e.action, AgentAction)
        and e.action.agent in pair
        for e in spec.events
    )
    return follows or kept or bound or timed


@dataclass(frozen=True, slots=True, kw_only=True)
class _Chase:
    """Somebody who comes up behind a slower one.

    Attributes:
        rear: Who comes up.
        front: The slower one.
        speed_mps: How fast the one drives ...
        slow_mps: ... and the other.
        gap_m: From one reference point to the other.
        closed_m: Nearer than this it has caught up.
    """

    rear: SeatedAgent
    front: SeatedAgent
    speed_mps: float
    slow_mps: float
    gap_m: float
    closed_m: float


def _share_a_lane(rear: SeatedAgent, front: SeatedAgent) -> bool:
    same = front.member.lane_shift == rear.member.lane_shift
    same = same and front.member.bike_lane == rear.member.bike_lane
    return same and not front.member.parked and front.path.edge_ids == rear.path.edge_ids


def _wanted_mps(seat: SeatedAgent, network: RoadNetwork, tolerances: Tolerances) -> float | None:
    """Return the speed that somebody has to show, None where there is none.

    An emergency run without one has to be faster than its street allows.
    """
    stated_mps = own_speed_mps(seat.agent)
    if stated_mps is not None or not in_emergency(seat.agent):
        return stated_mps
    limits = limits_mps(network, seat.path, seat.arc_m, _EMERGENCY_WAY_M)
    return max(limits, default=0.0) + tolerances.over_limit_mps + _OVER_MPS


def _chases(site: Site, network: RoadNetwork, tolerances: Tolerances) -> Iterator[_Chase]:
    """Yield who comes up behind whom: vehicles on one way, in one lane."""
    for rear in site.seated:
        speed_mps = _wanted_mps(rear, network, tolerances)
        if speed_mps is None:
            continue
        for front in site.seated:
            slow_mps = slower_mps(front.agent, speed_mps)
            gap_m = front.arc_m - rear.arc_m
            if slow_mps is None or gap_m <= 0.0 or not _share_a_lane(rear, front):
                continue
            closed_m = caught_up_m(
                speed_mps, slow_mps, tolerances.tailgate_time_gap_s, tolerances.brake_mps2
            )
            yield _Chase(
                rear=rear,
                front=front,
                speed_mps=speed_mps,
                slow_mps=slow_mps,
                gap_m=gap_m,
                closed_m=closed_m,
            )
