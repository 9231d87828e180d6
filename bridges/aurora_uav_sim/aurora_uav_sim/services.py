# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""MAVLink services that do not fly: parameters, plans, time, pings, messages on request."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim import plan_transfer
from aurora_uav_sim.autopilot import ACCEPTED, Answer, Result
from aurora_uav_sim.commands import Request, whole
from aurora_uav_sim.link import Link
from aurora_uav_sim.settings import (
    PARAMETER_INDEX,
    PARAMETERS,
    get_parameter,
    set_parameter,
)
from aurora_uav_sim.telemetry import ON_REQUEST, STREAMS
from aurora_uav_sim.vehicle import Vehicle
from aurora_uav_sim.wire import Sequence

_REQUEST_MESSAGE = int(mavlink.MAV_CMD_REQUEST_MESSAGE)
_REQUEST_CAPABILITIES = int(mavlink.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES)
_SET_INTERVAL = int(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL)
_GET_INTERVAL = int(mavlink.MAV_CMD_GET_MESSAGE_INTERVAL)
_VERSION_ID = int(mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION)
_AUTOPILOT = int(mavlink.MAV_COMP_ID_AUTOPILOT1)

# By whether a parameter is whole.
_TYPES = {False: int(mavlink.MAV_PARAM_TYPE_REAL32), True: int(mavlink.MAV_PARAM_TYPE_INT32)}

Sender = tuple[int, int]
Answerer = Callable[[Any, Sender, Vehicle, Sequence, bool], list[bytes]]


def _bytewise(value: int) -> float:
    """Return the float32 whose bytes are those of an int32. Source: MAVLink, PX4 encoding."""
    (packed,) = struct.unpack('<f', struct.pack('<i', value))
    return float(packed)


def _value_of(m: Any) -> float:
    if m.param_type == mavlink.MAV_PARAM_TYPE_REAL32:
        return float(m.param_value)
    (number,) = struct.unpack('<i', struct.pack('<f', m.param_value))
    return float(number)


