# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a vehicle type can really be put on a network: tried sample by sample."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import libsumo

from aurora_core.errors import GroundSimulatorError
from aurora_core.geometry.frames import sumo_angle_to_heading
from aurora_core.ports.simulators import GroundAgentLoad
from aurora_sumo_bridge.conversions import centre_from_front
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.polyline import distance_m
from aurora_sumo_bridge.sumo_process import SumoProcess
from aurora_sumo_bridge.vehicles import VehiclePlace, place_vehicle

# Read back within this, bends under the box aside.
TOLERANCE_M = 0.1
# Vehicles that are tried together stand so far apart on a lane, more than a length and a gap.
_APART_M = 40.0


@dataclass(frozen=True, slots=True)
class Spot:
    """A place to try: a lane and the arc length of the box's centre on it."""

    lane_id: str
    arc_m: float


def probe_spawns(
    net_path: Path, vtypes_path: Path, type_name: str, spots: Sequence[Spot], dt_s: float
) -> tuple[str, ...]:
    """Insert a type at every spot and say of each what went wrong, '' where it stands there.

    It has to be in the simulation after the insertion and the step behind it, with its centre at
    the spot.

    Args:
        net_path: Network.
        vtypes_path: Additional file with the types.
        type_name: Who is inserted.
        spots: Where, in the order of the lanes.
        dt_s: Step.

    Raises:
        GroundSimulatorError: SUMO does not start, or another client of this process is loaded.
    """
    answers = [''] * len(spots)
    for batch in _batches(spots):
        process = SumoProcess(net_path=net_path, vtypes_path=vtypes_path, dt_s=dt_s, seed=1)
        try:
            network = Network()
            vehicle_class = str(libsumo.vehicletype.getVehicleClass(type_name))
            libsumo.simulationStep()
            placed: dict[int, VehiclePlace] = {}
            for number in batch:
                agent = _agent(number, type_name, spots[number], network, vehicle_class)
                try:
                    placed[number], _ = place_vehicle(agent, network)
                except GroundSimulatorError as err:
                    answers[number] = _reason(err)
                    if agent.agent_id in libsumo.vehicle.getLoadedIDList():
                        libsumo.vehicle.remove(agent.agent_id)
            for number, place in placed.items():
                answers[number] = _off(str(number), place)
            libsumo.simulationStep()
            present = set(libsumo.vehicle.getIDList())
            for number in placed:
                if not answers[number] and str(number) not in present:
                    answers[number] = 'it is gone after a step'
        finally:
            process.close()
    return tuple(answers)


def _batches(spots: Sequence[Spot]) -> Iterable[list[int]]:
    """Yield groups of spots that stand apart."""
    left = list(range(len(spots)))
    while left:
        batch: list[int] = []
        later: list[int] = []
        for number in left:
            spot = spots[number]
            before = spots[batch[-1]] if batch else None
            near = (
                before is not None
                and before.lane_id == spot.lane_id
                and spot.arc_m - before.arc_m < _APART_M
            )
            (later if near else batch).append(number)
        yield batch
        left = later


def _agent(
    number: int, type_name: str, spot: Spot, network: Network, vehicle_class: str
) -> GroundAgentLoad:
    edge = network.edge_of(spot.lane_id)
    onward = (
        network.edge_of(link[0])
        for link in libsumo.lane.getLinks(spot.lane_id)
        if network.allows(link[0], vehicle_class)
    )
    return GroundAgentLoad(
        agent_id=str(number),
        type_name=type_name,
        is_person=False,
        edges=(edge, *sorted(onward)[:1]),
        lane_id=spot.lane_id,
        lane_position_m=spot.arc_m,
    )


def _off(vehicle: str, place: VehiclePlace) -> str:
    """Return '' when a vehicle stands where asked, else how far off it is."""
    if vehicle in libsumo.simulation.getPendingVehicles():
        return 'SUMO keeps it in its insertion queue'
    x, y = libsumo.vehicle.getPosition(vehicle)[:2]
    heading = sumo_angle_to_heading(float(libsumo.vehicle.getAngle(vehicle)))
    length_m = float(libsumo.vehicle.getLength(vehicle))
    off_m = distance_m(centre_from_front(x, y, *heading, length_m), place.centre)
    limit_m = max(TOLERANCE_M, place.tolerance_m)
    return '' if off_m <= limit_m else f'SUMO puts it {off_m:.2f} m off'


def _reason(err: GroundSimulatorError) -> str:
    """Return what an error says behind the agent and the place, which are known."""
    return err.message.split(': ', 1)[-1]
