# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LiveMargins`: publishes what a run can still become while it goes on. No ROS.

A preview for people: the verdict comes from the whole run, and from its bag. So it takes a tenth
of the node's time at most, and an error in it ends the preview, not the run.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from aurora_core.errors import AuroraError
from aurora_core.monitor.online import OnlineMonitor, Outlook
from aurora_core.trace.definitions import MessageDefinitions
from aurora_nodes.live_run import LiveRun
from aurora_nodes.live_trace import LiveScene, LiveTrace

# Time between two looks as a multiple of what the last one took.
_PAUSE = 9.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Preview:
    """Outlooks at one tick of a run.

    Attributes:
        run_number: Of the run.
        tick: Last tick that was looked at.
        end_s: Simulated time of it.
        scene: What the run is about.
        outlooks: One for each condition.
    """

    run_number: int
    tick: int
    end_s: float
    scene: LiveScene
    outlooks: tuple[Outlook, ...]


class LiveMargins:
    """Follows one run after the other.

    Args:
        definitions: Layouts of the messages.
        period_s: Wall-clock time between two looks, at least.
        lag_ticks: Claims of a tick may come this many ticks later than its states.
        wanted: Tells whether anybody listens; else nothing is worked out.
        publish: Called with each preview.
        complain: Called with the problem that ends the previews of a run.
        clock: Seconds of wall-clock time.
    """

    def __init__(
        self,
        definitions: MessageDefinitions,
        period_s: float,
        lag_ticks: int,
        wanted: Callable[[], bool],
        publish: Callable[[Preview], None],
        complain: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._definitions = definitions
        self._period_s = period_s
        self._lag = lag_ticks
        self._wanted = wanted
        self._publish = publish
        self._complain = complain
        self._clock = clock
        self._due_s = 0.0
        self._run: LiveRun | None = None
        self._trace: LiveTrace | None = None
        self._scene: LiveScene | None = None
        self._monitor: OnlineMonitor | None = None

    def begin(self, run: LiveRun) -> None:
        """Follow a run from now on."""
        self.end()
        self._run = run
        self._trace = LiveTrace(run, self._definitions)
        self._due_s = self._clock() + self._period_s

    def end(self) -> None:
        """Follow nothing."""
        self._run = self._trace = self._scene = self._monitor = None

    def look(self) -> None:
        """Take in what is complete and publish what it says, if that is due."""
        begun_s = self._clock()
        if self._run is None or begun_s < self._due_s or not self._wanted():
            return
        try:
            self._look(self._run)
        except AuroraError as err:
            self._complain(f'no margins while run {self._run.run_number} goes on: {err}')
            self.end()
        ended_s = self._clock()
        self._due_s = ended_s + max(self._period_s, _PAUSE * (ended_s - begun_s))

    def _look(self, run: LiveRun) -> None:
        assert self._trace is not None  # set with the run
        self._scene = self._scene or self._trace.scene()
        if self._scene is None:
            return
        part = self._trace.next_part(self._scene.roster, run.stored_tick + 1 - self._lag)
        if part is None:
            return
        if self._monitor is None:
            scene = self._scene
            self._monitor = OnlineMonitor(scene.world, scene.spec, scene.conditions, part)
        else:
            self._monitor.extend(part)
        tick = self._monitor.ticks - 1
        self._publish(
            Preview(
                run_number=run.run_number,
                tick=tick,
                end_s=part.time_s(tick),
                scene=self._scene,
                outlooks=self._monitor.outlooks(),
            )
        )
