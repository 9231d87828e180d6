# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Questions and answers in lockstep, over a link that may lose anything.

One question is under way at a time. It is repeated, as new frames, until every piece of its
answer is there or the time limit ends; a repeated question has no second effect on the other
side (`aurora_uav_sim.protocol`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.errors import AirSimulatorError
from aurora_core.ports.simulators import UavHome
from aurora_core.trace.layout import UAV_WIDTH
from aurora_uav_bridge import conversions
from aurora_uav_bridge.errors import (
    CommandRefusedError,
    SessionLostError,
    SimulatorHeldError,
    SimulatorSilentError,
)
from aurora_uav_bridge.transports import Transport
from aurora_uav_sim.autopilot import Result
from aurora_uav_sim.protocol import AUTOPILOT_COMPONENT, CMD_LOCKSTEP, CMD_STEP, unpack_status
from aurora_uav_sim.wire import (
    ATTITUDE,
    COMMAND_ACK,
    COMMAND_LONG,
    LOCAL_POSITION,
    NAMED_INT,
    SET_POINT,
    Decoder,
    Frame,
    Newer,
    Sequence,
    split,
)

# The identity that companion computers use by custom.
OWN_SYSTEM = 245
OWN_COMPONENT = int(mavlink.MAV_COMP_ID_ONBOARD_COMPUTER)
# When to ask again: after several times what an answer usually takes (0.1 ms, more with many
# vehicles or little processor), within these limits; then after a growing time. A repetition too
# early costs the simulator a second answer, one too late costs each lost datagram its wait.
_LEAST_RETRY_S = 0.002
_FIRST_RETRY_S = 0.01
_LAST_RETRY_S = 0.25
_USUAL_ANSWERS = 8.0
_RETRY_GROWTH = 1.5
# Weight of the newest answer in the usual time.
_NEWEST = 0.125
# A step answered so often with "no such session" means it; fewer may be leftovers.
_DISOWNED_LIMIT = 3
_HELD_HINT = 'another client flies with this simulator: end it, or use another ROS_DOMAIN_ID'
_STATUS_TEXT = int(mavlink.MAVLINK_MSG_ID_STATUSTEXT)
_ACK_ID = COMMAND_ACK.message_id
_POSITION_ID = LOCAL_POSITION.message_id
_ATTITUDE_ID = ATTITUDE.message_id
_NAMED_INT_ID = NAMED_INT.message_id
# What a vehicle's state comes in.
_PIECES = {layout.message_id: layout for layout in (LOCAL_POSITION, ATTITUDE, NAMED_INT)}
# Plain numbers: before Python 3.12 a member is slow to look up, and each tick asks.
_ACCEPTED, _DENIED = int(Result.ACCEPTED), int(Result.DENIED)

Packer = Callable[[], bytes]


class LockstepLink:
    """The fleet's end of the link.

    Args:
        transport: Way to the simulator.
        timeout_s: Longest wait for the answer to one question.
        homes: The fleet in roster order, at least one.
        nonce: Number of the session.
        sequence: Frame counter, shared by all links over the same transport.

    Attributes:
        rows: State rows in roster order, filled by `step`.
        first: System id of the vehicle that answers for the fleet: the smallest.
    """

    def __init__(
        self,
        transport: Transport,
        timeout_s: float,
        homes: tuple[UavHome, ...],
        nonce: int,
        sequence: Sequence,
    ) -> None:
        self._transport = transport
        self._timeout_s = timeout_s
        self._homes = homes
        self._index = {home.system_id: i for i, home in enumerate(homes)}
        self.first = min(self._index)
        self.rows = [[0.0] * UAV_WIDTH for _ in homes]
        self._nonce = nonce
        self._sequence = sequence
        self._newer = Newer()
        self._decoder = Decoder()
        self._usual_answer_s = _FIRST_RETRY_S / _USUAL_ANSWERS
        # What the present question waits for: an acknowledgement ...
        self._ack_of = (-1, -1)
        self._acks: list[int] = []
        self._text = ''
        # ... or a tick.
        self._tick = -1
        self._pieces: list[dict[int, tuple[Any, ...]]] = []
        self._missing = 0
        self._acknowledged = False
        self._disowned = 0

    # Questions ----------------------------------------------------------------------------------

    def command(
        self,
        system_id: int,
        what: str,
        command: int,
        *parameters: float,
        limit_s: float | None = None,
    ) -> None:
        """Send a COMMAND_LONG until it is acknowledged.

        Args:
            system_id: The vehicle.
            what: The command in words, for messages.
            command: MAV_CMD.
            parameters: Its parameters, the rest is 0.
            limit_s: Another time limit than the link's.

        Raises:
            CommandRefusedError: The answer is not ACCEPTED.
            SimulatorHeldError: The same to entering, while another client has the session.
            SimulatorSilentError: No answer within the time limit.
        """
        filled = (*parameters, *(0.0 for _ in range(7 - len(parameters))))
        confirmations = iter(range(256))

        def packer() -> bytes:
            confirmation = next(confirmations, 255)
            return COMMAND_LONG.frame(
                self._sequence, *filled, command, system_id, AUTOPILOT_COMPONENT, confirmation
            )

        self._ask(packer, system_id, command, what, limit_s)

    def message(self, system_id: int, what: str, command: int, message: Any) -> None:
        """Send a pymavlink message that carries a command until it is acknowledged.

        Raises:
            CommandRefusedError: The answer is not ACCEPTED.
            SimulatorSilentError: No answer within the time limit.
        """
        self._ask(lambda: self._sequence.encode(message), system_id, command, what, None)

    def step(self, tick: int, set_points: list[tuple[Any, ...]]) -> None:
        """Ask for a tick until every vehicle's state and the acknowledgement are there.

        Args:
            tick: The tick, 0 for the spawned state.
            set_points: Fields of SET_POSITION_TARGET_LOCAL_NED per vehicle.

        Raises:
            SimulatorSilentError: No answer within the time limit.
            SessionLostError: The simulator restarted or serves another client.
            AirSimulatorError: A state is not finite.
        """
        sequence = self._sequence
        confirmation = 0

        def packer() -> bytes:
            nonlocal confirmation
            out = b''
            for fields in set_points:
                out += SET_POINT.frame(sequence, *fields)
            out += COMMAND_LONG.frame(
                sequence, float(tick), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
                CMD_STEP, self.first, AUTOPILOT_COMPONENT, confirmation,
            )  # fmt: skip
            confirmation = min(confirmation + 1, 255)
            return out

        self._tick = tick
        self._pieces = [{} for _ in self._homes]
        self._missing = len(_PIECES) * len(self._homes)
        self._acknowledged = False
        self._disowned = 0
        try:
            self._exchange(packer, self._has_tick, f'step to tick {tick}', self._timeout_s)
        finally:
            self._tick = -1
        self.rows = [
            conversions.state_row(
                home, pieces[_POSITION_ID], pieces[_ATTITUDE_ID], pieces[_NAMED_INT_ID]
            )
            for home, pieces in zip(self._homes, self._pieces, strict=True)
        ]
        if not conversions.all_finite(self.rows):
            raise AirSimulatorError(f'uav_sim reported a number that is not finite at tick {tick}')

    def _has_tick(self) -> bool:
        return self._missing == 0 and self._acknowledged

    def _has_ack(self) -> bool:
        return bool(self._acks)

    def _ask(
        self, packer: Packer, system_id: int, command: int, what: str, limit_s: float | None
    ) -> None:
        name = f'{what} of {self._homes[self._index[system_id]].uav_id}'
        self._acks, self._ack_of, self._text = [], (system_id, command), ''
        limit_s = self._timeout_s if limit_s is None else limit_s
        try:
            self._exchange(packer, self._has_ack, name, limit_s)
        finally:
            self._ack_of = (-1, -1)
        result = self._acks[0]
        if result != _ACCEPTED:
            word = Result(result).name if result in tuple(Result) else f'result {result}'
            reason = f': {self._text}' if self._text else ''
            text = f'{name}: expected ACCEPTED, found {word}{reason}'
            if command == CMD_LOCKSTEP and result == Result.TEMPORARILY_REJECTED:
                raise SimulatorHeldError(text, hint=_HELD_HINT)
            raise CommandRefusedError(text)

    def _exchange(
        self, packer: Packer, done: Callable[[], bool], what: str, limit_s: float
    ) -> None:
        transport = self._transport
        start_s = transport.steady_time_s()
        asked_s = start_s
        wait_s = min(max(_USUAL_ANSWERS * self._usual_answer_s, _LEAST_RETRY_S), _FIRST_RETRY_S)
        while True:
            transport.send(packer())
            left_s = wait_s
            while left_s > 0.0:
                datagram = transport.receive(left_s)
                if datagram is None:
                    break
                self._take(datagram)
                if done():
                    if asked_s == start_s:
                        # Only the answer to a single question tells how long one takes.
                        took_s = transport.steady_time_s() - start_s
                        self._usual_answer_s += _NEWEST * (took_s - self._usual_answer_s)
                    return
                left_s = asked_s + wait_s - transport.steady_time_s()
            asked_s = transport.steady_time_s()
            if asked_s - start_s >= limit_s:
                raise SimulatorSilentError(
                    f'{transport.peer} did not answer within {limit_s:g} s ({what})',
                    hint='is it running? ros2 run aurora_uav_sim uav_sim',
                )
            wait_s = min(_RETRY_GROWTH * wait_s, _LAST_RETRY_S)

    def heartbeat(self) -> None:
        """Say that the owner of the session is there; no answer comes."""
        message = mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID,
            0, 0, mavlink.MAV_STATE_ACTIVE, 3,
        )  # fmt: skip
        self._transport.send(self._sequence.encode(message))

    # Answers ------------------------------------------------------------------------------------

    def _take(self, datagram: bytes) -> None:
        """Take what a datagram brings for the question under way."""
        for frame in split(datagram):
            message_id, _, system_id, component_id, payload, _ = frame
            if component_id != AUTOPILOT_COMPONENT:
                continue
            if message_id == _ACK_ID:
                self._take_ack(frame)
                continue
            i = self._index.get(system_id)
            if i is None or not self._newer.accept(frame):
                continue
            layout = _PIECES.get(message_id)
            if layout is not None:
                fields = layout.unpack(payload)
                if fields[0] != self._tick:
                    continue
                is_status = message_id == _NAMED_INT_ID
                piece = unpack_status(fields[1], self._nonce) if is_status else fields
                if piece is not None:
                    pieces = self._pieces[i]
                    self._missing -= message_id not in pieces
                    pieces[message_id] = piece
            elif message_id == _STATUS_TEXT:
                message = self._decoder.decode(frame)
                if message is not None:
                    self._text = str(message.text)

    def _take_ack(self, frame: Frame) -> None:
        # `number` is the tick of a step and the nonce of everything else.
        command, result, _, number, target_system, _ = COMMAND_ACK.unpack(frame.payload)
        if target_system != OWN_SYSTEM:
            return
        if command == CMD_STEP and result == _DENIED and self._tick >= 0:
            self._check_disowned(number)
        if command == CMD_LOCKSTEP and number == self._nonce and self._waits_for(frame, command):
            # The simulator may be a new process that counts its frames from 0.
            self._newer = Newer()
        if not self._newer.accept(frame):
            return
        if command != CMD_STEP:
            if number == self._nonce and self._waits_for(frame, command):
                self._acks.append(int(result))
        elif number == self._tick and result == _ACCEPTED:
            self._acknowledged = True
        # Otherwise a set-point is missing (the question will be repeated) or the answer is old.

    def _waits_for(self, frame: Frame, command: int) -> bool:
        return not self._acks and self._ack_of == (frame.system_id, command)

    def _check_disowned(self, number: int) -> None:
        """Notice a simulator that knows no session of ours (stale frames are looked at too).

        Raises:
            SessionLostError: It has said so several times.
        """
        if number not in (0, self._tick):
            return
        self._disowned += 1
        if self._disowned >= _DISOWNED_LIMIT:
            raise SessionLostError(
                f'{self._transport.peer} no longer knows this run at tick {self._tick}',
                hint='it was restarted or taken over by another client; run again',
            )
