# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse what a limit rules out: a stated number beyond a limit is refused, never clamped."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from aurora_core.feasibility.operands import AT_LEAST, AT_MOST, whole
from aurora_core.knowledge.agent_types import AgentTypeRecord, top_speed_mps
from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.feasibility import Certificate, Feasibility, FeasibilityVerdict, Rule
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Unit
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.requirements import UAV_TYPE
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    Link,
    ScenarioSpec,
    SpeedTrigger,
    UavAction,
)
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import AgentType

# What a limit is on, in words; the others are on speeds.
_WHAT = {
    'agents_max': 'A number',
    'duration_s': 'A scenario',
    'emergency_decel_mps2': 'A deceleration',
    'link_loss': 'A loss',
    'gust_max_mps': 'A gust',
    'uav_altitude_m': 'An altitude',
    'uav_endurance_s': 'A phase',
    'uav_standoff_max_m': 'A standoff',
    'uavs_max': 'A number',
    'wind_max_mps': 'A wind',
}
# Realised values may exceed a limit by so much.
_MARGIN = 1.01


@dataclass(frozen=True, slots=True, kw_only=True)
class _Rule:
    """A stated number and the limit it has to keep (low or high)."""

    path: str
    parameter: Parameter
    reason: str
    limit_name: str
    low: float | None = None
    high: float | None = None
    high_is_excluded: bool = False


def check_limits(
    spec: ScenarioSpec,
    limits: Limits,
    types: Mapping[str, AgentTypeRecord] | None = None,
) -> FeasibilityVerdict:
    """Check every stated number and count against the limits.

    Args:
        spec: The request.
        limits: Limits in force; a value equal to a limit is inside it.
        types: What the agent types can reach; without them only the limits count.

    Returns:
        `infeasible` with one certificate per broken limit, else `feasible`.
    """
    certificates = [c for rule in _rules(spec, limits, types or {}) for c in _broken(rule)]
    certificates += _counts(spec, limits)
    if certificates:
        return FeasibilityVerdict(result=Feasibility.INFEASIBLE, certificates=tuple(certificates))
    return FeasibilityVerdict(result=Feasibility.FEASIBLE)


