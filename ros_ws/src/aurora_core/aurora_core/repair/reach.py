# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Evidence of geometry: values that keep somebody out of a distance that is asked of him.

That is the distance at which something happens, or one to stay within. A distance to a UAV counts
the height. Who tracks a body is as far from it as altitude and standoff are together, whatever the
road; so is who hovers over a place from what passes there. A follower that starts behind the
greatest gap is out of it until it has caught up.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, sqrt

from aurora_core.judging.quantities.follow_fraction import FollowFraction
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import DistanceTrigger, ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode, Relation

# Passed, not touched: so much of the distance is aimed at.
_INSIDE = 0.7
# Who follows starts in the middle of the gap that is allowed.
_MIDDLE = 0.5
_BESIDE = (Relation.BEHIND, Relation.AHEAD)


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """What geometry says of one parameter.

    Attributes:
        aim: A value with which it can come true, in the parameter's unit.
        because: In English.
    """

    aim: float
    because: str


def out_of_reach(agsg: Agsg, condition: Condition) -> dict[str, Evidence]:
    """Return what keeps a UAV farther away than a condition asks or waits for, by path.

    Args:
        agsg: Grounded, as it was executed.
        condition: Violated.
    """
    spec = agsg.realised_spec
    if isinstance(condition.arguments, FollowFraction):
        return _too_far_behind(spec, condition, condition.arguments)
    asked = _waited_for(spec, condition) or _to_stay_within(condition)
    if asked is None:
        return {}
    found: dict[str, Evidence] = {}
    for mission in spec.missions:
        if mission.uav in asked.of:
            found |= _of_mission(mission, asked.reach_m, flat=asked.flat)
    return found


def _too_far_behind(
    spec: ScenarioSpec, condition: Condition, asked: FollowFraction
) -> dict[str, Evidence]:
    found = {}
    for agent in spec.agents:
        for k, placement in enumerate(agent.placements):
            between = {agent.id, placement.of} == {*condition.of}
            if placement.distance_m is None or placement.relation not in _BESIDE or not between:
                continue
            here_m = placement.distance_m.value
            if here_m > asked.high_m:
                found[f'agents/{agent.id}/placements/{k}/distance_m'] = Evidence(
                    aim=_MIDDLE * (asked.low_m + asked.high_m),
                    because=f'{here_m:.3g} m apart at the start, {asked.high_m:g} m are allowed',
                )
    return found


@dataclass(frozen=True, slots=True, kw_only=True)
class _Asked:
    """Whose distance is to be how small; `flat`: over ground."""

    of: tuple[str, ...]
    reach_m: float
    flat: bool = False


def _waited_for(spec: ScenarioSpec, condition: Condition) -> _Asked | None:
    event = next((e for e in spec.events if e.id == condition.arguments.event), None)
    trigger = None if event is None else event.trigger
    if not isinstance(trigger, DistanceTrigger) or trigger.on != 'distance_below':
        return None
    return _Asked(of=(trigger.a, trigger.b), reach_m=trigger.value_m.value)


def _to_stay_within(condition: Condition) -> _Asked | None:
    flat = condition.quantity is QuantityName.HORIZONTAL_DISTANCE
    if not flat and condition.quantity is not QuantityName.DISTANCE:
        return None
    if condition.op not in ('<', '<='):
        return None
    return _Asked(of=condition.of, reach_m=condition.threshold, flat=flat)


def _of_mission(mission: UavMission, reach_m: float, *, flat: bool) -> dict[str, Evidence]:
    tracks = mission.mode is MissionMode.TRACK
    height_m = 0.0 if flat else mission.altitude_m.value
    away_m = mission.standoff_m.value if tracks and mission.standoff_m is not None else 0.0
    if hypot(height_m, away_m) <= reach_m:
        return {}
    inside_m = _INSIDE * reach_m
    told = f'{hypot(height_m, away_m):.3g} m away it never comes within {reach_m:.3g} m'
    path = f'missions/{mission.id}'
    sides = [] if flat else [(f'{path}/altitude_m', mission.altitude_m, away_m)]
    if tracks and mission.standoff_m is not None:
        sides.append((f'{path}/standoff_m', mission.standoff_m, height_m))
    return {
        name: Evidence(aim=aim, because=told)
        for name, parameter, other_m in sides
        if (aim := _aim(parameter, other_m, inside_m)) is not None
    }


def _aim(parameter: Parameter, other_m: float, inside_m: float) -> float | None:
    """Return the value that brings the distance inside, None when this one alone cannot."""
    if other_m >= inside_m:
        return None
    aim = sqrt(inside_m * inside_m - other_m * other_m)
    return aim if parameter.low <= aim < parameter.value else None
