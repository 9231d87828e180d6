# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Putting one vehicle exactly where it is asked to be at t = 0.

`vehicle.add` alone queues a vehicle and leaves it in the queue for ever, without an error, when
SUMO finds the place unsafe. `vehicle.moveTo` puts it in at once and checks nothing, so every
check is made here.
"""

from __future__ import annotations

from dataclasses import dataclass

import libsumo

from aurora_core.geometry.frames import heading_to_sumo_angle
from aurora_core.ports.simulators import GroundAgentLoad, kerb_offset_m
from aurora_sumo_bridge.checks import unplaceable
from aurora_sumo_bridge.conversions import front_from_centre
from aurora_sumo_bridge.driver import Driver
from aurora_sumo_bridge.network import PEDESTRIAN, Network
from aurora_sumo_bridge.polyline import Point

# How far a speed may exceed the limit: the net rounds limits to two decimals.
LIMIT_SLACK_MPS = 5e-3
# SUMO's own mode: the vehicle follows its route and its lane; off them it may stand anywhere.
_KEEP_ROUTE_ANYWHERE = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class VehiclePlace:
    """Where a vehicle's centre is asked to be, and how far off it may come out.

    Attributes:
        centre: ENU, m.
        tolerance_m: What the bend of the lane under a rigid box costs, plus `EXACT_M`.
    """

    centre: Point
    tolerance_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ParkedPose:
    """Pose at which a parked vehicle is held, in SUMO's terms (front bumper, compass degrees)."""

    agent_id: str
    front: Point
    angle_deg: float

    def hold(self) -> None:
        """Ask for the pose in the next step; SUMO lets go of it when it is not asked again."""
        libsumo.vehicle.moveToXY(
            self.agent_id,
            '',
            -1,
            self.front[0],
            self.front[1],
            self.angle_deg,
            _KEEP_ROUTE_ANYWHERE,
        )


# Placement is exact to this on a straight lane.
EXACT_M = 0.01


def check_lane(agent: GroundAgentLoad, network: Network) -> str:
    """Raise unless lane, class, position and route of a vehicle fit; return its vehicle class.

    Raises:
        GroundSimulatorError: Names the agent, the place and what does not fit.
    """
    vehicle_class = str(libsumo.vehicletype.getVehicleClass(agent.type_name))
    if not network.has_lane(agent.lane_id):
        raise unplaceable(agent, f"the map has no lane '{agent.lane_id}'")
    if not agent.edges or network.edge_of(agent.lane_id) != agent.edges[0]:
        first = agent.edges[0] if agent.edges else ''
        raise unplaceable(agent, f"the lane is not on the first edge '{first}' of the route")
    if not agent.parked and not network.allows(agent.lane_id, vehicle_class):
        raise unplaceable(agent, f'the lane does not allow {vehicle_class}')
    length_m = network.arc_length_m(agent.lane_id)
    if agent.lane_position_m > length_m:
        raise unplaceable(agent, f'the lane ends at {length_m:.2f} m')
    fault = network.check_drivable(agent.edges, vehicle_class)
    if fault:
        raise unplaceable(agent, fault)
    return vehicle_class


def place_vehicle(agent: GroundAgentLoad, network: Network) -> tuple[VehiclePlace, Driver]:
    """Insert a moving vehicle at once, with the asked centre and speed.

    Raises:
        GroundSimulatorError: It cannot be; names the agent, the place and why.
    """
    vehicle_class = check_lane(agent, network)
    _add(agent)
    vehicle = agent.agent_id
    driver = Driver(agent)
    half_m = 0.5 * float(libsumo.vehicle.getLength(vehicle))
    lane_id, position_m = _front_lane(agent, network, vehicle_class, half_m)
    limit_mps = min(
        agent.speed_factor * float(libsumo.lane.getMaxSpeed(lane_id)),
        float(libsumo.vehicle.getMaxSpeed(vehicle)),
    )
    if agent.speed_mps > limit_mps + LIMIT_SLACK_MPS:
        raise unplaceable(
            agent,
            f'speed_mps {agent.speed_mps:g} is above the {limit_mps:g} m/s that lane {lane_id}, '
            f'speed_factor {agent.speed_factor:g} and the type allow {vehicle_class}',
        )
    libsumo.vehicle.moveTo(vehicle, lane_id, position_m)
    libsumo.vehicle.setPreviousSpeed(vehicle, agent.speed_mps, 0.0)
    line = network.shape(agent.lane_id)
    centre, _ = line.at(agent.lane_position_m)
    # Where the box reaches over an end of the lane, half of what sticks out bounds the bend.
    over_m = max(
        0.0,
        half_m - agent.lane_position_m,
        agent.lane_position_m + half_m - line.length_m,
    )
    # SUMO counts the lane of a curve shorter than it is drawn: so much longer is the box there.
    stretch = max(1.0, line.length_m / float(libsumo.lane.getLength(agent.lane_id)))
    bend_m = line.bend_m(agent.lane_position_m, half_m * stretch)
    place = VehiclePlace(centre=centre, tolerance_m=EXACT_M + bend_m + 0.5 * over_m)
    return place, driver


