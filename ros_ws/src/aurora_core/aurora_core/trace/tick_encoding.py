# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""CDR of the messages of every tick, packed and unpacked in one go.

Building a message value and walking through its fields costs ten times what packing does. The
result is the same to the byte; that is proven against the .msg definitions for each encoder and
decoder, so that they stay the only source of every layout.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.messages import TOPICS, MessageBuilder, time_ns

FloatArray = npt.NDArray[np.float64]

_FRAME = b'map\0'
_FRAME_ID = _FRAME[:-1].decode()
_LITTLE_ENDIAN = b'\x00\x01\x00\x00'
# Encapsulation, stamp, length and text of the frame id, run number, tick.
_HEAD = struct.Struct('<4siII4sQQ')
# Number of float64 values, which begin on a multiple of 8.
_COUNT = struct.Struct('<I4x')
_ROWS_HEAD = struct.Struct(_HEAD.format + 'I4x')
_PROOF_TICK = 1234567
_COMMAND_FIELDS = ('agent', 'kind', 'value', 'value2', 'text')
_ROW_TOPICS = (messages.GROUND_STATE, messages.UAV_STATE, messages.UAV_COMMAND)


class TickEncoder:
    """Encodes packed rows and ground commands of one run.

    Args:
        definitions: Layouts.
        run_number: Stamp of the run.
        dt_s: Time step.

    Raises:
        BagError: The .msg files say something else than what is packed here.
    """

    def __init__(self, definitions: MessageDefinitions, run_number: int, dt_s: float) -> None:
        self._definitions = definitions
        self._run = run_number
        self._dt = dt_s
        self._build = MessageBuilder(definitions, run_number, dt_s)
        # All messages of a tick begin alike.
        self._tick, self._head = -1, b''
        self._no_commands = self._ground_commands(0, ())[_HEAD.size :]
        self._prove()

    def rows(self, topic: str, tick: int, rows: FloatArray) -> bytes:
        """Return the CDR of a GroundState, UavState or UavCommand."""
        if rows.size == 0:  # nothing follows the count then, not even padding
            return self._rows(topic, tick, rows)
        head = self._head if tick == self._tick else self._head_of(tick)
        return head + _COUNT.pack(rows.size) + rows.tobytes()

    def ground_commands(self, tick: int, commands: tuple[GroundCommand, ...]) -> bytes:
        """Return the CDR of a GroundCommand."""
        if commands:
            return self._ground_commands(tick, commands)
        head = self._head if tick == self._tick else self._head_of(tick)
        return head + self._no_commands

    def _head_of(self, tick: int) -> bytes:
        seconds, nanoseconds = divmod(time_ns(tick, self._dt), 1_000_000_000)
        self._tick = tick
        self._head = _HEAD.pack(
            _LITTLE_ENDIAN, seconds, nanoseconds, len(_FRAME), _FRAME, self._run, tick
        )
        return self._head

    def _rows(self, topic: str, tick: int, rows: FloatArray) -> bytes:
        return self._definitions.encode(TOPICS[topic], self._build.state(topic, tick, rows))

    def _ground_commands(self, tick: int, commands: tuple[GroundCommand, ...]) -> bytes:
        message = self._build.ground_commands(tick, commands)
        return self._definitions.encode(TOPICS[messages.GROUND_COMMAND], message)

    def _prove(self) -> None:
        """Compare with the definitions once."""
        rows = np.array([[1.5, -2.25, 3.125]])
        for topic in _ROW_TOPICS:
            if self.rows(topic, _PROOF_TICK, rows) != self._rows(topic, _PROOF_TICK, rows):
                raise _changed(topic)
        empty = self.ground_commands(_PROOF_TICK, ())
        if empty != self._ground_commands(_PROOF_TICK, ()):
            raise _changed(messages.GROUND_COMMAND)


class TickDecoder:
    """Decodes messages; packed rows without walking through their fields.

    What is not as `TickEncoder` packs it is decoded field by field, with the errors of that.

    Args:
        definitions: Layouts.

    Raises:
        BagError: The .msg files say something else than what is unpacked here.
    """

    def __init__(self, definitions: MessageDefinitions) -> None:
        self._definitions = definitions
        self._create = definitions.create
        # All messages of a tick have one header.
        self._stamp, self._shared = (-1, -1), None
        self._rows_of = frozenset(TOPICS[topic] for topic in _ROW_TOPICS)
        encoder = TickEncoder(definitions, 1, 0.05)
        for topic in _ROW_TOPICS:
            cdr = encoder.rows(topic, _PROOF_TICK, np.array([[1.5, -2.25, 3.125]]))
            unpacked = self._rows(TOPICS[topic], cdr)
            if unpacked is None or definitions.encode(TOPICS[topic], unpacked) != cdr:
                raise _changed(topic)
        nothing = encoder.ground_commands(0, ())
        self._no_commands = nothing[_HEAD.size :]
        self._commands = TOPICS[messages.GROUND_COMMAND]
        empty = definitions.decode(self._commands, nothing)
        self._empty = {name: getattr(empty, name) for name in _COMMAND_FIELDS}

    def decode(self, type_name: str, cdr: bytes) -> Any:
        """Return the value of a message.

        Raises:
            SerdeError: The bytes hold no message of that type.
        """
        found = None
        if type_name in self._rows_of:
            found = self._rows(type_name, cdr)
        elif type_name == self._commands:
            found = self._nothing(cdr)
        return self._definitions.decode(type_name, cdr) if found is None else found

    def _rows(self, type_name: str, cdr: bytes) -> Any:
        """Return a message of rows, None when it is not packed as such."""
        if len(cdr) <= _ROWS_HEAD.size:
            return None
        order, seconds, nanoseconds, length, frame, run, tick, count = _ROWS_HEAD.unpack_from(cdr)
        whole = len(cdr) == _ROWS_HEAD.size + 8 * count
        if not whole or (order, length, frame) != (_LITTLE_ENDIAN, len(_FRAME), _FRAME):
            return None
        data = np.frombuffer(cdr, dtype='<f8', offset=_ROWS_HEAD.size).copy()
        header = self._header(seconds, nanoseconds)
        return self._create(type_name, header=header, run_number=run, tick=tick, data=data)

    def _nothing(self, cdr: bytes) -> Any:
        """Return a GroundCommand without commands, None where there are some."""
        if cdr[_HEAD.size :] != self._no_commands:
            return None
        order, seconds, nanoseconds, length, frame, run, tick = _HEAD.unpack_from(cdr)
        if (order, length, frame) != (_LITTLE_ENDIAN, len(_FRAME), _FRAME):
            return None
        header = self._header(seconds, nanoseconds)
        return self._create(
            self._commands, header=header, run_number=run, tick=tick, **self._empty
        )

    def _header(self, seconds: int, nanoseconds: int) -> Any:
        if self._stamp != (seconds, nanoseconds):
            stamp = self._create('builtin_interfaces/msg/Time', sec=seconds, nanosec=nanoseconds)
            header = self._create('std_msgs/msg/Header', stamp=stamp, frame_id=_FRAME_ID)
            self._stamp, self._shared = (seconds, nanoseconds), header
        return self._shared


def _changed(topic: str) -> BagError:
    return BagError(
        f'{TOPICS[topic]}.msg has another layout than the tick path packs',
        hint='bring aurora_core/trace/tick_encoding.py in line with the .msg file',
    )
