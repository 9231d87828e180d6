# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Give several UAVs different altitudes, so that their ways never meet.

Only altitudes that the prompt does not state are moved: upwards, inside domain and limits.
"""

from __future__ import annotations

from aurora_core.knowledge.limits import Limits
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec, UavMission


def layered(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return the specification with the altitudes that its UAVs will fly at.

    Args:
        spec: The request; it is not changed.
        limits: Limits in force; layers are twice the separation apart.
    """
    step_m = 2.0 * limits.separation_min_m
    taken: dict[str, set[float]] = {}
    for mission in spec.missions:
        if mission.altitude_m.provenance is Provenance.EXPLICIT:
            taken.setdefault(mission.uav, set()).add(mission.altitude_m.value)
    missions = []
    for mission in spec.missions:
        others = [z for uav, used in taken.items() if uav != mission.uav for z in used]
        height_m = _free_height(mission, others, step_m, limits)
        taken.setdefault(mission.uav, set()).add(height_m)
        missions.append(_at(mission, height_m))
    return ScenarioSpec.model_validate({**spec.model_dump(), 'missions': missions})


def _free_height(mission: UavMission, others: list[float], step_m: float, limits: Limits) -> float:
    wanted = mission.altitude_m
    if wanted.provenance is Provenance.EXPLICIT:
        return wanted.value
    top = min(wanted.high, limits.uav_altitude_max_m)
    height_m = wanted.value
    while height_m <= top:
        if all(abs(height_m - z) >= step_m for z in others):
            return height_m
        height_m += step_m
    return wanted.value


def _at(mission: UavMission, height_m: float) -> UavMission:
    altitude = {**mission.altitude_m.model_dump(), 'value': height_m}
    return UavMission.model_validate({**mission.model_dump(), 'altitude_m': altitude})
