# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`StateJoin`: both states of one tick, in order. No ROS."""

from __future__ import annotations

from aurora_core.errors import ExecutionError
from aurora_core.trace.trace import FloatArray

COMPONENT = 'executor'


class StateJoin:
    """Collects the states of tick k until all of them are there.

    Args:
        run_number: States of another run are ignored.
        sources: Names of the states that each tick has.
    """

    def __init__(self, run_number: int, sources: tuple[str, ...]) -> None:
        self._run_number = run_number
        self._sources = sources
        self._latest_first = sources[::-1]
        self._next = 0
        self._rows: dict[str, FloatArray] = {}

    @property
    def missing(self) -> str:
        """A source whose next state has not come: of several, the one that came last before."""
        return next(source for source in self._latest_first if source not in self._rows)

    @property
    def lacking(self) -> tuple[str, ...]:
        """The sources whose next state has not come."""
        return tuple(source for source in self._sources if source not in self._rows)

    def put(
        self, source: str, run_number: int, tick: int, rows: FloatArray
    ) -> tuple[int, dict[str, FloatArray]] | None:
        """Take in a state; return the tick and its states once the last one has come.

        Raises:
            ExecutionError: A state was lost: the next one came instead.
        """
        if run_number != self._run_number or source not in self._sources or tick < self._next:
            return None
        if tick > self._next:
            raise ExecutionError(
                f'expected the {source} state of tick {self._next}, found tick {tick}',
                component=COMPONENT,
            )
        self._rows[source] = rows
        if len(self._rows) < len(self._sources):
            return None
        rows_by_source, self._rows = self._rows, {}
        self._latest_first = tuple(reversed(rows_by_source))
        self._next = tick + 1
        return tick, rows_by_source
