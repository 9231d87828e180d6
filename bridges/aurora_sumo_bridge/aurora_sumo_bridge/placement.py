# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Placing all agents of a load, and proving that they stand where asked."""

from __future__ import annotations

from dataclasses import dataclass

import libsumo

from aurora_core.errors import GroundSimulatorError
from aurora_core.geometry.frames import sumo_angle_to_heading
from aurora_core.ports.simulators import GroundAgentLoad
from aurora_sumo_bridge.checks import check_agent_numbers, unplaceable
from aurora_sumo_bridge.driver import Driver
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.polyline import Box, boxes_overlap, distance_m
from aurora_sumo_bridge.vehicles import (
    EXACT_M,
    ParkedPose,
    VehiclePlace,
    check_type,
    park_vehicle,
    place_vehicle,
)
from aurora_sumo_bridge.walkers import Walker


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """An agent as it stands in the simulation.

    Attributes:
        agent: What was asked.
        length_m: Length of the box.
        width_m: Width of the box.
        vehicle_class: SUMO's class name.
        walker: Set for persons.
        parked: Set for parked vehicles.
        driver: Set for moving vehicles.
        heading: Heading at t = 0 (persons: SUMO's own is of no use there).
    """

    agent: GroundAgentLoad
    length_m: float
    width_m: float
    vehicle_class: str
    walker: Walker | None = None
    parked: ParkedPose | None = None
    driver: Driver | None = None
    heading: tuple[float, float] | None = None

    @property
    def agent_id(self) -> str:
        return self.agent.agent_id


def place_all(
    agents: tuple[GroundAgentLoad, ...], network: Network, dt_s: float
) -> tuple[tuple[Body, ...], tuple[VehiclePlace, ...]]:
    """Insert every agent and make the one insertion step.

    Persons and parked vehicles enter in the step, moving vehicles right after it, so that nobody
    has moved when tick 0 is read.

    Returns:
        Bodies and asked places in roster order.

    Raises:
        GroundSimulatorError: An agent cannot be placed exactly.
    """
    known_types = frozenset(libsumo.vehicletype.getIDList())
    seen: set[str] = set()
    for agent in agents:
        if not agent.agent_id or '\x00' in agent.agent_id:
            raise GroundSimulatorError(f'agent id {agent.agent_id!r} is empty or has NUL')
        if agent.agent_id in seen:
            raise GroundSimulatorError(f"agent id '{agent.agent_id}' occurs twice in the roster")
        seen.add(agent.agent_id)
        check_agent_numbers(agent)
        check_type(agent, known_types)

    walkers: dict[str, Walker] = {}
    poses: dict[str, ParkedPose] = {}
    places: dict[str, VehiclePlace] = {}
    for agent in agents:
        if agent.is_person:
            walkers[agent.agent_id] = _add_walker(agent, network, dt_s)
        elif agent.parked:
            places[agent.agent_id], poses[agent.agent_id] = park_vehicle(agent, network)
    libsumo.simulationStep()
    headings: dict[str, tuple[float, float]] = {}
    drivers: dict[str, Driver] = {}
    for agent in agents:
        if agent.is_person:
            walker = walkers[agent.agent_id]
            headings[agent.agent_id] = sumo_angle_to_heading(walker.settle())
            places[agent.agent_id] = VehiclePlace(centre=walker.asked_point(), tolerance_m=EXACT_M)
        elif not agent.parked:
            places[agent.agent_id], drivers[agent.agent_id] = place_vehicle(agent, network)
    pending = libsumo.simulation.getPendingVehicles()
    bodies = []
    for agent in agents:
        if agent.agent_id in pending:
            raise unplaceable(agent, 'SUMO keeps it in its insertion queue')
        bodies.append(
            Body(
                agent=agent,
                length_m=float(libsumo.vehicletype.getLength(agent.type_name)),
                width_m=float(libsumo.vehicletype.getWidth(agent.type_name)),
                vehicle_class=str(libsumo.vehicletype.getVehicleClass(agent.type_name)),
                walker=walkers.get(agent.agent_id),
                parked=poses.get(agent.agent_id),
                driver=drivers.get(agent.agent_id),
                heading=headings.get(agent.agent_id),
            )
        )
    return tuple(bodies), tuple(places[agent.agent_id] for agent in agents)


def check_places(
    bodies: tuple[Body, ...], places: tuple[VehiclePlace, ...], boxes: tuple[Box, ...]
) -> None:
    """Raise unless every body stands where asked and no two share ground.

    Args:
        bodies: Roster.
        places: Asked places, roster order.
        boxes: Footprints as they came out, roster order.

    Raises:
        GroundSimulatorError: Names the agent, the distance, or the other agent.
    """
    for body, place, box in zip(bodies, places, boxes, strict=True):
        off_m = distance_m((box.x_m, box.y_m), place.centre)
        if not off_m <= place.tolerance_m:
            raise unplaceable(
                body.agent,
                f'SUMO puts it {off_m:.3f} m off, more than {place.tolerance_m:.3f} m',
            )
    for first, box in enumerate(boxes):
        for second in range(first):
            other = boxes[second]
            reach_m = 0.5 * (box.length_m + box.width_m + other.length_m + other.width_m)
            if distance_m((box.x_m, box.y_m), (other.x_m, other.y_m)) < reach_m and boxes_overlap(
                box, other
            ):
                raise unplaceable(
                    bodies[first].agent, f"it overlaps agent '{bodies[second].agent_id}'"
                )


def _add_walker(agent: GroundAgentLoad, network: Network, dt_s: float) -> Walker:
    walker = Walker(agent, network, dt_s)
    try:
        walker.add()
    except libsumo.TraCIException as err:
        raise unplaceable(agent, f'SUMO says: {err}') from err
    return walker
