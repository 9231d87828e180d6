# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Requested and realised values side by side, measured on the grounded geometry."""

from __future__ import annotations

from aurora_core.geometry.kernel import norm2
from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.grounded import GroundedAgent, RealisedValue
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec


def realised_values(
    spec: ScenarioSpec, agents: tuple[GroundedAgent, ...], uavs: tuple[UavPlan, ...]
) -> tuple[RealisedValue, ...]:
    """Return the realised value of placement distances, altitudes, standoffs, moved durations."""
    by_id = {a.id: a for a in agents}
    rows: list[RealisedValue] = []

    def add(path: str, parameter: Parameter, realised: float) -> None:
        rows.append(
            RealisedValue(
                path=path,
                requested=parameter.value,
                realised=realised,
                provenance=parameter.provenance,
            )
        )

    for agent in spec.agents:
        for k, placement in enumerate(agent.placements):
            other = by_id.get(placement.of or '')
            own = by_id.get(agent.id)
            if placement.distance_m is None or other is None or own is None:
                continue
            distance = norm2(own.x_m - other.x_m, own.y_m - other.y_m)
            add(f'agents/{agent.id}/placements/{k}/distance_m', placement.distance_m, distance)
    plans = {p.id: p for uav in uavs for p in uav.missions}
    for mission in spec.missions:
        plan = plans.get(mission.id)
        if plan is None:
            continue
        add(f'missions/{mission.id}/altitude_m', mission.altitude_m, plan.altitude_m)
        if mission.standoff_m is not None:
            add(f'missions/{mission.id}/standoff_m', mission.standoff_m, plan.standoff_m)
        lasts, plan_s = mission.duration_s, plan.duration_s
        if lasts is not None and plan_s is not None and plan_s != lasts.value:
            add(f'missions/{mission.id}/duration_s', lasts, plan_s)
    return tuple(rows)
