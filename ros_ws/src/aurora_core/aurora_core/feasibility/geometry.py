# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse geometry that no flight inside the tolerances can meet.

Only what the prompt states counts: an altitude or standoff by default may still be chosen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from aurora_core.feasibility.certificates import beyond, contradiction
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AgentAction,
    Link,
    ScenarioSpec,
    SendMessage,
    StatedCondition,
    UavMission,
)
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode

# Quantities that say how far two stay from each other.
_BETWEEN = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE, QuantityName.SEPARATION)
# What takes a vehicle's stated speed from it.
_SLOWING = frozenset({'brake', 'stop', 'slow', 'yield'})
# No point of a target that is looked at stands higher: half the height of the tallest vehicle.
_TARGET_HEIGHT_M = 2.0


class Geometry:
    """The distances between a UAV and its target that a request leaves open."""

    def __init__(self, spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> None:
        self._flying = frozenset(uav.id for uav in spec.uavs)
        self._limits = limits
        self._tolerances = tolerances

    def altitude(self, mission: UavMission) -> tuple[float, float]:
        """Return the lowest and highest altitude of a phase, in metres."""
        stated = mission.altitude_m
        slack = self._tolerances.altitude_m.of(stated.value, approximate=stated.approximate)
        limits = self._limits
        return (
            least(stated, slack, limits.uav_altitude_min_m),
            most(stated, slack, limits.uav_altitude_max_m),
        )

    def horizontal(self, mission: UavMission) -> tuple[float, float]:
        """Return the least and greatest horizontal distance to the target, in metres."""
        stated = mission.standoff_m
        slack = 0.0
        if stated is not None:
            slack = self._tolerances.standoff_m.of(stated.value, approximate=stated.approximate)
        return least(stated, slack, 0.0), most(stated, slack, math.inf)

    def slant(self, mission: UavMission) -> tuple[float, float]:
        """Return the least and greatest straight distance to the target, in metres.

        A target that flies itself may be at any height up to the UAV's own, and above it.
        """
        low, high = self.altitude(mission)
        near, far = self.horizontal(mission)
        if mission.target in self._flying:
            return near, math.hypot(self._limits.uav_altitude_max_m, far)
        return math.hypot(max(0.0, low - _TARGET_HEIGHT_M), near), math.hypot(high, far)

    def facts(self, mission: UavMission) -> tuple[Fact, ...]:
        """Return what these distances follow from."""
        base = f'missions/{mission.id}'
        named = {'altitude_m': mission.altitude_m, 'standoff_m': mission.standoff_m}
        used = {name: number for name, number in named.items() if is_stated(number)}
        return (
            *(fact for name, number in used.items() for fact in says(f'{base}/{name}', number)),
            *limit_facts(self._limits, 'uav_altitude_min_m', 'uav_altitude_max_m'),
            *tolerance_facts(self._tolerances, *used),
        )


def check_geometry(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return what sight, radio, separation and stated distances rule out."""
    geometry = Geometry(spec, limits, tolerances)
    yield from _sight(spec, limits, geometry)
    yield from _radio(spec, geometry)
    yield from _separation(spec, limits)
    yield from _stated_distances(spec, geometry)
    yield from _tracked_from_afar(spec, limits)
    yield from _pursuit(spec, limits, tolerances)


def _sight(spec: ScenarioSpec, limits: Limits, geometry: Geometry) -> Iterator[Certificate]:
    weather, hour = spec.world.weather.value, spec.world.time_of_day.value
    reach = limits.sensing_range(weather, hour)
    for mission in spec.missions:
        if mission.target is None or mission.mode is MissionMode.NAVIGATE:
            continue
        near, _ = geometry.slant(mission)
        if near > reach:
            yield beyond(
                Rule.SENSING,
                'sensing_range',
                _leading(mission),
                f'missions/{mission.id}',
                ('sensing_range_m', reach),
                f'{mission.uav} would be at least {near:.0f} m from {mission.target}; its camera '
                f'reaches {reach:g} m ({weather}, {hour}).',
                (
                    *geometry.facts(mission),
                    *says('world/weather', weather),
                    *says('world/time_of_day', hour),
                    *limit_facts(limits, f'sensing_range_m/{weather}', f'sensing_factor/{hour}'),
                ),
            )


def _leading(mission: UavMission) -> Parameter:
    """Return the stated number that puts the UAV far from its target."""
    standoff = mission.standoff_m
    if standoff is not None and is_stated(standoff) and standoff.value > mission.altitude_m.value:
        return standoff
    return mission.altitude_m


def _radio(spec: ScenarioSpec, geometry: Geometry) -> Iterator[Certificate]:
    """A UAV sends only after its ascent: then it is at its place in one of its phases."""
    sent = {
        (e.action.sender, e.action.receiver)
        for e in spec.events
        if isinstance(e.action, SendMessage)
    }
    for link in spec.links:
        pair = (link.sender, link.receiver)
        if link.range_m is None or not is_stated(link.range_m) or pair not in sent:
            continue
        yield from _kept_out_of_range(spec, link, link.range_m)
        flown = [m for m in spec.missions if m.uav in pair]
        if not flown or any(m.target not in pair for m in flown):
            continue
        near = min(geometry.slant(m)[0] for m in flown)
        if near > link.range_m.value and link.range_m.bound is not Bound.AT_LEAST:
            yield beyond(
                Rule.RADIO,
                'comm_range',
                link.range_m,
                f'links/{link.id}/range_m',
                ('range_m', link.range_m.value),
                f'{link.sender} and {link.receiver} would be at least {near:.0f} m apart; '
                f'the link reaches {link.range_m.value:g} m.',
                (
                    *says(f'links/{link.id}/range_m', link.range_m),
                    *(fact for m in flown for fact in geometry.facts(m)),
                ),
            )


def _kept_out_of_range(spec: ScenarioSpec, link: Link, reach: Parameter) -> Iterator[Certificate]:
    """`the two never come nearer than 300 m`, and their link reaches 120 m."""
    for condition in spec.conditions:
        apart = condition.quantity in _BETWEEN and condition.op in ('>', '>=')
        if not (apart and _holds_throughout(condition)) or set(condition.of) != {
            link.sender,
            link.receiver,
        }:
            continue
        if condition.value.value > reach.value and reach.bound is not Bound.AT_LEAST:
            yield beyond(
                Rule.RADIO,
                'comm_range',
                reach,
                f'links/{link.id}/range_m',
                ('range_m', reach.value),
                f'{link.sender} and {link.receiver} are to stay {condition.value.value:g} m '
                f'apart; the link reaches {reach.value:g} m.',
                (
                    *says(f'links/{link.id}/range_m', reach),
                    *says(f'conditions/{condition.id}/value', condition.value),
                ),
            )


def _holds_throughout(condition: StatedCondition) -> bool:
    """Return whether a condition is asked of all the time, not of a share, stretch or moment."""
    return condition.fraction is None and condition.hold_s is None and condition.by_s is None


def _separation(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    limit = limits.separation_min_m
    flying = {name for uav in spec.uavs for name in (uav.id, uav.group) if name is not None}
    for condition in spec.conditions:
        if not flying.issuperset(condition.of):
            continue
        # `2 m apart` asks for 2 m; `at least 2 m apart` leaves room.
        exact = condition.value.bound is Bound.EXACTLY and is_stated(condition.value)
        close = condition.value.value < limit and (
            condition.op in ('<', '<=', '==') or (condition.op == '>=' and exact)
        )
        if condition.quantity == QuantityName.SEPARATION and close:
            yield beyond(
                Rule.CLOSENESS,
                'separation',
                condition.value,
                f'conditions/{condition.id}/value',
                ('separation_min_m', limit),
                f'two UAVs keep at least {limit:g} m apart; '
                f'{condition.value.value:g} m are asked for.',
                (
                    *says(f'conditions/{condition.id}/value', condition.value),
                    *limit_facts(limits, 'separation_min_m'),
                ),
            )
    yield from _stacked(spec, limits)


def _stacked(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    """A UAV that is asked to fly at another one, nearer than two may be.

    The stated heights count as they are commanded; a height or distance that binds one-sidedly,
    or that the prompt does not state, can be chosen wider. The other one may fly several phases:
    only what holds for all of them is refused.
    """
    limit = limits.separation_min_m
    for above in spec.missions:
        others = [m for m in spec.missions if m.uav == above.target]
        standoff = above.standoff_m
        over = standoff is None and above.mode is MissionMode.HOVER
        aside_m = 0.0 if over else most(standoff, 0.0, math.inf)
        gaps = [(below, _widest_m(above.altitude_m, below.altitude_m)) for below in others]
        if gaps and all(math.hypot(gap, aside_m) < limit for _, gap in gaps):
            for below, gap in gaps:
                yield beyond(
                    Rule.STACKING,
                    'separation',
                    above.altitude_m,
                    f'missions/{above.id}/altitude_m',
                    ('separation_min_m', limit),
                    f'{above.uav} would be {gap:g} m above or below {below.uav}; '
                    f'two UAVs keep at least {limit:g} m apart.',
                    (
                        *says(f'missions/{above.id}/altitude_m', above.altitude_m),
                        *says(f'missions/{above.id}/standoff_m', above.standoff_m),
                        *says(f'missions/{below.id}/altitude_m', below.altitude_m),
                        *limit_facts(limits, 'separation_min_m'),
                    ),
                )


def _widest_m(one: Parameter, other: Parameter) -> float:
    """Return the greatest difference of two heights that a request allows."""
    return max(
        most(one, 0.0, math.inf) - least(other, 0.0, 0.0),
        most(other, 0.0, math.inf) - least(one, 0.0, 0.0),
    )


def _stated_distances(spec: ScenarioSpec, geometry: Geometry) -> Iterator[Certificate]:
    """A stated condition that the stated flight cannot meet."""
    for condition in spec.conditions:
        for mission in spec.missions:
            band = _band(condition, mission, geometry)
            if band is None or not _holds_throughout(condition):
                continue
            low, high = band
            value = condition.value.value
            too_far = condition.op in ('<', '<=') and low > value
            too_near = condition.op in ('>', '>=') and high < value
            if too_far or too_near:
                yield contradiction(
                    Rule.FLIGHT_BAND,
                    'spatial_contradiction',
                    f'conditions/{condition.id}',
                    f'{condition.quantity} of {", ".join(condition.of)} has to be '
                    f'{condition.op} {value:g} m; the flight of {mission.uav} as it is stated '
                    f'gives {"at least" if too_far else "at most"} '
                    f'{low if too_far else high:.1f} m.',
                    condition.span,
                    (
                        *says(f'conditions/{condition.id}/value', condition.value),
                        *geometry.facts(mission),
                    ),
                )


def _band(
    condition: StatedCondition, mission: UavMission, geometry: Geometry
) -> tuple[float, float] | None:
    """Return what a flight gives for a condition's quantity; None when it is not about that."""
    bodies = set(condition.of)
    if condition.quantity == QuantityName.ALTITUDE:
        return geometry.altitude(mission) if bodies == {mission.uav} else None
    if mission.mode is MissionMode.NAVIGATE or bodies != {mission.uav, mission.target}:
        return None
    if condition.quantity == QuantityName.DISTANCE:
        return geometry.slant(mission)
    if condition.quantity == QuantityName.HORIZONTAL_DISTANCE:
        return geometry.horizontal(mission)
    return None


def _tracked_from_afar(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    """`it tracks the bus and stays 250 m away`: no standoff that may be flown is so great."""
    tracked = {(m.uav, m.target): m for m in spec.missions if m.mode is MissionMode.TRACK}
    reach = limits.uav_standoff_max_m + limits.tracking_horizontal_m
    for condition in spec.conditions:
        mission = tracked.get(condition.of) if len(condition.of) == 2 else None
        apart = condition.quantity == QuantityName.HORIZONTAL_DISTANCE
        apart = apart and condition.op in ('>', '>=', '==')
        whole = _holds_throughout(condition)
        if mission is None or not (apart and whole) or is_stated(mission.standoff_m):
            continue
        if condition.value.value > reach:
            yield beyond(
                Rule.AFAR,
                'standoff',
                condition.value,
                f'conditions/{condition.id}/value',
                ('uav_standoff_max_m', limits.uav_standoff_max_m),
                f'{mission.uav} tracks {mission.target} from at most '
                f'{limits.uav_standoff_max_m:g} m; {condition.value.value:g} m are asked for.',
                (
                    *says(f'conditions/{condition.id}/value', condition.value),
                    *limit_facts(limits, 'uav_standoff_max_m', 'tracking_horizontal_m'),
                ),
            )


def _pursuit(spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> Iterator[Certificate]:
    """A target that is asked to drive faster than UAVs fly cannot be tracked."""
    top = limits.uav_speed_max_mps
    tracked = {m.target: m for m in spec.missions if m.mode is MissionMode.TRACK}
    # What an event makes slower has its stated speed for a part of the time only.
    acted = [e.action for e in spec.events if isinstance(e.action, AgentAction)]
    changed = {action.agent for action in acted if action.do in _SLOWING}
    for agent in spec.agents:
        mission = tracked.get(agent.id) if agent.id not in changed else None
        for k, behavior in enumerate(agent.behaviors):
            speed = behavior.speed_mps
            if speed is None:
                continue
            slack = tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
            if mission is not None and least(speed, slack, 0.0) > top:
                yield beyond(
                    Rule.PURSUIT,
                    'speed_limit',
                    speed,
                    f'missions/{mission.id}/target',
                    ('uav_speed_max_mps', top),
                    f'{agent.id} drives at {speed.value:g} m/s; {mission.uav} flies at most '
                    f'{top:g} m/s and cannot track it.',
                    (
                        *says(f'agents/{agent.id}/behaviors/{k}/speed_mps', speed),
                        *limit_facts(limits, 'uav_speed_max_mps'),
                        *tolerance_facts(tolerances, 'route_speed_mps'),
                    ),
                )
