# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is to drive or walk, and to stop later, has come a way before it stops.

"A truck drives 40 m ahead. When the truck stops, the ego stops": a truck that stops before it has
driven as far as a drive is judged by would break the first sentence with the second.
"""

from __future__ import annotations

from aurora_core.execution.observe import Observation
from aurora_core.grounding.places import has_point
from aurora_core.quantities.actions import FROM_MOTION
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, SpeedTrigger
from aurora_core.spec.vocabulary import BehaviorKind

_MOVES = frozenset({BehaviorKind.DRIVE, BehaviorKind.WALK})


class Ways:
    """Ways of the agents that are asked to move and whose motion an event ends.

    Args:
        spec: The request.
        least_m: Way after which an agent counts as having driven.
    """

    def __init__(self, spec: ScenarioSpec, least_m: float) -> None:
        stopped = {
            e.action.agent
            for e in spec.events
            if isinstance(e.action, AgentAction) and e.action.do in FROM_MOTION
        }
        stopped |= {
            e.trigger.who
            for e in spec.events
            if isinstance(e.trigger, SpeedTrigger) and e.trigger.on == 'speed_below'
        }
        self._least_m = least_m
        self._ways_m = {
            agent.id: 0.0
            for agent in spec.agents
            if agent.id in stopped and any(b.kind in _MOVES for b in agent.behaviors)
        }

    def step(self, dt_s: float, seen: Observation) -> None:
        """Add what everybody has driven in a tick."""
        for agent_id in self._ways_m:
            self._ways_m[agent_id] += (seen.speed_mps(agent_id) or 0.0) * dt_s

    def all_driven(self) -> bool:
        """Tell whether all of them have come far enough."""
        return all(way_m >= self._least_m for way_m in self._ways_m.values())


class Destinations:
    """Places where the request has agents go, or do something.

    Args:
        spec: The request.
        arrival_m: An agent this close to a place is there.
    """

    def __init__(self, spec: ScenarioSpec, arrival_m: float) -> None:
        self._arrival_m = arrival_m
        self._left = [
            (agent.id, b.target)
            for agent in spec.agents
            for b in agent.behaviors
            if has_point(b.target) and b.target is not None
        ]

    def step(self, seen: Observation) -> None:
        """Strike out who has arrived, and who is gone or never can."""
        if self._left:
            self._left = [one for one in self._left if self._is_away(seen, *one)]

    def all_reached(self) -> bool:
        """Tell whether everybody has been where it is to go."""
        return not self._left

    def _is_away(self, seen: Observation, agent: str, place: str) -> bool:
        away_m = seen.distance_m(agent, place, on_road=True)
        return away_m is not None and away_m > self._arrival_m
