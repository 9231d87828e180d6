# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What both clients check before they send, and a change of mode as MAVLink commands."""

from __future__ import annotations

from math import nan
from typing import Protocol

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.errors import AirSimulatorError
from aurora_core.ports.simulators import FloatArray, UavHome
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UavMode
from aurora_uav_bridge.errors import CommandRefusedError
from aurora_uav_sim.autopilot import FlightMode
from aurora_uav_sim.protocol import MAX_TICK

_ARM = int(mavlink.MAV_CMD_COMPONENT_ARM_DISARM)
_TAKEOFF = int(mavlink.MAV_CMD_NAV_TAKEOFF)
_LAND = int(mavlink.MAV_CMD_NAV_LAND)
_SET_MODE = int(mavlink.MAV_CMD_DO_SET_MODE)


class CommandLink(Protocol):
    """Way of a command to a vehicle."""

    def command(self, system_id: int, what: str, command: int, *parameters: float) -> None:
        """Send a COMMAND_LONG until it is acknowledged.

        Raises:
            AirSimulatorError: It is refused, or nobody answers.
        """


def check_advance(homes: tuple[UavHome, ...], at: int, tick: int, commands: FloatArray) -> None:
    """Check that commands are those of the next tick.

    Args:
        homes: The fleet.
        at: Present tick, -1 before `load`.
        tick: That the commands are for.
        commands: One row per UAV.

    Raises:
        AirSimulatorError: They are not.
    """
    if at < 0 or tick != at + 1 or tick > MAX_TICK:
        raise AirSimulatorError(
            f'air simulator at tick {at}: expected tick {at + 1} next, found {tick}',
            hint='call load, then advance by one tick at a time',
        )
    if commands.shape != (len(homes), UAV_COMMAND_WIDTH):
        raise AirSimulatorError(
            f'air commands at tick {tick}: expected shape '
            f'({len(homes)}, {UAV_COMMAND_WIDTH}), found {commands.shape}'
        )


def change_mode(
    link: CommandLink,
    home: UavHome,
    mode: UavMode,
    *,
    armed: bool,
    landed: bool,
    takeoff_m: float,
) -> None:
    """Bring a vehicle into a mode by MAVLink commands with checked answers.

    Args:
        link: Way to it.
        home: Names it.
        mode: Wanted.
        armed: As it says now.
        landed: As it says now.
        takeoff_m: Altitude to take off to, above sea level.

    Raises:
        AirSimulatorError: It is refused, or nobody answers.
    """
    system_id = home.system_id
    if mode is UavMode.TAKEOFF:
        link.command(system_id, 'arm', _ARM, 1.0)
        link.command(system_id, 'take off', _TAKEOFF, 0.0, 0.0, 0.0, nan, nan, nan, takeoff_m)
    elif mode is UavMode.OFFBOARD:
        main, sub = FlightMode.OFFBOARD.value
        custom = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
        link.command(system_id, 'set mode offboard', _SET_MODE, custom, float(main), float(sub))
        if not armed:
            link.command(system_id, 'arm', _ARM, 1.0)
    elif mode is UavMode.LAND:
        land(link, home)
    elif armed:
        if not landed:
            raise CommandRefusedError(
                f'{home.uav_id}: expected LAND before IDLE, found it in the air'
            )
        link.command(system_id, 'disarm', _ARM, 0.0)


def land(link: CommandLink, home: UavHome) -> None:
    """Let a vehicle land where it is.

    Raises:
        AirSimulatorError: It is refused, or nobody answers.
    """
    link.command(home.system_id, 'land', _LAND, 0.0, 0.0, 0.0, nan, nan, nan, 0.0)
