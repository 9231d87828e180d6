# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The trace of a local run while it happens: what the bag gets, without reading it back."""

from __future__ import annotations

from operator import attrgetter

import numpy as np

from aurora_core.execution.step_output import StepOutput
from aurora_core.ports.simulators import FloatArray
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UAV_WIDTH
from aurora_core.trace.records import EventRecord, LinkRecord, SightRecord
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import Trace


class TraceCollector:
    """Collects the ticks of one run in order.

    Args:
        roster: Row order.
    """

    def __init__(self, roster: Roster) -> None:
        self._roster = roster
        self._ground: list[FloatArray] = []
        self._uav: list[FloatArray] = []
        # What was applied to reach each tick: nothing to reach the first.
        self._ground_commands: list[tuple[GroundCommand, ...]] = [()]
        self._uav_commands: list[FloatArray] = [np.zeros((len(roster.uavs), UAV_COMMAND_WIDTH))]
        self._links: list[LinkRecord] = []
        self._sights: list[SightRecord] = []
        self._events: list[EventRecord] = []

    def add(self, ground: FloatArray, uav: FloatArray, output: StepOutput) -> None:
        """Take the states of the next tick and what the executor made of them.

        The arrays are kept, so they must not change afterwards.
        """
        self._ground.append(ground)
        self._uav.append(uav)
        self._ground_commands.append(output.ground_commands)
        self._uav_commands.append(output.uav_commands)
        self._links += output.links
        self._sights += output.sights
        self._events += output.events

    def trace(self) -> Trace:
        """Return the run so far; the commands of the last step were not applied any more."""
        ticks = len(self._ground)
        return Trace(
            roster=self._roster,
            ground=np.array(self._ground),
            uav=np.array(self._uav).reshape(ticks, len(self._roster.uavs), UAV_WIDTH),
            uav_commands=np.array(self._uav_commands[:ticks]),
            ground_commands=tuple(self._ground_commands[:ticks]),
            links=tuple(sorted(self._links, key=attrgetter('sequence'))),
            sights=tuple(sorted(self._sights, key=attrgetter('tick', 'observer', 'target'))),
            events=tuple(sorted(self._events, key=attrgetter('sequence'))),
        )
