# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a participant waits for before it may advance: leave to begin, and its input."""

from __future__ import annotations

from typing import Generic, TypeVar

from aurora_core.errors import ExecutionError

_T = TypeVar('_T')


class LockstepInput(Generic[_T]):
    """Gives out the inputs of one run in order, each once the clock has granted its tick.

    "The last state it has" is never used: every input carries run and tick, another run's is
    ignored, and tick k waits for the input stamped k. The clock grants ticks ahead of time, so
    it is seldom what is waited for.

    Args:
        first_needs_input: False when tick 0 comes without one (the spawned state).
    """

    def __init__(self, *, first_needs_input: bool) -> None:
        self._first_needs_input = first_needs_input
        self._run_number: int | None = None
        self._next = 0
        self._granted = -1
        self._inputs: dict[int, _T] = {}

    @property
    def run_number(self) -> int | None:
        """The run that is served, None between runs."""
        return self._run_number

    @property
    def lacks_grant(self) -> bool:
        """Whether the next tick may not begin yet; else its input is what is missing."""
        return self._granted < self._next

    def arm(self, run_number: int) -> None:
        """Begin with tick 0 of a run and forget everything before."""
        self._run_number = run_number
        self._next = 0
        self._granted = -1
        self._inputs.clear()

    def disarm(self) -> None:
        """Ignore everything until the next `arm`."""
        self._run_number = None
        self._inputs.clear()

    def grant(self, run_number: int, tick: int) -> None:
        """Take in that every tick up to this one may begin; another run's is ignored."""
        if run_number == self._run_number and tick > self._granted:
            self._granted = tick

    def put(self, run_number: int, tick: int, value: _T) -> None:
        """Take in the input stamped `tick`; another run's or an old one is ignored.

        Raises:
            ExecutionError: Another one with that stamp is waiting already.
        """
        if run_number != self._run_number or tick < self._next:
            return
        if self._inputs.setdefault(tick, value) != value:
            raise ExecutionError(f'two inputs for tick {tick} that differ', component='network')

    def take(self) -> tuple[int, _T | None] | None:
        """Return tick and input once it may begin and its input is there, else None.

        The next call is about the next tick.
        """
        tick = self._next
        if self._run_number is None or self._granted < tick:
            return None
        needs_input = tick > 0 or self._first_needs_input
        if needs_input and tick not in self._inputs:
            return None
        self._next = tick + 1
        return tick, self._inputs.pop(tick, None)
