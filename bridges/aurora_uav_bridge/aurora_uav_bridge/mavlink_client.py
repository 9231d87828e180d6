# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The air simulator as core sees it, over MAVLink 2 in lockstep; no ROS."""

from __future__ import annotations

import secrets
from collections.abc import Callable

import numpy as np
from pymavlink.dialects.v20 import common as mavlink

from aurora_core.errors import AirSimulatorError
from aurora_core.geometry.frames import enu_to_geodetic, yaw_enu_to_compass_deg
from aurora_core.ports.simulators import AirLoad, FloatArray, UavHome
from aurora_core.trace.layout import (
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
)
from aurora_uav_bridge import conversions
from aurora_uav_bridge.errors import (
    CommandRefusedError,
    SimulatorHeldError,
    SimulatorSilentError,
)
from aurora_uav_bridge.flight_commands import change_mode, check_advance
from aurora_uav_bridge.lockstep_link import OWN_COMPONENT, OWN_SYSTEM, LockstepLink
from aurora_uav_bridge.transports import Transport
from aurora_uav_sim.protocol import (
    AUTOPILOT_COMPONENT,
    CMD_LOCKSTEP,
    CMD_SEED,
    CMD_WIND,
    MAX_NONCE,
    OWNER_SILENCE_S,
    fleet_masks,
    seed_words,
)
from aurora_uav_sim.wire import Sequence

# A session of somebody who died is free after the simulator's limit of silence; the wait for it.
_HELD_LIMIT_S = OWNER_SILENCE_S + 1.0
_HELD_PAUSE_S = 0.25
# Leaving must not hold up the end of a run for long.
_LEAVE_LIMIT_S = 0.5
_GLOBAL = int(mavlink.MAV_FRAME_GLOBAL)
_SET_HOME = int(mavlink.MAV_CMD_DO_SET_HOME)
_REBOOT = int(mavlink.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN)


def random_nonce() -> int:
    """Return a session number of its own; results do not depend on it."""
    return 1 + secrets.randbelow(MAX_NONCE)


