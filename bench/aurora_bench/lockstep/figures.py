# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is measured of one run, and medians with spread over repetitions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median
from typing import Literal

from pydantic import FiniteFloat

from aurora_core.document import Document

Engine = Literal['local', 'ros']

# Parts of the local engine; the processes of the graph carry their own names.
SUMO, AIR, EXECUTOR, RECORDER = 'sumo', 'air', 'executor', 'recorder'


class RunFigures(Document):
    """One run.

    Attributes:
        ticks: Tick 0 included.
        dt_s: Simulated time of a tick.
        load_s: From the order to execute to tick 0, wall.
        loop_s: From tick 0 to the end of the last tick, wall.
        close_s: From there to the answer (bag closed, read again, hashed), wall.
        cpu_s: CPU time of the loop, all processes together.
        parts_s: CPU time of the loop by part (local) or by process (ROS).
        sha256: Trace hash; empty for runs without a recorder.
        sumo_wall_s: Of the loop in SUMO: commands, step and state read, wall (local).
    """

    engine: Engine
    ticks: int
    dt_s: FiniteFloat
    load_s: FiniteFloat
    loop_s: FiniteFloat
    close_s: FiniteFloat
    cpu_s: FiniteFloat
    parts_s: Mapping[str, FiniteFloat]
    sha256: str = ''
    sumo_wall_s: FiniteFloat = 0.0

    @property
    def us_per_tick(self) -> float:
        """Wall time of a tick, microseconds."""
        return self.loop_s / self.ticks * 1e6

    @property
    def cpu_us_per_tick(self) -> float:
        """CPU time of a tick, microseconds."""
        return self.cpu_s / self.ticks * 1e6

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds per wall second of the tick loop."""
        return (self.ticks - 1) * self.dt_s / self.loop_s

    @property
    def over_sumo(self) -> float:
        """Tick over SUMO's step with its state read, both CPU time and of this run."""
        return self.cpu_s / self.parts_s[SUMO]

    @property
    def over_sumo_wall(self) -> float:
        """The same by the clock."""
        return self.loop_s / self.sumo_wall_s

    def part_us_per_tick(self, name: str) -> float:
        """CPU time of one part in a tick, microseconds."""
        return self.parts_s.get(name, 0.0) / self.ticks * 1e6


class Spread(Document):
    """Median, least and greatest of the repetitions."""

    median: FiniteFloat
    low: FiniteFloat
    high: FiniteFloat
    count: int


def spread(values: Sequence[float]) -> Spread:
    """Return median and extremes of at least one value."""
    return Spread(median=median(values), low=min(values), high=max(values), count=len(values))


class Measured(Document):
    """All repetitions of one configuration on one engine.

    Attributes:
        verify_s: Wall time of one verification of the last bag.
    """

    engine: Engine
    agents: int
    uavs: int
    seconds: int
    runs: tuple[RunFigures, ...]
    verify_s: FiniteFloat

    @property
    def real_time_factor(self) -> Spread:
        """Simulated seconds per wall second."""
        return spread([run.real_time_factor for run in self.runs])

    @property
    def us_per_tick(self) -> Spread:
        """Wall time of a tick, microseconds."""
        return spread([run.us_per_tick for run in self.runs])

    @property
    def cpu_us_per_tick(self) -> Spread:
        """CPU time of a tick, microseconds."""
        return spread([run.cpu_us_per_tick for run in self.runs])

    @property
    def hashes(self) -> frozenset[str]:
        """The different trace hashes."""
        return frozenset(run.sha256 for run in self.runs)

    def parts_us(self) -> dict[str, float]:
        """Median CPU time of each part in a tick, microseconds."""
        names = dict.fromkeys(name for run in self.runs for name in run.parts_s)
        return {name: median(run.part_us_per_tick(name) for run in self.runs) for name in names}

    def summary(self) -> dict[str, object]:
        """Return the medians as plain JSON values."""
        return {
            'real_time_factor': self.real_time_factor.model_dump(),
            'ticks_per_s': spread([1e6 / run.us_per_tick for run in self.runs]).model_dump(),
            'us_per_tick': self.us_per_tick.model_dump(),
            'cpu_us_per_tick': self.cpu_us_per_tick.model_dump(),
            'load_s': spread([run.load_s for run in self.runs]).model_dump(),
            'close_s': spread([run.close_s for run in self.runs]).model_dump(),
            'parts_us_per_tick': self.parts_us(),
            'verify_s': self.verify_s,
            'hashes': sorted(self.hashes),
        }