class Services:
    """Stateless answers; everything that is kept lies in the vehicles and links."""

    def __init__(self) -> None:
        self._answerers: dict[str, Answerer] = {
            'PARAM_REQUEST_LIST': self._list,
            'PARAM_REQUEST_READ': self._read,
            'PARAM_SET': self._set,
            'TIMESYNC': self._timesync,
            'PING': self._ping,
        }

    def answer(
        self,
        m: Any,
        kind: str,
        sender: Sender,
        vehicles: dict[int, Vehicle],
        link: Link,
        may_change: bool,
    ) -> list[bytes]:
        """Return the frames that answer a message; nothing for one that needs no answer.

        Args:
            m: pymavlink message.
            kind: Its name.
            sender: System and component id of the sender.
            vehicles: By system id.
            link: Link to the sender.
            may_change: The sender may change settings.
        """
        answerer = self._answerers.get(kind)
        if answerer is None and kind not in plan_transfer.KINDS:
            return []
        # TIMESYNC and PING without a target are for everyone.
        system_id = getattr(m, 'target_system', 0)
        component_id = getattr(m, 'target_component', 0)
        if component_id not in (0, _AUTOPILOT):
            return []
        if system_id == 0:
            addressed = list(vehicles.values())
        else:
            addressed = [vehicles[system_id]] if system_id in vehicles else []
        out: list[bytes] = []
        for vehicle in addressed:
            sequence = link.sequence(vehicle.system_id)
            if answerer is not None:
                out.extend(answerer(m, sender, vehicle, sequence, may_change))
                continue
            answers = plan_transfer.answer(m, kind, sender, vehicle, link.uploads, may_change)
            out.extend(sequence.encode(message) for message in answers)
        return out

    def request(
        self, vehicle: Vehicle, request: Request, link: Link, out: list[bytes]
    ) -> Answer | None:
        """Answer a command that asks for messages; None when it is another command."""
        command = request.command
        sequence = link.sequence(vehicle.system_id)
        if command == _REQUEST_CAPABILITIES:
            out.append(sequence.encode(ON_REQUEST[_VERSION_ID](vehicle)))
            return ACCEPTED
        if command not in (_REQUEST_MESSAGE, _SET_INTERVAL, _GET_INTERVAL):
            return None
        message_id = whole(request.p1)
        if message_id is None:
            return Answer(Result.DENIED, 'Message id expected')
        if command == _REQUEST_MESSAGE:
            builder = ON_REQUEST.get(message_id)
            if builder is None:
                return Answer(Result.UNSUPPORTED)
            out.append(sequence.encode(builder(vehicle)))
            return ACCEPTED
        if message_id not in STREAMS:
            return Answer(Result.UNSUPPORTED)
        if command == _SET_INTERVAL:
            interval_us = request.p2
            if not -1.0 <= interval_us <= 1e9:
                return Answer(Result.DENIED, 'Interval expected')
            # Source: MAVLink common.xml: -1 disable, 0 default rate.
            interval_s = None if interval_us == 0.0 else max(interval_us, 0.0) * 1e-6
            link.set_interval(vehicle.system_id, message_id, interval_s)
            return ACCEPTED
        interval_s = link.interval_s(vehicle.system_id, message_id)
        interval_us = round(interval_s * 1e6) if interval_s > 0.0 else -1
        message = mavlink.MAVLink_message_interval_message(message_id, interval_us)
        out.append(sequence.encode(message))
        return ACCEPTED

    def text(self, sequence: Sequence, text: str) -> bytes:
        """Return a STATUSTEXT frame (the text is cut at 50 bytes)."""
        message = mavlink.MAVLink_statustext_message(
            mavlink.MAV_SEVERITY_WARNING, text.encode('ascii', 'replace')[:50]
        )
        return sequence.encode(message)

    def _value(self, vehicle: Vehicle, index: int, sequence: Sequence) -> bytes:
        row = PARAMETERS[index]
        value = get_parameter(vehicle.autopilot.settings, row)
        message = mavlink.MAVLink_param_value_message(
            row.name.encode('ascii'),
            _bytewise(int(value)) if row.whole else value,
            _TYPES[row.whole],
            len(PARAMETERS),
            index,
        )
        return sequence.encode(message)

    def _list(
        self, m: Any, sender: Sender, vehicle: Vehicle, sequence: Sequence, may_change: bool
    ) -> list[bytes]:
        del m, sender, may_change
        return [self._value(vehicle, index, sequence) for index in range(len(PARAMETERS))]

    def _index(self, param_id: Any) -> int | None:
        name = param_id if isinstance(param_id, str) else param_id.decode('ascii', 'replace')
        return PARAMETER_INDEX.get(name.rstrip('\0'))

    def _read(
        self, m: Any, sender: Sender, vehicle: Vehicle, sequence: Sequence, may_change: bool
    ) -> list[bytes]:
        del sender, may_change
        index = m.param_index if m.param_index >= 0 else self._index(m.param_id)
        if index is None or index >= len(PARAMETERS):
            return [self.text(sequence, 'Unknown parameter')]
        return [self._value(vehicle, index, sequence)]

    def _set(
        self, m: Any, sender: Sender, vehicle: Vehicle, sequence: Sequence, may_change: bool
    ) -> list[bytes]:
        del sender
        index = self._index(m.param_id)
        if index is None:
            return [self.text(sequence, 'Unknown parameter')]
        refusal: list[bytes] = []
        taken = (
            may_change
            and m.param_type == _TYPES[PARAMETERS[index].whole]
            and set_parameter(vehicle.autopilot.settings, PARAMETERS[index], _value_of(m))
        )
        if not taken:
            refusal = [self.text(sequence, f'{PARAMETERS[index].name} not set')]
        # Always answered with the value that holds now.
        return [self._value(vehicle, index, sequence), *refusal]

    def _timesync(
        self, m: Any, sender: Sender, vehicle: Vehicle, sequence: Sequence, may_change: bool
    ) -> list[bytes]:
        del sender, may_change
        if m.tc1 != 0:
            # An answer to a question that this simulator never asks.
            return []
        now_ns = int((vehicle.autopilot.time_s + vehicle.since_step_s) * 1e9 + 0.5)
        return [sequence.encode(mavlink.MAVLink_timesync_message(now_ns, m.ts1))]

    def _ping(
        self, m: Any, sender: Sender, vehicle: Vehicle, sequence: Sequence, may_change: bool
    ) -> list[bytes]:
        del vehicle, may_change
        if m.target_system != 0:
            return []
        return [sequence.encode(mavlink.MAVLink_ping_message(m.time_usec, m.seq, *sender))]
