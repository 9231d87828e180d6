# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The way to autopilots that keep their own time: telemetry in, round trips, commands."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_bridge.clock_estimate import ClockEstimator
from aurora_uav_bridge.errors import CommandRefusedError, SessionLostError, SimulatorSilentError
from aurora_uav_bridge.lockstep_link import OWN_COMPONENT, OWN_SYSTEM
from aurora_uav_bridge.telemetry_track import Told
from aurora_uav_bridge.transports import Transport
from aurora_uav_sim.autopilot import Result
from aurora_uav_sim.protocol import AUTOPILOT_COMPONENT
from aurora_uav_sim.wire import (
    ATTITUDE,
    COMMAND_ACK,
    COMMAND_LONG,
    LOCAL_POSITION,
    Decoder,
    Frame,
    Sequence,
    split,
)

# How often the time is asked for, before a run and in it.
_FIRST_ROUND_TRIP_S, _ROUND_TRIP_S = 0.02, 0.1
# How often we say that we are there. Source: MAVLink, heartbeat protocol.
_HEARTBEAT_S = 1.0
# When a command is repeated, and when it is given up. Source: MAVLink, command protocol.
_REPEAT_S = 0.5
# A time stamp so far before the newest one is of a clock that began anew.
_BACK_S = 5.0
# Questions whose answer is still waited for.
_ASKED = 256
_ACCEPTED, _IN_PROGRESS = 0, 5
_SET_INTERVAL = int(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL)
_ARMED = int(mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
_ON_GROUND = int(mavlink.MAV_LANDED_STATE_ON_GROUND)
# What a state is made of, and how often it is wanted (s).
_STREAMS = {
    int(mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED): 0.02,
    int(mavlink.MAVLINK_MSG_ID_ATTITUDE_QUATERNION): 0.02,
    int(mavlink.MAVLINK_MSG_ID_HEARTBEAT): 0.1,
    int(mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE): 0.1,
    int(mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT): 0.5,
}


class PacedLink:
    """Autopilots behind one endpoint, told apart by their system ids.

    Args:
        transport: Way to them.
        timeout_s: Longest wait for an answer.
        system_ids: Of the autopilots.

    Attributes:
        told: What each of them tells.
        clocks: The clock of each.
    """

    def __init__(self, transport: Transport, timeout_s: float, system_ids: tuple[int, ...]):
        self._transport = transport
        self._timeout_s = timeout_s
        self.told = {system_id: Told() for system_id in system_ids}
        self.clocks = {system_id: ClockEstimator() for system_id in system_ids}
        self._sequence = Sequence(OWN_SYSTEM, OWN_COMPONENT)
        self._decoder = Decoder()
        self._asked: dict[int, float] = {}
        self._interval_s = _FIRST_ROUND_TRIP_S
        self._ask_s = self._greet_s = transport.steady_time_s()
        self._ack_of = (-1, -1)
        self._acks: list[int] = []
        self._text = ''

    def wait(self, done: Callable[[], bool], until_s: float) -> bool:
        """Take what arrives until something holds; return whether it does in time."""
        while not done():
            if (left_s := until_s - self._transport.steady_time_s()) <= 0.0:
                return False
            self._keep_up()
            datagram = self._transport.receive(min(left_s, self._interval_s))
            if datagram is not None:
                self._take(datagram)
        return True

    def take_waiting(self) -> None:
        """Take what has arrived."""
        self._keep_up()
        while (datagram := self._transport.receive(0.0)) is not None:
            self._take(datagram)

    def send(self, frame: bytes) -> None:
        """Send a datagram."""
        self._transport.send(frame)

    @property
    def sequence(self) -> Sequence:
        """The frame counter of what is sent."""
        return self._sequence

    def begin(self) -> None:
        """Ask for the time as often as a run needs it."""
        self._interval_s = _ROUND_TRIP_S

    def ask_for_streams(self) -> None:
        """Ask for what a state is made of, often; who refuses sends it as it does by itself.

        Raises:
            SimulatorSilentError: Nobody answers.
        """
        for system_id in self.told:
            for message_id, interval_s in _STREAMS.items():
                self._command(system_id, 'telemetry', _SET_INTERVAL, message_id, 1e6 * interval_s)

    def command(self, system_id: int, what: str, command: int, *parameters: float) -> None:
        """Send a COMMAND_LONG until it is acknowledged.

        Raises:
            CommandRefusedError: The answer is not ACCEPTED.
            SimulatorSilentError: No answer within the time limit.
        """
        result = self._command(system_id, what, command, *parameters)
        if result != _ACCEPTED:
            word = Result(result).name if result in tuple(Result) else f'result {result}'
            reason = f': {self._text}' if self._text else ''
            raise CommandRefusedError(
                f'{what} of system {system_id}: expected ACCEPTED, found {word}{reason}'
            )

    def _command(self, system_id: int, what: str, command: int, *parameters: float) -> int:
        filled = (*parameters, *(0.0 for _ in range(7 - len(parameters))))
        self._ack_of, self._acks, self._text = (system_id, command), [], ''
        end_s = self._transport.steady_time_s() + self._timeout_s
        confirmation = 0
        while (now_s := self._transport.steady_time_s()) < end_s:
            self._transport.send(
                COMMAND_LONG.frame(
                    self._sequence, *filled, command, system_id, AUTOPILOT_COMPONENT, confirmation
                )
            )
            confirmation = min(confirmation + 1, 255)
            if self.wait(lambda: bool(self._acks), min(now_s + _REPEAT_S, end_s)):
                self._ack_of = (-1, -1)
                return self._acks[0]
        raise self.silent(f'{what} of system {system_id}')

    def silent(self, what: str) -> SimulatorSilentError:
        """Return the error of an autopilot that does not answer."""
        return SimulatorSilentError(
            f'{self._transport.peer} did not answer within {self._timeout_s:g} s ({what})',
            hint='is the autopilot running, does it send to who speaks to it, and are its system '
            'ids 1, 2, … as many as the scenario has UAVs?',
        )

    def _keep_up(self) -> None:
        """Say that we are there and ask for the time, when it is due."""
        now_s = self._transport.steady_time_s()
        if now_s >= self._greet_s:
            self._greet_s = now_s + _HEARTBEAT_S
            message = mavlink.MAVLink_heartbeat_message(
                mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID,
                0, 0, mavlink.MAV_STATE_ACTIVE, 3,
            )  # fmt: skip
            self._transport.send(self._sequence.encode(message))
        if now_s >= self._ask_s:
            self._ask_s = now_s + self._interval_s
            for old in list(self._asked)[: max(len(self._asked) - _ASKED, 0)]:
                del self._asked[old]
            number = int(1e9 * now_s)
            self._asked[number] = now_s
            self._transport.send(
                self._sequence.encode(mavlink.MAVLink_timesync_message(0, number))
            )

    def _take(self, datagram: bytes) -> None:
        received_s = self._transport.steady_time_s()
        for frame in split(datagram):
            told = self.told.get(frame.system_id)
            if told is None or frame.component_id != AUTOPILOT_COMPONENT:
                continue
            if frame.message_id == LOCAL_POSITION.message_id:
                boot_ms, *rest = LOCAL_POSITION.unpack(frame.payload)
                self._check_time(frame.system_id, told, 1e-3 * boot_ms)
                told.position.add(1e-3 * boot_ms, tuple(rest))
            elif frame.message_id == ATTITUDE.message_id:
                boot_ms, *rest = ATTITUDE.unpack(frame.payload)
                told.attitude.add(1e-3 * boot_ms, tuple(rest[:7]))
            elif frame.message_id == COMMAND_ACK.message_id:
                self._take_ack(frame)
            else:
                self._take_rare(frame, told, received_s)

    def _check_time(self, system_id: int, told: Told, time_s: float) -> None:
        """Notice an autopilot that started again.

        Raises:
            SessionLostError: Its clock went back.
        """
        if time_s < told.position.last_s() - _BACK_S:
            raise SessionLostError(
                f'the clock of system {system_id} went back from '
                f'{told.position.last_s():.1f} s to {time_s:.1f} s',
                hint='the autopilot was started again; run again',
            )

    def _take_ack(self, frame: Frame) -> None:
        command, result, _, _, target_system, _ = COMMAND_ACK.unpack(frame.payload)
        awaited = (frame.system_id, command) == self._ack_of
        if awaited and target_system in (0, OWN_SYSTEM) and result != _IN_PROGRESS:
            self._acks.append(int(result))

    def _take_rare(self, frame: Frame, told: Told, received_s: float) -> None:
        m: Any = self._decoder.decode(frame)
        if m is None:
            return
        kind = m.get_type()
        if kind == 'TIMESYNC' and m.tc1 != 0:
            sent_s = self._asked.get(m.ts1)
            if sent_s is not None:
                self.clocks[frame.system_id].take(sent_s, 1e-9 * m.tc1, received_s)
        elif kind == 'HEARTBEAT' and m.autopilot != mavlink.MAV_AUTOPILOT_INVALID:
            told.take_heartbeat(m, _ARMED)
        elif kind == 'EXTENDED_SYS_STATE':
            told.landed = m.landed_state == _ON_GROUND
        elif kind == 'GLOBAL_POSITION_INT':
            told.altitude_m = 1e-3 * m.alt
        elif kind == 'STATUSTEXT':
            self._text = str(m.text)
