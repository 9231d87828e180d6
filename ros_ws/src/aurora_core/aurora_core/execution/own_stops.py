# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who stops by itself, at its place or on its walk: that it stands there is the event."""

from __future__ import annotations

from aurora_core.execution.observe import Observation
from aurora_core.execution.untold import on_the_move_mps
from aurora_core.spec.scenario import AgentAction, Event
from aurora_core.trace.roster import Roster


class OwnStops:
    """Stops of those who stop by themselves.

    Args:
        roster: Row order.
        rows: Of the agents that do.
        stop_mps: Slower than this somebody stands.
    """

    def __init__(self, roster: Roster, rows: frozenset[int], stop_mps: float) -> None:
        self._roster = roster
        self._rows = rows
        self._stop_mps = stop_mps
        self._moved: set[int] = set()

    def on_foot(self, event: Event, seen: Observation) -> bool:
        """Tell whether an event is such a stop of a person.

        Whether that has walked before is noted, though nobody may look yet.
        """
        row = self._row(event)
        if row is None or not self._roster.agents[row].is_person:
            return False
        self._note(row, seen)
        return True

    def stands(self, event: Event, seen: Observation) -> bool | None:
        """Tell whether somebody stands after having moved; None: it is no such stop."""
        row = self._row(event)
        if row is None:
            return None
        self._note(row, seen)
        speed_mps = seen.speed_mps(self._roster.agents[row].body_id)
        return speed_mps is not None and row in self._moved and speed_mps < self._stop_mps

    def _row(self, event: Event) -> int | None:
        action = event.action
        if not isinstance(action, AgentAction) or action.do != 'stop':
            return None
        row = self._roster.agent_index(action.agent)
        return row if row in self._rows else None

    def _note(self, row: int, seen: Observation) -> None:
        agent = self._roster.agents[row]
        speed_mps = seen.speed_mps(agent.body_id)
        if speed_mps is not None and speed_mps >= on_the_move_mps(is_person=agent.is_person):
            self._moved.add(row)