def park_vehicle(agent: GroundAgentLoad, network: Network) -> tuple[VehiclePlace, ParkedPose]:
    """Add a vehicle that stands beside the traffic; the next step puts it there.

    On a lane that its class may drive on, it stands right of the lane, flank
    `KERB_CLEARANCE_M` off the lane's border; on any other lane (parking lane, sidewalk) in the
    middle.

    Raises:
        GroundSimulatorError: Lane or position does not exist, or a speed is asked for.
    """
    vehicle_class = check_lane(agent, network)
    if agent.speed_mps != 0.0:
        raise unplaceable(agent, f'a parked vehicle has no speed_mps {agent.speed_mps:g}')
    _add(agent)
    (x, y), (tx, ty) = network.shape(agent.lane_id).at(agent.lane_position_m)
    offset_m = 0.0
    if network.allows(agent.lane_id, vehicle_class):
        offset_m = kerb_offset_m(
            float(libsumo.lane.getWidth(agent.lane_id)),
            float(libsumo.vehicle.getWidth(agent.agent_id)),
        )
    centre = (x + offset_m * ty, y - offset_m * tx)
    length_m = float(libsumo.vehicle.getLength(agent.agent_id))
    pose = ParkedPose(
        agent_id=agent.agent_id,
        front=front_from_centre(centre[0], centre[1], tx, ty, length_m),
        angle_deg=heading_to_sumo_angle(tx, ty),
    )
    pose.hold()
    return VehiclePlace(centre=centre, tolerance_m=EXACT_M), pose


def check_type(agent: GroundAgentLoad, known_types: frozenset[str]) -> None:
    """Raise unless the vType exists and is one for what the agent is.

    Raises:
        GroundSimulatorError: Names the agent and the type.
    """
    if agent.type_name not in known_types:
        raise unplaceable(agent, f"there is no vType '{agent.type_name}'")
    walks = str(libsumo.vehicletype.getVehicleClass(agent.type_name)) == PEDESTRIAN
    if walks != agent.is_person:
        asked = 'a person' if agent.is_person else 'a vehicle'
        raise unplaceable(agent, f"vType '{agent.type_name}' is not one of {asked}")


def _add(agent: GroundAgentLoad) -> None:
    route_id = f'route of {agent.agent_id}'
    try:
        libsumo.route.add(route_id, agent.edges)
        libsumo.vehicle.add(
            agent.agent_id, route_id, agent.type_name, departPos='0', departSpeed='0'
        )
    except libsumo.TraCIException as err:
        raise unplaceable(agent, f'SUMO says: {err}') from err


def _front_lane(
    agent: GroundAgentLoad, network: Network, vehicle_class: str, half_m: float
) -> tuple[str, float]:
    """Return the lane of the front bumper and SUMO's position on it.

    The front may lie beyond the asked lane: on the junction, or on the next street.
    """
    lane_id = agent.lane_id
    front_m = agent.lane_position_m + half_m
    while front_m > network.arc_length_m(lane_id):
        front_m -= network.arc_length_m(lane_id)
        towards = agent.edges[1] if len(agent.edges) > 1 else ''
        following = network.next_lane(lane_id, towards, vehicle_class)
        if not following:
            raise unplaceable(
                agent,
                f'the front bumper reaches {front_m:.2f} m past lane {lane_id}, '
                f"from which no lane leads to '{towards}'",
            )
        lane_id = following
        if network.edge_of(lane_id) == towards and front_m > network.arc_length_m(lane_id):
            raise unplaceable(agent, f'the box is longer than lanes {agent.lane_id} and {lane_id}')
    return lane_id, network.sumo_position_m(lane_id, front_m)
