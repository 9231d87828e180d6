# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Carrying out one ground command; ranges were checked before (`checks.check_command`)."""

from __future__ import annotations

from collections.abc import Callable

import libsumo

from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_sumo_bridge.checks import refused
from aurora_sumo_bridge.driver import Driver
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.placement import Body
from aurora_sumo_bridge.walkers import Walker

_NOT_A_COMMAND = 'no command for this kind of agent'


def apply_command(command: GroundCommand, body: Body, network: Network) -> None:
    """Carry out a command on a present agent.

    Raises:
        GroundSimulatorError: The command does not fit the agent or its place, or SUMO refuses;
            names agent, command and value.
    """
    try:
        if body.walker is not None:
            fault = _command_walker(command, body.agent_id, body.walker)
        elif body.driver is not None:
            fault = _command_driver(command, body.agent_id, body.driver)
            if fault == _NOT_A_COMMAND:
                action = _ROUTE_ACTIONS.get(command.kind)
                fault = action(command, body, network) if action else _NOT_A_COMMAND
        else:
            fault = _command_parked(command, body.agent_id)
    except libsumo.TraCIException as err:
        raise refused(
            body.agent_id,
            command,
            f'SUMO refuses value {command.value:g}, text {command.text!r}: {err}',
        ) from err
    if fault:
        raise refused(body.agent_id, command, fault)


def _command_driver(command: GroundCommand, vehicle: str, driver: Driver) -> str:
    match command.kind:
        case GroundCommandKind.SET_SPEED:
            driver.set_speed(command.value)
        case GroundCommandKind.RELEASE_SPEED:
            driver.release_speed()
        case GroundCommandKind.SET_SPEED_FACTOR:
            driver.set_speed_factor(command.value)
        case GroundCommandKind.SET_TIME_GAP:
            driver.set_time_gap(command.value)
        case GroundCommandKind.SET_MIN_GAP:
            driver.set_min_gap(command.value)
        case GroundCommandKind.SET_DECELERATION:
            driver.set_deceleration(command.value)
        case GroundCommandKind.SET_LANE_CHANGE_MODE:
            driver.set_lane_change_mode(int(command.value))
        case GroundCommandKind.REMOVE:
            libsumo.vehicle.remove(vehicle)
        case _:
            return _NOT_A_COMMAND
    return ''


def _command_walker(command: GroundCommand, person: str, walker: Walker) -> str:
    match command.kind:
        case GroundCommandKind.SET_SPEED:
            walker.set_speed(command.value)
        case GroundCommandKind.RELEASE_SPEED:
            walker.release_speed()
        case GroundCommandKind.SET_SPEED_FACTOR:
            walker.set_speed_factor(command.value)
        case GroundCommandKind.WALK:
            return walker.walk(tuple(command.text.split()), command.value)
        case GroundCommandKind.REMOVE:
            libsumo.person.remove(person)
        case _:
            return _NOT_A_COMMAND
    return ''


def _command_parked(command: GroundCommand, vehicle: str) -> str:
    match command.kind:
        case GroundCommandKind.SET_SPEED if command.value == 0.0:
            pass
        case GroundCommandKind.REMOVE:
            libsumo.vehicle.remove(vehicle)
        case _:
            return f'value {command.value:g}: a parked vehicle stands, it can only be removed'
    return ''


def _set_route(command: GroundCommand, body: Body, network: Network) -> str:
    edges = tuple(command.text.split())
    route = libsumo.vehicle.getRoute(body.agent_id)
    current = str(route[int(libsumo.vehicle.getRouteIndex(body.agent_id))])
    if edges[0] != current:
        return f"the route must begin with the current edge '{current}', not with '{edges[0]}'"
    fault = network.check_drivable(edges, body.vehicle_class)
    if not fault:
        libsumo.vehicle.setRoute(body.agent_id, edges)
    return fault


def _change_lane(command: GroundCommand, body: Body, network: Network) -> str:
    vehicle, index = body.agent_id, int(command.value)
    edge_id = str(libsumo.vehicle.getRoadID(vehicle))
    if edge_id.startswith(':'):
        # On a junction the count is that of the street it is about to enter.
        route = libsumo.vehicle.getRoute(vehicle)
        edge_id = str(route[int(libsumo.vehicle.getRouteIndex(vehicle)) + 1])
    lanes = network.lanes_of(edge_id)
    if index >= len(lanes):
        return f"value {index}: edge '{edge_id}' has lanes 0 to {len(lanes) - 1}"
    if not network.allows(lanes[index], body.vehicle_class):
        return f"value {index}: lane '{lanes[index]}' does not allow {body.vehicle_class}"
    libsumo.vehicle.changeLane(vehicle, index, command.value2)
    return ''


def _stop_at(command: GroundCommand, body: Body, network: Network) -> str:
    lane_id = command.text.strip()
    if not network.has_lane(lane_id):
        return f"the map has no lane '{lane_id}'"
    front_m = command.value + 0.5 * body.length_m
    length_m = network.arc_length_m(lane_id)
    if front_m > length_m:
        return (
            f'value {command.value:g}: the front bumper would stand at {front_m:.2f} m, '
            f"but lane '{lane_id}' ends at {length_m:.2f} m"
        )
    libsumo.vehicle.setStop(
        body.agent_id,
        network.edge_of(lane_id),
        network.sumo_position_m(lane_id, front_m),
        int(lane_id.rsplit('_', 1)[1]),
        command.value2,
    )
    return ''


def _resume(_command: GroundCommand, body: Body, _network: Network) -> str:
    vehicle = body.agent_id
    if libsumo.vehicle.isStopped(vehicle):
        libsumo.vehicle.resume(vehicle)
    elif libsumo.vehicle.getStops(vehicle, 1):
        # Not there yet: replacing the next stop by nothing drops it.
        libsumo.vehicle.replaceStop(vehicle, 0, '')
    return ''


_Action = Callable[[GroundCommand, Body, Network], str]

_ROUTE_ACTIONS: dict[GroundCommandKind, _Action] = {
    GroundCommandKind.SET_ROUTE: _set_route,
    GroundCommandKind.CHANGE_LANE: _change_lane,
    GroundCommandKind.STOP_AT: _stop_at,
    GroundCommandKind.RESUME: _resume,
}
