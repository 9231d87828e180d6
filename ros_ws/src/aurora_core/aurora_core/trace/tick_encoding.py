# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""CDR of the messages of every tick, packed in one go.

Building a message value and walking through its fields costs ten times what packing does. The
result is the same to the byte; that is proven against the .msg definitions for each encoder, so
that they stay the only source of every layout.
"""

from __future__ import annotations

import struct

import numpy as np
import numpy.typing as npt

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.messages import TOPICS, MessageBuilder, time_ns

FloatArray = npt.NDArray[np.float64]

_FRAME = b'map\0'
_LITTLE_ENDIAN = b'\x00\x01\x00\x00'
# Encapsulation, stamp, length and text of the frame id, run number, tick.
_HEAD = struct.Struct('<4siII4sQQ')
# The same, then the number of float64 values, which begin on a multiple of 8.
_ROWS_HEAD = struct.Struct('<4siII4sQQI4x')
_PROOF_TICK = 1234567


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
        self._no_commands = self._ground_commands(0, ())[_HEAD.size :]
        self._prove()

    def rows(self, topic: str, tick: int, rows: FloatArray) -> bytes:
        """Return the CDR of a GroundState, UavState or UavCommand."""
        if rows.size == 0:  # nothing follows the count then, not even padding
            return self._rows(topic, tick, rows)
        data = rows.tobytes()
        seconds, nanoseconds = divmod(time_ns(tick, self._dt), 1_000_000_000)
        head = _ROWS_HEAD.pack(
            _LITTLE_ENDIAN, seconds, nanoseconds, len(_FRAME), _FRAME, self._run, tick, rows.size
        )
        return head + data

    def ground_commands(self, tick: int, commands: tuple[GroundCommand, ...]) -> bytes:
        """Return the CDR of a GroundCommand."""
        if commands:
            return self._ground_commands(tick, commands)
        seconds, nanoseconds = divmod(time_ns(tick, self._dt), 1_000_000_000)
        head = _HEAD.pack(
            _LITTLE_ENDIAN, seconds, nanoseconds, len(_FRAME), _FRAME, self._run, tick
        )
        return head + self._no_commands

    def _rows(self, topic: str, tick: int, rows: FloatArray) -> bytes:
        return self._definitions.encode(TOPICS[topic], self._build.state(topic, tick, rows))

    def _ground_commands(self, tick: int, commands: tuple[GroundCommand, ...]) -> bytes:
        message = self._build.ground_commands(tick, commands)
        return self._definitions.encode(TOPICS[messages.GROUND_COMMAND], message)

    def _prove(self) -> None:
        """Compare with the definitions once."""
        rows = np.array([[1.5, -2.25, 3.125]])
        for topic in (messages.GROUND_STATE, messages.UAV_STATE, messages.UAV_COMMAND):
            if self.rows(topic, _PROOF_TICK, rows) != self._rows(topic, _PROOF_TICK, rows):
                raise _changed(topic)
        empty = self.ground_commands(_PROOF_TICK, ())
        if empty != self._ground_commands(_PROOF_TICK, ()):
            raise _changed(messages.GROUND_COMMAND)


def _changed(topic: str) -> BagError:
    return BagError(
        f'{TOPICS[topic]}.msg has another layout than the tick path packs',
        hint='bring aurora_core/trace/tick_encoding.py in line with the .msg file',
    )
