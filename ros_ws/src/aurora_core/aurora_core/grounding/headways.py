# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How vehicles drive that keep a stated time headway."""

from __future__ import annotations

from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec

# Gap to stand with (m).
_STANDS_M = 1.0
# So far inside a bound a headway is kept, by share and at least (s): who comes up from behind is
# faster than whom it follows, and nearer for that.
_INSIDE_SHARE = 0.25
_INSIDE_S = 0.3
# Nobody follows closer than this (s): the least reaction time of the simulator's drivers.
_LEAST_S = 0.05
_BOUNDS = {'>=': Bound.AT_LEAST, '>': Bound.AT_LEAST, '<=': Bound.AT_MOST, '<': Bound.AT_MOST}


def stated_headway(spec: ScenarioSpec, agent: GroundAgent) -> tuple[str, Parameter] | None:
    """Return behind whom a vehicle keeps which headway; None where nothing is stated."""
    for behavior in agent.behaviors:
        if behavior.headway_s is not None and behavior.target is not None:
            return behavior.target, behavior.headway_s
    for c in spec.conditions:
        if c.quantity == QuantityName.TIME_HEADWAY and c.of[0] == agent.id and len(c.of) > 1:
            bound = _BOUNDS.get(c.op, Bound.EXACTLY)
            return c.of[1], c.value.model_copy(update={'bound': bound})
    return None


def headway_style(
    asked: Parameter, own: AgentTypeRecord, other: AgentTypeRecord, pace_mps: float
) -> dict[str, float]:
    """Return how one drives that keeps a headway at a speed.

    Beside its time gap the simulator keeps the gap to stand with, and what the one behind needs
    longer to brake.

    Args:
        asked: Headway (s).
        own: Type of the one behind.
        other: Type of the one ahead.
        pace_mps: How fast they drive.
    """
    longer_s2pm = 1.0 / own.decel_mps2 - 1.0 / max(own.decel_mps2, other.decel_mps2)
    beside_s = _STANDS_M / pace_mps + longer_s2pm * pace_mps / 2.0
    inside_s = max(_INSIDE_S, _INSIDE_SHARE * asked.value)
    time_gap_s = asked.inside(inside_s) - beside_s
    return {'min_gap_m': _STANDS_M, 'time_gap_s': max(_LEAST_S, time_gap_s)}
