# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Packed states and UAV commands: rows of `trace.layout` to `float64[]` without a loop.

Reading is `aurora_core.trace.messages.read_rows`, which copies nothing either.
"""

from __future__ import annotations

from array import array
from typing import Generic, TypeVar

import numpy as np
import numpy.typing as npt

from aurora_core.errors import ExecutionError
from aurora_msgs.msg import GroundState, UavCommand, UavState
from aurora_ros.conversions.time import header, restamp

FloatArray = npt.NDArray[np.float64]
_Message = TypeVar('_Message', GroundState, UavState, UavCommand)


def pack(rows: FloatArray) -> array[float]:
    """Return the values of a (N, W) array row by row."""
    return array('d', np.ascontiguousarray(rows, dtype=np.float64).tobytes())


def unpack(data: array[float], width: int, what: str) -> FloatArray:
    """Return the (N, width) array of a message's data; it shares the message's memory.

    Raises:
        ExecutionError: The length is not a multiple of the width.
    """
    flat = np.frombuffer(data, dtype=np.float64)
    if flat.size % width:
        raise ExecutionError(f'{what}: expected rows of {width}, found {flat.size} values')
    return flat.reshape(-1, width)


class Rows(Generic[_Message]):
    """The message of packed rows of one run, filled anew for each tick.

    Making a message takes as long as sending it does; what was published is gone by then.

    Args:
        kind: GroundState, UavState or UavCommand.
        run_number: Stamp of the run.
        dt_s: Time step.
    """

    def __init__(self, kind: type[_Message], run_number: int, dt_s: float) -> None:
        self._message = kind(header=header(0, dt_s), run_number=run_number)
        self._dt_s = dt_s

    def at(self, tick: int, rows: FloatArray) -> _Message:
        """Return the message of a tick with rows (N, W); it is the same object each time."""
        restamp(self._message, tick, self._dt_s)
        self._message.data = pack(rows)
        return self._message
