# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far apart UAVs are planned: what the limits ask, and what the request asks beyond that."""

from __future__ import annotations

from math import pi, sin, sqrt

from aurora_core.knowledge.limits import Limits
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode

# Room that wind and tracking take of a stated separation (m).
_ROOM_M = 2.0

_PAIRS = (QuantityName.SEPARATION, QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE)


def asked_apart_m(spec: ScenarioSpec) -> float:
    """Return the greatest separation that a request asks of its UAVs, 0 where it asks none."""
    flying = {uav.id for uav in spec.uavs} | {uav.group for uav in spec.uavs if uav.group}
    return max(
        (
            c.value.value
            for c in spec.conditions
            if c.quantity in _PAIRS and c.op in ('>=', '>', '==') and set(c.of) <= flying
        ),
        default=0.0,
    )


def layer_m(spec: ScenarioSpec, limits: Limits) -> float:
    """Return the difference of the heights of UAVs whose ways cross."""
    asked_m = asked_apart_m(spec)
    return max(2.0 * limits.separation_min_m, asked_m + _ROOM_M if asked_m else 0.0)


def spacing_m(spec: ScenarioSpec, limits: Limits) -> float:
    """Return the distance of UAVs at one height, and of their starts.

    On the ways between such points two of them come nearer, by the square root of two at most
    (`starts.uncrossed`).
    """
    asked_m = asked_apart_m(spec)
    return max(2.0 * limits.separation_min_m, sqrt(2.0) * asked_m + _ROOM_M if asked_m else 0.0)


def homes_m(spec: ScenarioSpec, limits: Limits) -> float:
    """Return the distance that is asked of the starts beside the usual one, 0 for none."""
    apart_m = layer_m(spec, limits)
    heights = [(m.uav, m.altitude_m.value) for m in spec.missions]
    level = any(u != v and abs(z - w) < apart_m for u, z in heights for v, w in heights)
    return spacing_m(spec, limits) if level and asked_apart_m(spec) else 0.0


def sharing(spec: ScenarioSpec, mission: UavMission, limits: Limits) -> tuple[UavMission, ...]:
    """Return the missions that track one target from one side at about one height, in order."""
    apart_m = layer_m(spec, limits)
    return tuple(
        m
        for m in spec.missions
        if m.mode is MissionMode.TRACK
        and (m.target, m.side) == (mission.target, mission.side)
        and abs(m.altitude_m.value - mission.altitude_m.value) < apart_m
    )


def ring_m(spec: ScenarioSpec, mission: UavMission, limits: Limits) -> float:
    """Return how far from a target they have to stand so as to keep what is asked, 0 for any."""
    count = len({m.uav for m in sharing(spec, mission, limits)})
    asked_m = asked_apart_m(spec)
    if count < 2 or not asked_m:
        return 0.0
    return spacing_m(spec, limits) / (2.0 * sin(pi / count))


def over_one_point(spec: ScenarioSpec, mission: UavMission, limits: Limits) -> tuple[int, int]:
    """Return which one of how many UAVs this is that hover over one target at about one height.

    One of one where nothing is asked of their distance: any place beside the others does then.
    """
    if mission.mode is not MissionMode.HOVER or mission.target is None or not asked_apart_m(spec):
        return 0, 1
    apart_m = layer_m(spec, limits)
    same = [
        m.uav
        for m in spec.missions
        if (m.mode, m.target) == (mission.mode, mission.target)
        and abs(m.altitude_m.value - mission.altitude_m.value) < apart_m
    ]
    uavs = list(dict.fromkeys(same))
    return uavs.index(mission.uav), len(uavs)


def tight_m(spec: ScenarioSpec, limits: Limits) -> float:
    """Return the distance of UAVs over one point, where there is room for no more than that."""
    return max(2.0 * limits.separation_min_m, asked_apart_m(spec) + _ROOM_M)
