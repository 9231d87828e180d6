# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a UAV does of which nothing is said but that it sends, relays or is there: it hovers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

from aurora_core.parsing import values
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode


def hovering(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with a hover over the scene for every UAV without a mission.

    Args:
        spec: The request, whoever read it; returned as it is when every UAV has a mission.
    """
    flying = {mission.uav for mission in spec.missions}
    idle = [uav for uav in spec.uavs if uav.id not in flying]
    if not idle:
        return spec
    ids = _free_ids(spec)
    hovers = tuple(
        UavMission(
            id=next(ids),
            uav=uav.id,
            mode=MissionMode.HOVER,
            altitude_m=values.default('altitude'),
            duration_s=values.default('mission_duration'),
            span=uav.span,
        )
        for uav in idle
    )
    return ScenarioSpec.model_validate({**dict(spec), 'missions': (*spec.missions, *hovers)})


def _free_ids(spec: ScenarioSpec) -> Iterator[str]:
    parts = (
        *spec.agents, *spec.uavs, *spec.missions, *spec.links, *spec.events, *spec.conditions,
        *spec.orders, *spec.prohibitions,
    )  # fmt: skip
    taken = {part.id for part in parts}
    return (name for k in count(1) if (name := f'm{k}') not in taken)
