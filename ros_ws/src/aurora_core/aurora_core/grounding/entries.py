# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who drives already at t = 0: a stated speed has to show before something else is asked.

"Coming in at 10 m/s" from rest, it would be told to slow down before it ever drove so fast. Nobody
states the speed at t = 0, so it is the stated one wherever there is room ahead for it.
"""

from __future__ import annotations

from collections.abc import Mapping

from aurora_core.grounding.going import crosses
from aurora_core.grounding.pace import PACED, own_speed_mps, stated_speed_mps
from aurora_core.grounding.sites import SeatedAgent
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.settings import SpeedSettings
from aurora_core.quantities.actions import SPEED_ACTIONS
from aurora_core.spec.own_events import own_events
from aurora_core.spec.scenario import AgentAction, GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Relation

# Room left where who is ahead stands and one brakes as usual (m).
_SPARE_M = 8.0

_OTHER_SPEED = SPEED_ACTIONS | {'yield'}


def entry_speeds_mps(
    spec: ScenarioSpec,
    seats: Mapping[str, SeatedAgent],
    types: Mapping[str, AgentTypeRecord],
    network: RoadNetwork,
    speeds: SpeedSettings,
) -> dict[str, float]:
    """Return the speeds at t = 0 of those who do not start from rest, by agent.

    Args:
        spec: The request.
        seats: Places of the vehicles by agent.
        types: Agent sizes and dynamics.
        network: With the speed limits.
        speeds: What is open of speeds.
    """
    found: dict[str, float] = {}
    moving = {a.id for a in spec.agents if a.id in seats and _comes_in(spec, a)}
    # Who follows somebody that drives already would be left behind from rest.
    for agent in spec.agents:
        if any(b.kind in PACED and b.target in moving for b in agent.behaviors):
            moving |= {agent.id} & seats.keys()
    for seat in sorted(seats.values(), key=lambda s: -s.arc_m):
        if seat.agent.id not in moving:
            continue
        record, lane = types[seat.agent.type.value], network.lane(seat.lane_id)
        led_mps = [found.get(b.target or '', 0.0) for b in seat.agent.behaviors if b.kind in PACED]
        speed_mps = min(
            stated_speed_mps(spec, seat.agent, speeds) or max(led_mps, default=0.0),
            lane.speed_limit_mps,
            record.desired_speed_mps or lane.speed_limit_mps,
        )
        way_m = speed_mps * speed_mps / (2.0 * record.decel_mps2) + _SPARE_M
        if all(
            found.get(other.agent.id, 0.0) >= speed_mps
            or not _is_within(seat, other, way_m, types)
            for other in seats.values()
        ):
            found[seat.agent.id] = speed_mps
    return found


def _comes_in(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a vehicle with a stated speed is to drive otherwise, or to stop, later on."""
    if own_speed_mps(agent) is None:
        return False
    told = any(
        isinstance(e.action, AgentAction)
        and e.action.agent == agent.id
        and e.action.do in _OTHER_SPEED
        for e in (*spec.events, *own_events(spec))
    )
    return told or stops_for(spec, agent) or any(map(_is_before, agent.placements))


def stops_for(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether a vehicle is to stop where somebody crosses: the crosswalk is soon there."""
    persons = (a for a in spec.agents if a.type is AgentType.PEDESTRIAN)
    stops = any(b.kind is BehaviorKind.STOP and b.target is None for b in agent.behaviors)
    return stops and any(crosses(spec, person) for person in persons)


def _is_before(placement: Placement) -> bool:
    return placement.relation is Relation.BEFORE


def _is_within(
    seat: SeatedAgent, other: SeatedAgent, way_m: float, types: Mapping[str, AgentTypeRecord]
) -> bool:
    """Tell whether another vehicle stands ahead on the way, nearer than that (bumpers, m)."""
    if other is seat or other.member.parked:
        return False
    x, y, _, _ = other.path.position_at(other.arc_m)
    at_m, aside_m = seat.path.line.project(x, y, near_s=seat.arc_m + 50.0, window_m=50.0)
    half_m = (types[seat.agent.type.value].length_m + types[other.agent.type.value].length_m) / 2.0
    return 0.0 < at_m - seat.arc_m <= way_m + half_m and abs(aside_m) <= 2.0