class MavlinkClient:
    """`aurora_core.ports.simulators.AirSimulator` over MAVLink.

    Args:
        transport: Way to the simulator; closed by `close`.
        timeout_s: Longest wait for the answer to one question.
        make_nonce: Gives session numbers.
    """

    def __init__(
        self,
        transport: Transport,
        *,
        timeout_s: float = 5.0,
        make_nonce: Callable[[], int] = random_nonce,
    ) -> None:
        self._transport = transport
        self._timeout_s = timeout_s
        self._make_nonce = make_nonce
        self._sequence = Sequence(OWN_SYSTEM, OWN_COMPONENT)
        self._link: LockstepLink | None = None
        self._nonce = 0
        self._closed = False
        self._homes: tuple[UavHome, ...] = ()
        self._modes: list[UavMode] = []
        self._altitude_m = 0.0
        self._tick = -1
        self._state: FloatArray = np.zeros((0, UAV_WIDTH))

    def load(self, load: AirLoad) -> None:
        """Open a session: reset, homes, wind, seed; afterwards `state` is tick 0.

        Raises:
            CommandRangeError: A number is not finite or out of range; nothing was sent.
            SimulatorSilentError: No answer within the time limit.
            CommandRefusedError: The simulator refused something, named.
            SimulatorHeldError: It is in lockstep with another client that is alive.
        """
        if self._closed:
            raise AirSimulatorError('the link to the air simulator is closed', hint='open another')
        tick_us = conversions.check_load(load)
        self._tick = -1
        self._homes = load.homes
        self._modes = [UavMode.IDLE for _ in load.homes]
        self._altitude_m = load.origin_alt_m
        self._state = np.zeros((0, UAV_WIDTH))
        if load.homes:
            link = self._open(load, tick_us)
            link.step(0, [])
            self._state = np.array(link.rows, dtype=np.float64)
        self._tick = 0

    def state(self) -> FloatArray:
        """Return the packed state (M, UAV_WIDTH) of the current tick."""
        if self._tick < 0:
            raise AirSimulatorError('no load before state', hint='call load first')
        return self._state.copy()

    def advance(self, tick: int, commands: FloatArray) -> FloatArray:
        """Apply commands stamped `tick`, advance to tick * dt, return the state there.

        A change of mode becomes MAVLink commands first: TAKEOFF arms and takes off, OFFBOARD sets
        the mode, LAND lands, IDLE disarms on the ground.

        Args:
            tick: The current tick plus one.
            commands: (M, UAV_COMMAND_WIDTH) in the order of `UavCommandColumn`.

        Returns:
            (M, UAV_WIDTH) in the order of `UavColumn`.

        Raises:
            CommandRangeError: A field is not finite or out of range (named); nothing was sent.
            CommandRefusedError: The autopilot refused a mode.
            SimulatorSilentError: No answer within the time limit.
            SessionLostError: The simulator restarted or serves another client.
        """
        homes = self._homes
        check_advance(homes, self._tick, tick, commands)
        link = self._link
        if homes and link is not None:
            rows: list[list[float]] = commands.tolist()
            # Check every row before anything is sent for any.
            wanted = [
                conversions.check_command(home, tick, row)
                for home, row in zip(homes, rows, strict=True)
            ]
            for i, mode in enumerate(wanted):
                if mode is not self._modes[i]:
                    above_m = rows[i][UavCommandColumn.TAKEOFF_ALTITUDE]
                    change_mode(
                        link, homes[i], mode,
                        armed=self._state[i, UavColumn.ARMED] == 1.0,
                        landed=self._state[i, UavColumn.LANDED] == 1.0,
                        takeoff_m=self._altitude_m + above_m,
                    )  # fmt: skip
                    self._modes[i] = mode
            set_points = [
                conversions.set_point_fields(home, tick, row)
                for home, row in zip(homes, rows, strict=True)
            ]
            link.step(tick, set_points)
            self._state = np.array(link.rows, dtype=np.float64)
        self._tick = tick
        return self._state.copy()

    def stand_by(self) -> None:
        """Keep the session while no tick comes; the simulator gives a silent one away."""
        if self._link is not None:
            self._link.heartbeat()

    def close(self) -> None:
        """Leave the session and free the link; safe to call twice."""
        if self._closed:
            return
        self._closed = True
        link, self._link = self._link, None
        try:
            if link is not None:
                link.command(
                    link.first, 'leave lockstep', CMD_LOCKSTEP, 0.0, float(self._nonce),
                    limit_s=_LEAVE_LIMIT_S,
                )  # fmt: skip
        except (SimulatorSilentError, CommandRefusedError):
            # There is nothing to leave: the simulator is dead, restarted or taken over. A living
            # one ends the session by itself.
            self._nonce = 0
        finally:
            self._transport.close()

    def _open(self, load: AirLoad, tick_us: int) -> LockstepLink:
        """Enter lockstep and prepare every vehicle."""
        self._nonce = self._make_nonce()
        self._link = link = LockstepLink(
            self._transport, self._timeout_s, load.homes, self._nonce, self._sequence
        )
        self._enter(link, load, tick_us)
        for home in load.homes:
            system_id = home.system_id
            link.command(system_id, 'reboot', _REBOOT, 1.0)
            latitude_deg, longitude_deg = enu_to_geodetic(
                home.x_m, home.y_m, load.origin_lat_deg, load.origin_lon_deg
            )
            # COMMAND_INT: a float would round the place to metres.
            message = mavlink.MAVLink_command_int_message(
                system_id, AUTOPILOT_COMPONENT, _GLOBAL, _SET_HOME, 0, 0,
                0.0, 0.0, 0.0, yaw_enu_to_compass_deg(home.yaw_enu_rad),
                round(latitude_deg * 1e7), round(longitude_deg * 1e7), load.origin_alt_m,
            )  # fmt: skip
            link.message(system_id, 'set home', _SET_HOME, message)
            link.command(
                system_id, 'set wind', CMD_WIND,
                load.wind_mean_north_mps, load.wind_mean_east_mps, 0.0, load.wind_gust_mps,
            )  # fmt: skip
            link.command(system_id, 'set seed', CMD_SEED, *seed_words(load.seed))
        return link

    def _enter(self, link: LockstepLink, load: AirLoad, tick_us: int) -> None:
        """Enter lockstep, after the silence of an owner that died if need be."""
        transport = self._transport
        masks = fleet_masks(tuple(home.system_id for home in load.homes))
        until_s = transport.steady_time_s() + _HELD_LIMIT_S
        while True:
            try:
                link.command(
                    link.first, 'enter lockstep', CMD_LOCKSTEP,
                    1.0, float(self._nonce), float(tick_us), *masks,
                )  # fmt: skip
            except SimulatorHeldError:
                again_s = transport.steady_time_s() + _HELD_PAUSE_S
                if again_s > until_s:
                    raise
            else:
                return
            while (left_s := again_s - transport.steady_time_s()) > 0.0:
                transport.receive(left_s)  # telemetry for anybody
