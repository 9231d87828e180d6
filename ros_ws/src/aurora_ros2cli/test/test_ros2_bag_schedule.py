# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When what of a bag is played."""

from __future__ import annotations

import math

from aurora_ros2cli.bag.schedule import Payload, Schedule, schedule

S = 1_000_000_000
MESSAGES: list[tuple[int, Payload]] = [
    (10 * S, (1, b'a')),
    (11 * S, (2, b'b')),
    (13 * S, (1, b'c')),
]


def played(what: Schedule) -> list[tuple[float, bytes | None]]:
    """Return when each thing is due on a clock that stands still."""
    return [
        (round(step.due_s, 6), None if step.message is None else step.message[1])
        for step in schedule(MESSAGES, what, now=lambda: 100.0)
    ]


def test_the_rate_divides_the_waits() -> None:
    plain = Schedule(start_ns=10 * S, end_ns=None, rate=1.0, clock_hz=0.0)
    fast = Schedule(start_ns=10 * S, end_ns=None, rate=4.0, clock_hz=0.0)

    assert played(plain) == [(0.0, b'a'), (1.0, b'b'), (3.0, b'c')]
    assert played(fast) == [(0.0, b'a'), (0.25, b'b'), (0.75, b'c')]


def test_a_part_of_the_bag() -> None:
    part = Schedule(start_ns=10 * S + 1, end_ns=12 * S, rate=1.0, clock_hz=0.0)

    assert played(part) == [(1.0, b'b')]


def test_the_clock_ticks_in_wall_time_before_the_messages() -> None:
    clocked = Schedule(start_ns=10 * S, end_ns=None, rate=2.0, clock_hz=2.0)

    assert played(clocked) == [
        (0.0, None), (0.0, b'a'), (0.5, None), (0.5, b'b'), (1.0, None), (1.5, None), (1.5, b'c'),
    ]  # fmt: skip


def test_late_steps_are_not_held_back() -> None:
    now_s = iter([0.0, 0.0, 5.0, 5.0])
    what = Schedule(start_ns=10 * S, end_ns=None, rate=1.0, clock_hz=0.0)

    waits = [step.due_s for step in schedule(MESSAGES, what, now=lambda: next(now_s))]

    assert math.isclose(waits[1], -4.0)
