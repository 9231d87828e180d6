# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What one step of the executor gives: commands for the next tick and records of this one."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.records import EventRecord, LinkRecord, SightRecord

FloatArray = npt.NDArray[np.float64]


class StepOutput(NamedTuple):
    """Output of `ScenarioExecutor.step(k, ...)`.

    Attributes:
        ground_commands: For tick k + 1.
        uav_commands: (M, UAV_COMMAND_WIDTH) for tick k + 1.
        links: Ledger entries of tick k.
        sights: Sight claims of tick k.
        events: Scenario events of tick k.
        finished: The scenario ends with tick k; no further tick is needed.
        outcome: `finished` (all done) or `horizon` when finished, else ''.
    """

    ground_commands: tuple[GroundCommand, ...]
    uav_commands: FloatArray
    links: tuple[LinkRecord, ...] = ()
    sights: tuple[SightRecord, ...] = ()
    events: tuple[EventRecord, ...] = ()
    finished: bool = False
    outcome: str = ''


class Stepper(Protocol):
    """What an engine drives: the executor itself, or the executor behind injected faults."""

    def step(self, tick: int, ground: FloatArray, uav: FloatArray) -> StepOutput:
        """Take the states of `tick`, give the commands for the next."""
