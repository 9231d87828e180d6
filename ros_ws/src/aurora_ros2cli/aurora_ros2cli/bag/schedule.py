# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When each message of a bag is due, and the ticks of the clock between them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

_NS = 1_000_000_000

# Connection and bytes of a message.
Payload = tuple[int, bytes]


@dataclass(frozen=True, slots=True, kw_only=True)
class Schedule:
    """What is played.

    Attributes:
        start_ns: Time of the bag at which it begins.
        end_ns: Time of the bag at which it ends; None for the whole.
        rate: Times faster than recorded.
        clock_hz: Clock messages per second of wall time; 0 for none.
    """

    start_ns: int
    end_ns: int | None
    rate: float
    clock_hz: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Step:
    """One thing to publish.

    Attributes:
        due_s: How long to wait before it (s); negative when late.
        time_ns: Its time in the bag.
        message: What to publish; None for a clock message.
    """

    due_s: float
    time_ns: int
    message: Payload | None


def schedule(
    messages: Iterable[tuple[int, Payload]],
    what: Schedule,
    now: Callable[[], float] = time.monotonic,
) -> Iterator[Step]:
    """Yield what is to be published, in the order of time.

    Args:
        messages: Times in the bag (ns) with their payloads, in order.
        what: Part, rate and clock.
        now: Steady clock (s).
    """
    began_s = now()
    tick_ns = int(_NS / what.clock_hz * what.rate) if what.clock_hz else None
    next_tick_ns = what.start_ns

    def step(time_ns: int, message: Payload | None) -> Step:
        at_s = began_s + (time_ns - what.start_ns) / _NS / what.rate
        return Step(due_s=at_s - now(), time_ns=time_ns, message=message)

    for time_ns, payload in messages:
        if time_ns < what.start_ns:
            continue
        if what.end_ns is not None and time_ns > what.end_ns:
            return
        while tick_ns is not None and next_tick_ns <= time_ns:
            yield step(next_tick_ns, None)
            next_tick_ns += max(tick_ns, 1)
        yield step(time_ns, payload)
