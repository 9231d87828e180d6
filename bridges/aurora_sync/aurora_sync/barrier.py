# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`TickBarrier`: decides when which tick begins. Pure: no ROS, and the clock is an argument."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from types import MappingProxyType

from aurora_core.errors import AuroraError, ExecutionError, ParticipantSilentError

COMPONENT = 'sync'


class Phase(Enum):
    """State of the clock."""

    IDLE = 'idle'
    LOADED = 'loaded'
    RUNNING = 'running'
    FINISHED = 'finished'
    FAILED = 'failed'


@dataclass(frozen=True, slots=True, kw_only=True)
class BarrierLoad:
    """One run.

    Attributes:
        run_number: Stamp of everything that belongs to the run.
        last_tick: Hard end of the run (its horizon).
        participants: Each must finish each tick. The order is the order of dependence: of several
            silent ones the first is named, since the later ones wait for it.
        observers: Each must acknowledge ticks inside the credit window.
    """

    run_number: int
    last_tick: int
    participants: tuple[str, ...]
    observers: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class BarrierStatus:
    """What the outside sees of the clock.

    Attributes:
        tick: Last tick that was started.
        completed: Last tick that everybody finished, -1 before tick 0 is.
        error: Why the run failed.
    """

    phase: Phase = Phase.IDLE
    run_number: int = 0
    tick: int = 0
    completed: int = -1
    error: AuroraError | None = None


def tick_of_horizon(horizon_s: float, dt_s: float) -> int:
    """Return the last tick of a run.

    Raises:
        ExecutionError: Time step or horizon is not a positive number.
    """
    if not (dt_s > 0.0 and 0.0 < horizon_s < math.inf):
        raise ExecutionError(
            f'expected a positive time step and horizon, found {dt_s} s and {horizon_s} s',
            component=COMPONENT,
        )
    return round(horizon_s / dt_s)


