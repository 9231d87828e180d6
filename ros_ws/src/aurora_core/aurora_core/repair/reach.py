# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Evidence of geometry: values that keep somebody out of a distance that is asked of him.

That is the distance at which something happens, or one to stay within; or one to be exceeded. A
distance to a UAV counts the height. Who tracks a body is as far from it as altitude and standoff
are together, whatever the road; so is who hovers over a place from what passes there. A follower
that starts behind the greatest gap is out of it until it has caught up; one that starts hardly
farther away than it has to keep has nothing to lose when the other one slows down.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, sqrt

from aurora_core.judging.quantities.follow_fraction import FollowFraction
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import DistanceTrigger, ScenarioSpec, SendMessage, UavMission
from aurora_core.spec.vocabulary import MissionMode, Relation

# Passed, not touched: so much of the distance is aimed at.
_INSIDE = 0.7
# Who follows starts in the middle of the gap that is allowed.
_MIDDLE = 0.5
# Who has to keep a distance starts at least so many times as far away, and is put so far.
_SCARCE, _AMPLE = 1.5, 6.0
_BESIDE = (Relation.BEHIND, Relation.AHEAD)
_DISTANCES = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Evidence:
    """What geometry says of one parameter.

    Attributes:
        aim: A value with which it can come true, in the parameter's unit.
        because: In English.
        direction: Whether more (1) or less (-1) of it helps.
    """

    aim: float
    because: str
    direction: int = -1


def out_of_reach(agsg: Agsg, condition: Condition) -> dict[str, Evidence]:
    """Return what keeps two farther from each other, or nearer, than a condition asks, by path.

    Args:
        agsg: Grounded, as it was executed.
        condition: Violated.
    """
    spec = agsg.realised_spec
    if isinstance(condition.arguments, FollowFraction):
        return _too_far_behind(spec, condition, condition.arguments)
    if condition.quantity in _DISTANCES and condition.op in ('>', '>='):
        return _too_near(spec, condition)
    far = waits_to_get_far(agsg, condition)
    if far is not None:
        return _stays_near(spec, far)
    asked = _waited_for(spec, condition) or _to_stay_within(condition)
    if asked is None:
        return {}
    found: dict[str, Evidence] = {}
    for mission in spec.missions:
        if mission.uav in asked.of:
            found |= _of_mission(mission, asked.reach_m, flat=asked.flat)
    return found


def reporting_tracker(agsg: Agsg, condition: Condition) -> tuple[str, Parameter] | None:
    """Return how far away somebody tracks whose report a condition waits for, with its path.

    Until it has captured its target it may not report.

    Args:
        agsg: Grounded, as it was executed.
        condition: Violated.
    """
    spec = agsg.realised_spec
    if condition.quantity is not QuantityName.EVENT_DELAY or condition.op not in ('<', '<='):
        return None
    event = next((e for e in spec.events if e.id == condition.arguments.event), None)
    if event is None or not isinstance(event.action, SendMessage):
        return None
    sender = event.action.sender
    mission = next((m for m in spec.missions if m.uav == sender), None)
    if mission is None or mission.mode is not MissionMode.TRACK or mission.standoff_m is None:
        return None
    return f'missions/{mission.id}/standoff_m', mission.standoff_m


def _too_far_behind(
    spec: ScenarioSpec, condition: Condition, asked: FollowFraction
) -> dict[str, Evidence]:
    return {
        path: Evidence(
            aim=_MIDDLE * (asked.low_m + asked.high_m),
            because=f'{gap.value:.3g} m apart at the start, {asked.high_m:g} m are allowed',
        )
        for path, gap in _gaps(spec, condition)
        if gap.value > asked.high_m
    }


def _too_near(spec: ScenarioSpec, condition: Condition) -> dict[str, Evidence]:
    least_m = condition.threshold
    return {
        path: Evidence(
            aim=min(gap.high, _AMPLE * least_m),
            because=f'{gap.value:.3g} m apart at the start, {least_m:g} m are to be kept',
            direction=1,
        )
        for path, gap in _gaps(spec, condition)
        if gap.value < _SCARCE * least_m < gap.high
    }


def _gaps(spec: ScenarioSpec, condition: Condition) -> Iterator[tuple[str, Parameter]]:
    """Yield the distances at which those of a condition start, one behind the other, by path."""
    for agent in spec.agents:
        for k, placement in enumerate(agent.placements):
            between = {agent.id, placement.of} == {*condition.of}
            if placement.distance_m is not None and placement.relation in _BESIDE and between:
                yield f'agents/{agent.id}/placements/{k}/distance_m', placement.distance_m


