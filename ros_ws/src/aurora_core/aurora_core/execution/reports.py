# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Reports that a body sends by itself, so many per second: nothing has to happen for them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import ceil

from aurora_core.comm.link import MessageLink
from aurora_core.mission.machine import MissionMachine


class Reports:
    """The streams of one run: UAVs from their ascent to their way home, others while one flies.

    Args:
        links: All links of the run; those without a rate are left alone.
        dt_s: Time step.
        next_number: Gives the number of the next message of the run.
    """

    def __init__(
        self, links: Sequence[MessageLink], dt_s: float, next_number: Callable[[], int]
    ) -> None:
        self._links = [link for link in links if link.settings.rate_hz is not None]
        self._dt = dt_s
        self._next_number = next_number
        self._since: dict[str, int] = {}
        self._sent: dict[str, int] = {}

    def step(self, tick: int, machines: Sequence[MissionMachine]) -> None:
        """Hand the reports that are due at a tick to their links."""
        for link in self._links:
            if not _reports(link.settings.sender, machines):
                continue
            name, rate_hz = link.settings.link_id, link.settings.rate_hz or 0.0
            sent, since = self._sent.get(name, 0), self._since.setdefault(name, tick)
            if tick >= since + ceil(sent / (rate_hz * self._dt) - 1e-9):
                self._sent[name] = sent + 1
                link.send(tick, self._next_number(), name)


def _reports(sender: str, machines: Sequence[MissionMachine]) -> bool:
    own = [m for m in machines if m.plan.id == sender]
    if own:
        return own[0].ascended_tick is not None and not own[0].missions_done
    return not machines or not all(m.missions_done for m in machines)
