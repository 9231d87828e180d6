# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a vehicle has to get before a traffic light may hold it."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf

from aurora_core.knowledge.route_path import RoutePath
from aurora_core.quantities.actions import FROM_MOTION
from aurora_core.spec.doing import dated_s
from aurora_core.spec.prohibitions import keeps_on
from aurora_core.spec.scenario import AgentAction, GroundAgent, ScenarioSpec

# Time that what is done on the move takes to show (s).
_SHOWS_S = 8.0

# When something is done that has no stated time (s).
_SOON_S = 20.0


def free_run_m(path: RoutePath, arc_m: float) -> float:
    """Return the way from a place on a route to its next signal, or to its end, in metres."""
    return next((s[0] for s in path.signals if s[0] >= arc_m), path.length_m) - arc_m


def needed_run_m(spec: ScenarioSpec, agent: GroundAgent, pace_mps: float) -> float:
    """Return how far a vehicle gets until it has done what it has to do on the move, in metres.

    Args:
        spec: The request.
        agent: The vehicle.
        pace_mps: How fast it drives.
    """
    times_s = [
        _SOON_S if (at_s := dated_s(spec, e)) is None else at_s
        for e in spec.events
        if isinstance(e.action, AgentAction)
        and e.action.agent == agent.id
        and e.action.do in FROM_MOTION
    ]
    if never_stops(spec, (agent,)):
        return inf
    return pace_mps * (max(times_s) + _SHOWS_S) if times_s else 0.0


def never_stops(spec: ScenarioSpec, agents: Iterable[GroundAgent]) -> bool:
    """Tell whether one of some vehicles must not stop or brake: it is on its way all the time."""
    return any(keeps_on(part, agent.id) for part in spec.prohibitions for agent in agents)
