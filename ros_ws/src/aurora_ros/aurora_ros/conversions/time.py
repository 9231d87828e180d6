# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Simulated time and headers."""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time
from std_msgs.msg import Header

from aurora_core.trace.messages import FRAME_ID, time_ns

_NANOSECONDS = 1_000_000_000


def stamp(tick: int, dt_s: float) -> Time:
    """Return simulated time k * dt."""
    nanoseconds = time_ns(tick, dt_s)
    return Time(sec=nanoseconds // _NANOSECONDS, nanosec=nanoseconds % _NANOSECONDS)


def header(tick: int, dt_s: float) -> Header:
    """Return the header of a message of a tick, in the map frame."""
    return Header(stamp=stamp(tick, dt_s), frame_id=FRAME_ID)


def restamp(message: Any, tick: int, dt_s: float) -> None:
    """Make a message that has a header and a tick one of another tick."""
    stamp = message.header.stamp
    stamp.sec, stamp.nanosec = divmod(time_ns(tick, dt_s), _NANOSECONDS)
    message.tick = tick
