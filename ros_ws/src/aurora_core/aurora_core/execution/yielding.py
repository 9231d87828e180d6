# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who has stopped to let others pass, and when they have passed.

Another vehicle has passed when it is ahead; a person, when it has crossed the way.
"""

from __future__ import annotations

from collections.abc import Mapping

from aurora_core.execution.observe import Observation
from aurora_core.geometry.polyline import Polyline
from aurora_core.quantities.way_crossing import WayCrossing
from aurora_core.spec.own_events import let_cross
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.roster import Roster

# Who has let another one pass drives on when that is so far ahead, bumper to bumper (m).
DRIVES_ON_M = 5.0


class Yielding:
    """Those who let others pass.

    Args:
        spec: The request.
        roster: Row order, and the ways of who yields.
    """

    def __init__(self, spec: ScenarioSpec, roster: Roster) -> None:
        self._roster = roster
        self._waiting: dict[int, set[str]] = {}
        self._ways = dict(_ways(spec, roster))

    def note(self, row: int, other: str) -> None:
        """Note that the agent of a row has been told to let another one pass."""
        self._waiting.setdefault(row, set()).add(other)

    def passed(self, seen: Observation) -> list[int]:
        """Return whose others have all passed by now; each is said once."""
        if not self._ways and not self._waiting:
            return []
        for (row, other), way in self._ways.items():
            index = self._roster.agent_index(other)
            if not way.crossed and index is not None and seen.motion(other) is not None:
                own = seen.ground(row)[: GroundColumn.Y + 1].tolist()
                person = seen.ground(index)[: GroundColumn.Y + 1].tolist()
                way.step((own[0], own[1]), (person[0], person[1]))
        free = [
            row
            for row, others in self._waiting.items()
            if all(self._has_passed(row, other, seen) for other in others)
        ]
        for row in free:
            del self._waiting[row]
        return free

    def _has_passed(self, row: int, other: str, seen: Observation) -> bool:
        way = self._ways.get((row, other))
        return seen.ahead_m(row, other) >= DRIVES_ON_M if way is None else way.crossed


def _ways(spec: ScenarioSpec, roster: Roster) -> Mapping[tuple[int, str], WayCrossing]:
    """Return the ways of vehicles that let persons cross."""
    found = {}
    for agent, person in let_cross(spec):
        row = roster.agent_index(agent)
        if row is not None and roster.agent_index(person) is not None:
            line = Polyline(roster.agents[row].route_xy_m)
            found[row, person] = WayCrossing(line=line)
    return found
