# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How fast a UAV flies at most: below a stated bound, and all it may after a fast target."""

from __future__ import annotations

from aurora_core.grounding.pace import least_bound_mps, stated_speed_mps
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.mission.plan import UavPlan
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode

# What is set stays so far below a bound, for gusts and corners (m/s).
_ROOM_MPS = 1.0
# Nobody flies a route more slowly, whatever is asked (m/s).
_LEAST_MPS = 0.2


def within_speeds(
    spec: ScenarioSpec, plan: UavPlan, limits: Limits, settings: GroundingSettings
) -> UavPlan:
    """Return a plan that is flown as fast as the request lets it, and has to.

    Args:
        spec: The request; its own numbers stay as they are.
        plan: Of one UAV.
        limits: Limits in force.
        settings: How fast a target may drive that is easily kept up with.
    """
    bound_mps = least_bound_mps(spec, plan.id)
    if bound_mps is not None:
        most_mps = max(bound_mps - _ROOM_MPS, bound_mps / 2.0, _LEAST_MPS)
        slower = tuple(
            m.model_copy(update={'speed_mps': min(m.speed_mps, most_mps)}) for m in plan.missions
        )
        return plan.model_copy(update={'speed_max_mps': most_mps, 'missions': slower})
    tracked = {m.target for m in plan.missions if m.mode is MissionMode.TRACK}
    fastest = [
        stated_speed_mps(spec, agent, settings.speeds) or 0.0
        for agent in spec.agents
        if agent.id in tracked
    ]
    if max(fastest, default=0.0) <= settings.speeds.trackable_mps:
        return plan
    return plan.model_copy(update={'speed_max_mps': limits.uav_speed_max_mps})