def _rules(
    spec: ScenarioSpec, limits: Limits, types: Mapping[str, AgentTypeRecord]
) -> Iterator[_Rule]:
    for mission in spec.missions:
        base = f'missions/{mission.id}'
        yield _Rule(
            path=f'{base}/altitude_m',
            parameter=mission.altitude_m,
            reason='altitude_limit',
            limit_name='uav_altitude_m',
            low=limits.uav_altitude_min_m,
            high=limits.uav_altitude_max_m,
        )
        if mission.standoff_m is not None:
            yield _Rule(
                path=f'{base}/standoff_m',
                parameter=mission.standoff_m,
                reason='standoff',
                limit_name='uav_standoff_max_m',
                low=0.0,
                high=limits.uav_standoff_max_m,
            )
        if mission.speed_mps is not None:
            yield _Rule(
                path=f'{base}/speed_mps',
                parameter=mission.speed_mps,
                reason='speed_limit',
                limit_name='uav_speed_max_mps',
                low=0.0,
                high=limits.uav_speed_max_mps,
            )
        if mission.duration_s is not None:
            yield _Rule(
                path=f'{base}/duration_s',
                parameter=mission.duration_s,
                reason='endurance',
                limit_name='uav_endurance_s',
                low=0.0,
                high=limits.uav_endurance_s,
            )
    speeds = {a.id: _top_speed(a.type, limits, types) for a in spec.agents}
    for agent in spec.agents:
        name, top = speeds[agent.id]
        for k, behavior in enumerate(agent.behaviors):
            if behavior.speed_mps is not None:
                yield _Rule(
                    path=f'agents/{agent.id}/behaviors/{k}/speed_mps',
                    parameter=behavior.speed_mps,
                    reason='speed_limit',
                    limit_name=name,
                    low=0.0,
                    high=top,
                )
            if behavior.duration_s is not None:
                yield _Rule(
                    path=f'agents/{agent.id}/behaviors/{k}/duration_s',
                    parameter=behavior.duration_s,
                    reason='duration',
                    limit_name='duration_s',
                    high=limits.duration_max_s,
                )
    for event in spec.events:
        trigger, action = event.trigger, event.action
        if isinstance(trigger, AltitudeTrigger):
            yield _Rule(
                path=f'events/{event.id}/trigger/value_m',
                parameter=trigger.value_m,
                reason='altitude_limit',
                limit_name='uav_altitude_m',
                high=limits.uav_altitude_max_m,
            )
        if isinstance(action, UavAction) and action.altitude_m is not None:
            yield _Rule(
                path=f'events/{event.id}/action/altitude_m',
                parameter=action.altitude_m,
                reason='altitude_limit',
                limit_name='uav_altitude_m',
                low=limits.uav_altitude_min_m,
                high=limits.uav_altitude_max_m,
            )
        if isinstance(action, UavAction) and action.vertical_mps is not None:
            name, most_mps = _climb_limit(spec, action, limits)
            yield _Rule(
                path=f'events/{event.id}/action/vertical_mps',
                parameter=action.vertical_mps,
                reason='speed_limit',
                limit_name=name,
                low=0.0,
                high=most_mps,
            )
        if isinstance(action, AgentAction) and action.deceleration_mps2 is not None:
            yield from _braking(
                spec,
                action.agent,
                types,
                f'events/{event.id}/action/deceleration_mps2',
                action.deceleration_mps2,
            )
        if isinstance(action, AgentAction) and action.value_mps is not None:
            name, top = speeds[action.agent]
            yield _Rule(
                path=f'events/{event.id}/action/value_mps',
                parameter=action.value_mps,
                reason='speed_limit',
                limit_name=name,
                low=0.0,
                high=top,
            )
    for condition in spec.conditions:
        if condition.quantity == QuantityName.DECELERATION and condition.op in (*AT_LEAST, '=='):
            path = f'conditions/{condition.id}/value'
            yield from _braking(spec, condition.of[0], types, path, condition.value)
    yield from _asked_of_bodies(spec, limits, speeds)
    for link in spec.links:
        yield _Rule(
            path=f'links/{link.id}/loss',
            parameter=link.loss,
            reason='comm_range',
            limit_name='link_loss',
            low=0.0,
            high=1.0,
            high_is_excluded=not _is_to_lose(spec, link),
        )
    for name, stated, most_mps in (
        ('wind', spec.world.wind_mps, limits.wind_max_mps),
        ('gust', spec.world.gust_mps, limits.gust_max_mps),
    ):
        if stated is not None:
            yield _Rule(
                path=f'world/{name}_mps',
                parameter=stated,
                reason='speed_limit',
                limit_name=f'{name}_max_mps',
                low=0.0,
                high=most_mps,
            )
    if spec.world.duration_s is not None:
        yield _Rule(
            path='world/duration_s',
            parameter=spec.world.duration_s,
            reason='duration',
            limit_name='duration_s',
            low=limits.duration_min_s,
            high=limits.duration_max_s,
        )


def _climb_limit(spec: ScenarioSpec, action: UavAction, limits: Limits) -> tuple[str, float]:
    """Return the limit on a climb; on a descent where the UAV is surely higher before."""
    own = [m.altitude_m for m in spec.missions if m.uav == action.uav]
    to = action.altitude_m
    down = to is not None and is_stated(to) and bool(own)
    if down and to is not None and all(is_stated(a) and a.value > to.value for a in own):
        return 'uav_descent_max_mps', limits.uav_descent_max_mps
    return 'uav_climb_max_mps', limits.uav_climb_max_mps


def _braking(
    spec: ScenarioSpec,
    name: str,
    types: Mapping[str, AgentTypeRecord],
    path: str,
    asked: Parameter,
) -> Iterator[_Rule]:
    """Yield that nobody brakes harder than its type can in an emergency."""
    agent = next((a for a in spec.agents if name in (a.id, a.group)), None)
    record = None if agent is None else types.get(agent.type.value)
    if agent is not None and record is not None:
        yield _Rule(
            path=path,
            parameter=asked,
            reason='speed_limit',
            limit_name=f'agent_types/{agent.type.value}/emergency_decel_mps2',
            low=0.0,
            high=record.emergency_decel_mps2,
        )


def _is_to_lose(spec: ScenarioSpec, link: Link) -> bool:
    """Tell whether the request itself asks that nothing comes over a link."""
    return any(
        c.quantity == QuantityName.DELIVERED
        and c.of == (link.sender, link.receiver)
        and c.op == '=='
        and c.value.value == 0.0
        for c in spec.conditions
    )


