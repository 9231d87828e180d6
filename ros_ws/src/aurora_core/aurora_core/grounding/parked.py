# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parked vehicles: where they stand beside their lane, and persons who would walk into them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from aurora_core.grounding.kerb import Pose, parked_pose
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.spec.parking import parks
from aurora_core.spec.scenario import ScenarioSpec

# The way of a person is looked at in such steps (m).
_STEP_M = 0.5


def parked_boxes(
    spec: ScenarioSpec,
    seats: Iterable[SeatedAgent],
    network: RoadNetwork,
    types: Mapping[str, AgentTypeRecord],
) -> Iterator[tuple[Pose, AgentTypeRecord]]:
    """Yield pose (m, unit heading) and size of every parked vehicle."""
    for seat in seats:
        if parks(spec, seat.agent):
            record = types[seat.agent.type.value]
            lane = network.lane(seat.lane_id)
            yield parked_pose(seat.path.position_at(seat.arc_m), lane, record), record


def walks_into(
    parked: Iterable[tuple[Pose, AgentTypeRecord]],
    walker: SeatedPerson,
    way_m: float,
    body_m: float,
) -> bool:
    """Tell whether a person stands in, or walks through, a parked vehicle.

    Args:
        parked: Poses and sizes of the vehicles.
        walker: The person.
        way_m: So far its way is looked at; it is a step at least.
        body_m: Room round the middle of a person.
    """
    end_m = min(walker.path.length_m, walker.arc_m + max(way_m, _STEP_M))
    steps = range(int((end_m - walker.arc_m) / _STEP_M) + 1)
    poses = [walker.path.position_at(walker.arc_m + k * _STEP_M) for k in steps]
    left_m = walker.lateral_m
    points = [(x - left_m * hy, y + left_m * hx) for x, y, hx, hy in poses]
    for (x, y, hx, hy), record in parked:
        along_m, aside_m = 0.5 * record.length_m + body_m, 0.5 * record.width_m + body_m
        for px, py in points:
            along = abs((px - x) * hx + (py - y) * hy) < along_m
            if along and abs((py - y) * hx - (px - x) * hy) < aside_m:
                return True
    return False
