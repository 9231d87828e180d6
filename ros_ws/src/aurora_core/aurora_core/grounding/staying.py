# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Hovers without a place after another mission: nobody knows before the run where they are."""

from __future__ import annotations

from math import inf

from aurora_core.grounding.planned_flight import PlannedFlight
from aurora_core.knowledge.limits import Limits, Tolerances, rest_mps
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.flight_order import keeps_altitude
from aurora_core.spec.scenario import ScenarioSpec, UavMission


def staying(
    spec: ScenarioSpec,
    mission: UavMission,
    plan: MissionPlan,
    limits: Limits,
    tolerances: Tolerances,
) -> PlannedFlight:
    """Return a hover where its UAV is then: it is as clear as what leads there.

    Args:
        spec: The request.
        mission: The hover.
        plan: What it is planned as, without a point.
        limits: Limits in force.
        tolerances: Tolerances in force.
    """
    rests = {
        'rest_mps': rest_mps(spec.world, limits, tolerances),
        'keeps_level': keeps_altitude(spec, mission),
    }
    held = plan.model_copy(update=rests)
    return PlannedFlight(plan=held, clearance_m=inf, seen=1.0, over_street=0.0)