class TickBarrier:
    """The lockstep of one run after another.

    Every method returns the tick to start now, or None. Times are steady seconds.

    Args:
        credit_ticks: How far the clock may be ahead of the slowest observer.
        own_credit_ticks: The same for observers that have less, by name.
        silence_limit_s: A run fails when nothing has moved for this long.
    """

    def __init__(
        self,
        *,
        credit_ticks: int,
        silence_limit_s: float,
        own_credit_ticks: Mapping[str, int] = MappingProxyType({}),
    ) -> None:
        self._credit_ticks = credit_ticks
        self._own_credit_ticks = own_credit_ticks
        self._silence_limit_s = silence_limit_s
        self._load = BarrierLoad(run_number=0, last_tick=0, participants=())
        self._status = BarrierStatus()
        self._missing: set[str] = set()
        self._acked: dict[str, int] = {}
        self._ending = False
        self._moved_at_s = 0.0

    @property
    def status(self) -> BarrierStatus:
        """State of the clock."""
        return self._status

    @property
    def granted(self) -> int:
        """Last tick that may begin without another word of the clock; -1 unless a run goes on.

        The participants keep the order among themselves, each by the inputs that it needs; the
        clock need only hold them back where an observer's credit ends.
        """
        if self._status.phase is not Phase.RUNNING:
            return -1
        return min([self._load.last_tick, *map(self._limit_of, self._acked)])

    def load(self, load: BarrierLoad) -> None:
        """Prepare a run; another one that is going on is given up.

        Raises:
            ExecutionError: The run is loaded already, there is nobody to wait for, or a name is
                there twice.
        """
        status = self._status
        going_on = status.phase in (Phase.LOADED, Phase.RUNNING)
        if going_on and load.run_number == status.run_number:
            raise ExecutionError(
                f'run {load.run_number} is loaded already: sync/load was called a second time',
                component=COMPONENT,
            )
        if not load.participants or load.last_tick < 0:
            raise ExecutionError(
                f'expected participants and a horizon, found {load.participants} and tick '
                f'{load.last_tick}',
                component=COMPONENT,
            )
        for names in (load.participants, load.observers):
            if len(set(names)) != len(names):
                raise ExecutionError(f'a name is there twice: {names}', component=COMPONENT)
        self._load = load
        self._missing = set()
        self._acked = dict.fromkeys(load.observers, -1)
        self._ending = False
        self._status = BarrierStatus(phase=Phase.LOADED, run_number=load.run_number)

    def start(self, run_number: int, now_s: float) -> int:
        """Begin with tick 0.

        Raises:
            ExecutionError: This run is not loaded.
        """
        if self._status.phase is not Phase.LOADED or run_number != self._load.run_number:
            raise ExecutionError(
                f'expected run {run_number} to be loaded, found {self._status.phase.value} '
                f'(run {self._load.run_number})',
                component=COMPONENT,
                hint='call sync/load first',
            )
        self._status = replace(self._status, phase=Phase.RUNNING)
        return self._begin(0, now_s)

    def stop(self, run_number: int) -> int:
        """End a run at any time and return the last tick that everybody finished (0 if none)."""
        if run_number == self._load.run_number:
            if self._status.phase in (Phase.LOADED, Phase.RUNNING):
                self._status = replace(self._status, phase=Phase.IDLE)
            return max(0, self._status.completed)
        return 0

    def done(
        self, run_number: int, tick: int, participant: str, finished: bool, now_s: float
    ) -> int | None:
        """Take in that a participant has finished a tick.

        A repeated or late word and one of another run or of a stranger are ignored; word of a
        tick that has not begun fails the run.
        """
        if not self._is_running(run_number) or tick < self._status.tick:
            return None
        if tick > self._status.tick:
            self.fail(
                ExecutionError(
                    f'{participant} finished tick {tick} before it began (the clock is at '
                    f'{self._status.tick})',
                    component=participant,
                )
            )
            return None
        if participant not in self._missing:
            return None
        self._missing.discard(participant)
        self._ending = self._ending or finished
        self._moved_at_s = now_s
        return self._advance(now_s)

    def acknowledge(self, run_number: int, observer: str, tick: int, now_s: float) -> int | None:
        """Take in that an observer has stored everything up to a tick."""
        if not self._is_running(run_number) or observer not in self._acked:
            return None
        if tick > self._acked[observer]:
            self._acked[observer] = tick
            self._moved_at_s = now_s
        return self._advance(now_s)

    def fault(self, run_number: int, error: AuroraError) -> None:
        """Take in that a component of the run broke."""
        if self._is_running(run_number) or (
            self._status.phase is Phase.LOADED and run_number == self._load.run_number
        ):
            self.fail(error)

    def fail(self, error: AuroraError) -> None:
        """End the run with an error."""
        self._status = replace(self._status, phase=Phase.FAILED, error=error)

    def check(self, now_s: float) -> None:
        """Fail the run when nothing has moved for too long, and name who is waited for."""
        if self._status.phase is not Phase.RUNNING:
            return
        silent_s = now_s - self._moved_at_s
        if silent_s <= self._silence_limit_s:
            return
        name, what = self._waited_for()
        self.fail(
            ParticipantSilentError(
                f'{name} did not {what} tick {self._status.tick} within '
                f'{self._silence_limit_s:g} s',
                component=name,
                hint=f'see the log of {name}',
            )
        )

    def _is_running(self, run_number: int) -> bool:
        return self._status.phase is Phase.RUNNING and run_number == self._load.run_number

    def _begin(self, tick: int, now_s: float) -> int:
        self._missing = set(self._load.participants)
        self._moved_at_s = now_s
        self._status = replace(self._status, tick=tick)
        return tick

    def _advance(self, now_s: float) -> int | None:
        """Go on to the next tick, to the end, or wait."""
        if self._missing:
            return None
        tick = self._status.tick
        if self._status.completed != tick:
            self._status = replace(self._status, completed=tick)
        if self._ending or tick >= self._load.last_tick:
            self._status = replace(self._status, phase=Phase.FINISHED)
            return None
        if any(self._limit_of(name) < tick + 1 for name in self._acked):
            return None
        return self._begin(tick + 1, now_s)

    def _limit_of(self, observer: str) -> int:
        """Return the last tick that may begin before an observer has acknowledged more."""
        credit = self._own_credit_ticks.get(observer, self._credit_ticks)
        return self._acked[observer] + credit

    def _waited_for(self) -> tuple[str, str]:
        for name in self._load.participants:
            if name in self._missing:
                return name, 'finish'
        slowest = min(self._load.observers, key=self._limit_of)
        return slowest, 'store the ticks before'
