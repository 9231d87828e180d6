# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How hard drivers brake: as an event says, never harder than the request allows."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.knowledge.limits import Tolerance
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.quantities.braking import commanded_mps2, most_mps2
from aurora_core.spec.scenario import AgentAction, ScenarioSpec
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind

# Deceleration of a commanded braking (m/s^2): above the 4 m/s^2 that "brake" asks for.
BRAKING_MPS2 = 6.0


class Braking:
    """Says how hard to brake.

    Args:
        spec: The request.
        agents: Row order.
        tolerance: On a stated deceleration.
    """

    def __init__(
        self, spec: ScenarioSpec, agents: Sequence[GroundedAgent], tolerance: Tolerance
    ) -> None:
        self._own = [agent.deceleration_mps2 for agent in agents]
        self._most = [most_mps2(spec, agent.id, tolerance) for agent in agents]
        self._tolerance = tolerance
        self._told: set[int] = set()

    def at_start(self) -> list[GroundCommand]:
        """Return the commands for those who must never brake harder than a number."""
        return [_command(row, most) for row, most in enumerate(self._most) if most is not None]

    def commands(self, row: int, action: AgentAction) -> list[GroundCommand]:
        """Return how hard to brake for an action that takes speed off.

        Args:
            row: Of the agent.
            action: What it is to do.
        """
        asked, most = action.deceleration_mps2, self._most[row]
        if asked is not None:
            self._told.add(row)
            return [_command(row, commanded_mps2(asked, self._tolerance))]
        if action.do == 'brake':
            value = BRAKING_MPS2
        elif row in self._told:
            value = self._own[row]
        else:
            return []
        return [_command(row, value if most is None else min(value, most))]


def _command(row: int, value: float) -> GroundCommand:
    return GroundCommand(agent=row, kind=GroundCommandKind.SET_DECELERATION, value=value)
