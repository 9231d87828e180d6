# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Packed states and UAV commands: rows of `trace.layout` to `float64[]` without a loop.

Reading is `aurora_core.trace.messages.read_rows`, which copies nothing either.
"""

from __future__ import annotations

from array import array

import numpy as np
import numpy.typing as npt

from aurora_core.errors import ExecutionError
from aurora_msgs.msg import GroundState, UavCommand, UavState
from aurora_ros.conversions.time import header

FloatArray = npt.NDArray[np.float64]


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


def ground_state(run_number: int, tick: int, dt_s: float, rows: FloatArray) -> GroundState:
    """Return the message of all ground agents at a tick; rows (N, GROUND_WIDTH)."""
    return GroundState(
        header=header(tick, dt_s), run_number=run_number, tick=tick, data=pack(rows)
    )


def uav_state(run_number: int, tick: int, dt_s: float, rows: FloatArray) -> UavState:
    """Return the message of all UAVs at a tick; rows (M, UAV_WIDTH)."""
    return UavState(header=header(tick, dt_s), run_number=run_number, tick=tick, data=pack(rows))


def uav_command(run_number: int, tick: int, dt_s: float, rows: FloatArray) -> UavCommand:
    """Return the commands for a tick; rows (M, UAV_COMMAND_WIDTH)."""
    return UavCommand(header=header(tick, dt_s), run_number=run_number, tick=tick, data=pack(rows))
