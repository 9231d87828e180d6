# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recorded run as arrays: what the monitor judges and the hash covers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
import numpy.typing as npt

from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.records import EventRecord, LinkRecord, SightRecord
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]


class Integrity(StrEnum):
    """State of a recording, apart from its margins."""

    INTACT = 'intact'
    ALTERED = 'altered'
    TRUNCATED = 'truncated'
    UNKNOWN = 'unknown'


@dataclass(frozen=True, slots=True, kw_only=True)
class Trace:
    """States and commands of ticks 0..T-1 and the executor's claims.

    Attributes:
        roster: Row order of the arrays.
        ground: (T, N, GROUND_WIDTH), ENU map frame, SI.
        uav: (T, M, UAV_WIDTH).
        uav_commands: (T, M, UAV_COMMAND_WIDTH); row k was applied to reach tick k; row 0 is zero.
        ground_commands: T tuples; element k was applied to reach tick k; element 0 is empty.
        links: Message ledger ordered by sequence.
        sights: Sight claims ordered by tick, observer, target.
        events: Scenario events ordered by sequence.
        missing_ticks: Ticks without a complete set of states (their rows are NaN).
        integrity: State of the recording.
        integrity_note: What is damaged, for people.
    """

    roster: Roster
    ground: FloatArray
    uav: FloatArray
    uav_commands: FloatArray
    ground_commands: tuple[tuple[GroundCommand, ...], ...]
    links: tuple[LinkRecord, ...] = ()
    sights: tuple[SightRecord, ...] = ()
    events: tuple[EventRecord, ...] = ()
    missing_ticks: tuple[int, ...] = ()
    integrity: Integrity = Integrity.INTACT
    integrity_note: str = ''

    @property
    def ticks(self) -> int:
        """Number of samples T (the last tick is T - 1)."""
        return int(self.uav.shape[0])

    def time_s(self, tick: int) -> float:
        """Return the simulated time of a tick."""
        return tick * self.roster.dt_s

    def states(self, start: int, stop: int) -> Trace:
        """Return the states and commands of the ticks [start, stop), without the claims."""
        return replace(
            self,
            ground=self.ground[start:stop],
            uav=self.uav[start:stop],
            uav_commands=self.uav_commands[start:stop],
            ground_commands=self.ground_commands[start:stop],
            links=(),
            sights=(),
            events=(),
        )