def _asked_of_bodies(
    spec: ScenarioSpec, limits: Limits, speeds: Mapping[str, tuple[str, float]]
) -> Iterator[_Rule]:
    """Yield what conditions, triggers and counts ask of altitudes, speeds and numbers."""
    flying = {name for uav in spec.uavs for name in (uav.id, uav.group) if name is not None}
    # A UAV's speed is that in space: it may climb while it flies.
    fastest = math.hypot(limits.uav_speed_max_mps, limits.uav_climb_max_mps) * _MARGIN
    for condition in spec.conditions:
        value, path = condition.value, f'conditions/{condition.id}/value'
        up, down = condition.op in (*AT_LEAST, '=='), condition.op in AT_MOST and whole(condition)
        if condition.quantity == QuantityName.ALTITUDE:
            yield _Rule(
                path=path,
                parameter=value,
                reason='altitude_limit',
                limit_name='uav_altitude_m',
                low=limits.uav_altitude_min_m if down else None,
                high=limits.uav_altitude_max_m if up else None,
            )
        elif condition.quantity == QuantityName.SPEED and up:
            of = condition.of[0]
            name, top = speeds.get(of, ('uav_speed_max_mps', limits.uav_speed_max_mps))
            known = of in speeds or (of in flying and value.value > fastest)
            if known:
                yield _Rule(
                    path=path, parameter=value, reason='speed_limit', limit_name=name, high=top
                )
    for event in spec.events:
        trigger = event.trigger
        if isinstance(trigger, SpeedTrigger) and trigger.on == 'speed_above':
            if trigger.who not in speeds:
                continue
            name, top = speeds[trigger.who]
            yield _Rule(
                path=f'events/{event.id}/trigger/value_mps',
                parameter=trigger.value_mps,
                reason='speed_limit',
                limit_name=name,
                high=top,
            )
    for count in spec.counts:
        of_uavs = count.kind == UAV_TYPE
        yield _Rule(
            path=f'counts/{count.id}/value',
            parameter=count.value,
            reason='count',
            limit_name='uavs_max' if of_uavs else 'agents_max',
            high=float(limits.uavs_max if of_uavs else limits.agents_max),
        )


def _top_speed(
    kind: AgentType, limits: Limits, types: Mapping[str, AgentTypeRecord]
) -> tuple[str, float]:
    """Return the limit on an agent's speed: the general one, or what its type can reach."""
    walks = kind is AgentType.PEDESTRIAN
    name = 'pedestrian_speed_max_mps' if walks else 'vehicle_speed_max_mps'
    top = limits.pedestrian_speed_max_mps if walks else limits.vehicle_speed_max_mps
    record = types.get(kind.value)
    if record is not None and top_speed_mps(record, limits) < top:
        return f'agent_types/{kind.value}/max_speed_mps', top_speed_mps(record, limits)
    return name, top


def _broken(rule: _Rule) -> Iterator[Certificate]:
    parameter = rule.parameter
    if parameter.provenance is not Provenance.EXPLICIT:
        return
    value, limit = parameter.value, None
    over = rule.high is not None and (
        value > rule.high or (rule.high_is_excluded and value >= rule.high)
    )
    # "at most 150 m" can be met below the limit, "at least 1 m" above it.
    if over and parameter.bound is not Bound.AT_MOST:
        limit = rule.high
    if rule.low is not None and value < rule.low and parameter.bound is not Bound.AT_LEAST:
        limit = rule.low
    if limit is None:
        return
    excluded = rule.high_is_excluded and limit == rule.high
    word = 'below' if excluded else ('at most' if limit == rule.high else 'at least')
    unit = '' if parameter.unit is Unit.ONE else f' {parameter.unit.value}'
    what = _WHAT.get(rule.limit_name.rpartition('/')[2], 'A speed')
    yield Certificate(
        kind='limit_exceeded',
        reason=rule.reason,
        path=rule.path,
        requested=value,
        unit=parameter.unit.value,
        limit_name=rule.limit_name,
        limit=limit,
        span=parameter.span,
        rule=Rule.LIMIT,
        sentence=(
            f'{what} of {value:g}{unit} is asked for '
            f'({rule.path}); it has to be {word} {limit:g}{unit} ({rule.limit_name}).'
        ),
    )


def _counts(spec: ScenarioSpec, limits: Limits) -> list[Certificate]:
    found = []
    for path, count, top in (
        ('uavs', len(spec.uavs), limits.uavs_max),
        ('agents', len(spec.agents), limits.agents_max),
    ):
        if count > top:
            found.append(
                Certificate(
                    kind='limit_exceeded',
                    reason='count',
                    path=path,
                    requested=float(count),
                    unit='1',
                    limit_name=f'{path}_max',
                    limit=float(top),
                    rule=Rule.COUNT,
                    sentence=f'{count} {path} are asked for; at most {top} are possible.',
                )
            )
    return found
