# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a participant waits for before it may advance: the tick and what is stamped for it."""

from __future__ import annotations

from typing import Generic, TypeVar

from aurora_core.errors import ExecutionError

_T = TypeVar('_T')


class LockstepInput(Generic[_T]):
    """Pairs Tick(k) with the input stamped k, in order, for one run.

    "The last state it has" is never used: every input carries run and tick, another run's is
    ignored, a lost tick is an error.

    Args:
        component: Node that owns it, named in errors.
        first_needs_input: False when tick 0 comes without one (the spawned state).
    """

    def __init__(self, component: str, *, first_needs_input: bool) -> None:
        self._component = component
        self._first_needs_input = first_needs_input
        self._run_number: int | None = None
        self._next = 0
        self._ticked = False
        self._inputs: dict[int, _T] = {}

    @property
    def run_number(self) -> int | None:
        """The run that is served, None between runs."""
        return self._run_number

    @property
    def lacks_tick(self) -> bool:
        """Whether the next tick has not begun; else its input is what is missing."""
        return not self._ticked

    def arm(self, run_number: int) -> None:
        """Begin with tick 0 of a run and forget everything before."""
        self._run_number = run_number
        self._next = 0
        self._ticked = False
        self._inputs.clear()

    def disarm(self) -> None:
        """Ignore everything until the next `arm`."""
        self._run_number = None
        self._inputs.clear()

    def tick(self, run_number: int, tick: int) -> None:
        """Take in Tick(k); a repeated one is ignored.

        Raises:
            ExecutionError: A tick was lost.
        """
        if run_number != self._run_number or tick < self._next:
            return
        if tick > self._next:
            raise ExecutionError(
                f'expected tick {self._next}, found tick {tick}: a tick was lost or overtook',
                component=self._component,
            )
        self._ticked = True

    def put(self, run_number: int, tick: int, value: _T) -> None:
        """Take in the input stamped `tick`; another run's or an old one is ignored."""
        if run_number == self._run_number and tick >= self._next:
            self._inputs[tick] = value

    def take(self) -> tuple[int, _T | None] | None:
        """Return tick and input once both are there and go on to the next tick, else None."""
        if self._run_number is None or not self._ticked:
            return None
        tick = self._next
        needs_input = tick > 0 or self._first_needs_input
        if needs_input and tick not in self._inputs:
            return None
        self._next = tick + 1
        self._ticked = False
        return tick, self._inputs.pop(tick, None)