@dataclass(frozen=True, slots=True, kw_only=True)
class _Asked:
    """Whose distance is to be how small; `flat`: over ground."""

    of: tuple[str, ...]
    reach_m: float
    flat: bool = False


def waits_to_get_far(agsg: Agsg, condition: Condition) -> DistanceTrigger | None:
    """Return the trigger of a condition's event where it waits for a distance to be exceeded."""
    trigger = _trigger(agsg.realised_spec, condition)
    return None if trigger is None or trigger.on != 'distance_above' else trigger


def _trigger(spec: ScenarioSpec, condition: Condition) -> DistanceTrigger | None:
    event = next((e for e in spec.events if e.id == condition.arguments.event), None)
    trigger = None if event is None else event.trigger
    return trigger if isinstance(trigger, DistanceTrigger) else None


def _waited_for(spec: ScenarioSpec, condition: Condition) -> _Asked | None:
    trigger = _trigger(spec, condition)
    if trigger is None or trigger.on != 'distance_below':
        return None
    return _Asked(of=(trigger.a, trigger.b), reach_m=trigger.value_m.value)


def _stays_near(spec: ScenarioSpec, trigger: DistanceTrigger) -> dict[str, Evidence]:
    """Return what keeps a UAV near the body that it tracks while more is waited for.

    It lags behind and swings out, so a value that comes near that distance counts as well.
    """
    beyond_m, found = trigger.value_m.value, {}
    for mission in spec.missions:
        pair = {mission.uav, mission.target} == {trigger.a, trigger.b}
        if mission.mode is not MissionMode.TRACK or not pair:
            continue
        away = mission.standoff_m
        away_m, height_m = 0.0 if away is None else away.value, mission.altitude_m.value
        here_m = hypot(height_m, away_m)
        if here_m > beyond_m:
            continue
        path = f'missions/{mission.id}'
        sides = [(f'{path}/altitude_m', mission.altitude_m, away_m)]
        if away is not None:
            sides.append((f'{path}/standoff_m', away, height_m))
        for name, parameter, other_m in sides:
            outside_m = beyond_m / _INSIDE
            aim = min(parameter.high, sqrt(max(0.0, outside_m * outside_m - other_m * other_m)))
            if aim > parameter.value and hypot(aim, other_m) >= _INSIDE * beyond_m:
                told = f'it stays {here_m:.3g} m away, more than {beyond_m:.3g} m are waited for'
                found[name] = Evidence(aim=aim, because=told, direction=1)
    return found


def _to_stay_within(condition: Condition) -> _Asked | None:
    if condition.quantity not in _DISTANCES or condition.op not in ('<', '<='):
        return None
    flat = condition.quantity is QuantityName.HORIZONTAL_DISTANCE
    return _Asked(of=condition.of, reach_m=condition.threshold, flat=flat)


def _of_mission(mission: UavMission, reach_m: float, *, flat: bool) -> dict[str, Evidence]:
    tracks = mission.mode is MissionMode.TRACK
    height_m = 0.0 if flat else mission.altitude_m.value
    away_m = mission.standoff_m.value if tracks and mission.standoff_m is not None else 0.0
    if hypot(height_m, away_m) <= reach_m:
        return {}
    told = f'{hypot(height_m, away_m):.3g} m away it never comes within {reach_m:.3g} m'
    path = f'missions/{mission.id}'
    sides = [] if flat else [(f'{path}/altitude_m', mission.altitude_m, away_m)]
    if tracks and mission.standoff_m is not None:
        sides.append((f'{path}/standoff_m', mission.standoff_m, height_m))
    return {
        name: Evidence(aim=aim, because=told)
        for name, parameter, other_m in sides
        if (aim := _aim(parameter, other_m, reach_m)) is not None
    }


def _aim(parameter: Parameter, other_m: float, reach_m: float) -> float | None:
    """Return the value that brings the distance inside, None when this one alone cannot.

    Where the other side takes most of the distance, half of what it leaves is aimed at.
    """
    if other_m >= reach_m:
        return None
    inside_m = _INSIDE * reach_m
    if other_m >= inside_m:
        inside_m = 0.5 * (other_m + reach_m)
    aim = sqrt(inside_m * inside_m - other_m * other_m)
    return aim if parameter.low <= aim < parameter.value else None
