# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reports: from when to when a body sends them, and how often."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count
from types import SimpleNamespace
from typing import Any

import pytest

from aurora_core.comm.link import LinkSettings, MessageLink
from aurora_core.comm.reach import Reach
from aurora_core.execution.reports import Reports
from aurora_core.ports.random_streams import stream

DT_S = 0.05


@dataclass
class _Machine:
    plan: Any
    ascended_tick: int | None = None
    missions_done: bool = False


def _sent(sender: str, rate_hz: float | None, ticks: int = 200) -> list[tuple[int, str]]:
    """Return (tick, label) of what is sent; uav1 is up at tick 40 and done at tick 120."""
    settings = LinkSettings(
        link_id='l1', sender=sender, receiver='ego', loss=0.0, latency_s=0.1, retransmissions=0,
        interval_s=0.2, reach=Reach(sight_m=500.0, blocked_m=200.0), rate_hz=rate_hz,
    )  # fmt: skip
    found: list[tuple[int, str]] = []
    link = MessageLink(settings, DT_S, stream(1, 'link:l1'))

    def send(tick: int, number: int, event: str) -> None:
        assert number == len(found) + 1
        found.append((tick, event))

    link.send = send  # type: ignore[method-assign]
    numbers = count(1)
    reports = Reports((link,), DT_S, lambda: next(numbers))
    machine = _Machine(plan=SimpleNamespace(id='uav1'))
    for tick in range(ticks):
        machine.ascended_tick = 40 if tick >= 40 else None
        machine.missions_done = tick >= 120
        reports.step(tick, (machine,))  # type: ignore[arg-type]
    return found


@pytest.mark.parametrize(
    ('sender', 'rate_hz', 'ticks'),
    [
        ('uav1', 1.0, [40, 60, 80, 100]),
        ('van1', 0.5, [0, 40, 80]),
        ('uav1', 3.0, [40, 47, 54, 60, 67, 74, 80, 87, 94, 100, 107, 114]),
        ('uav1', None, []),
    ],
)
def test_reports_go_out_while_there_is_something_to_report(
    sender: str, rate_hz: float | None, ticks: list[int]
) -> None:
    assert _sent(sender, rate_hz) == [(tick, 'l1') for tick in ticks]
