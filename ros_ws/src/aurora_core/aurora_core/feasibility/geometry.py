# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse geometry that no flight inside the tolerances can meet.

Only what the prompt states counts: an altitude or standoff by default may still be chosen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from aurora_core.feasibility.certificates import beyond, contradiction, told
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.operands import AT_LEAST, whole
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.events import reports_own_altitude
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    Link,
    ScenarioSpec,
    SendMessage,
    StatedCondition,
    UavAction,
    UavMission,
)
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode

# Quantities that say how far two stay from each other.
_BETWEEN = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE, QuantityName.SEPARATION)
# No point of a target that is looked at stands higher: half the height of the tallest vehicle.
_TARGET_HEIGHT_M = 2.0


class Geometry:
    """The distances between a UAV and its target that a request leaves open."""

    def __init__(self, spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> None:
        self._flying = frozenset(uav.id for uav in spec.uavs)
        self._changes = altitude_changes(spec)
        self._limits = limits
        self._tolerances = tolerances

    def altitude(self, mission: UavMission) -> tuple[float, float]:
        """Return the lowest and highest altitude of a phase, in metres.

        Where an event makes the UAV climb or descend, that is part of it.
        """
        limits, lows, highs = self._limits, [], []
        for stated in (mission.altitude_m, *self._changes.get(mission.uav, {}).values()):
            slack = self._tolerances.altitude_m.of(stated.value, approximate=stated.approximate)
            lows.append(least(stated, slack, limits.uav_altitude_min_m))
            highs.append(most(stated, slack, limits.uav_altitude_max_m))
        return min(lows), max(highs)

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

    def while_sending(self, mission: UavMission) -> float:
        """Return how near a UAV that sends to its target is at least, in metres."""
        if mission.mode is MissionMode.TRACK:
            return self.slant(mission)[0]
        if mission.target in self._flying:
            return 0.0
        return max(0.0, self.altitude(mission)[0] - _TARGET_HEIGHT_M)

    def facts(self, mission: UavMission) -> tuple[Fact, ...]:
        """Return what these distances follow from."""
        base = f'missions/{mission.id}'
        named = {'altitude_m': mission.altitude_m, 'standoff_m': mission.standoff_m}
        used = {name: number for name, number in named.items() if is_stated(number)}
        changes = self._changes.get(mission.uav, {})
        return (
            *(fact for name, number in used.items() for fact in says(f'{base}/{name}', number)),
            *(fact for path, number in changes.items() for fact in says(path, number)),
            *limit_facts(self._limits, 'uav_altitude_min_m', 'uav_altitude_max_m'),
            *tolerance_facts(self._tolerances, *used),
        )


def altitude_changes(spec: ScenarioSpec) -> dict[str, dict[str, Parameter]]:
    """Return the altitudes to which events send UAVs, by UAV and path."""
    found: dict[str, dict[str, Parameter]] = {}
    for event in spec.events:
        action = event.action
        if isinstance(action, UavAction) and action.altitude_m is not None:
            path = f'events/{event.id}/action/altitude_m'
            found.setdefault(action.uav, {})[path] = action.altitude_m
    return found


def check_geometry(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return what radio, separation and stated distances rule out."""
    geometry = Geometry(spec, limits, tolerances)
    yield from _radio(spec, limits, geometry)
    yield from _separation(spec, limits)
    yield from _stated_distances(spec, limits, geometry)
    yield from _tracked_from_afar(spec, limits)


def _radio(spec: ScenarioSpec, limits: Limits, geometry: Geometry) -> Iterator[Certificate]:
    """A UAV sends only after its ascent: then it is as high as one of its phases at least.

    Who tracks sends when it is at its place; on the way to a hover it may pass nearer. Its own
    altitude it reports on its way up. What a UAV receives may come while it stands on the ground.
    """
    sent = {
        (e.action.sender, e.action.receiver)
        for e in spec.events
        if isinstance(e.action, SendMessage)
    }
    climbing = {getattr(e.action, 'sender', '') for e in spec.events if reports_own_altitude(e)}
    for link in spec.links:
        pair = (link.sender, link.receiver)
        if pair not in sent:
            continue
        yield from _kept_out_of_range(spec, link, limits)
        if link.range_m is None or not is_stated(link.range_m) or link.sender in climbing:
            continue
        flown = [m for m in spec.missions if m.uav == link.sender]
        if not flown or any(m.target != link.receiver for m in flown):
            continue
        near = min(geometry.while_sending(m) for m in flown)
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


def _kept_out_of_range(spec: ScenarioSpec, link: Link, limits: Limits) -> Iterator[Certificate]:
    """`the two never come nearer than 300 m`, and their link reaches 120 m."""
    reach = link.range_m
    stated = reach is not None and is_stated(reach)
    if reach is not None and (not stated or reach.bound is Bound.AT_LEAST):
        return
    reach_m = limits.link_range_sight_m if reach is None else reach.value
    for condition in spec.conditions:
        apart = condition.quantity in _BETWEEN and condition.op in AT_LEAST
        both = set(condition.of) == {link.sender, link.receiver}
        if not (apart and both and whole(condition) and is_stated(condition.value)):
            continue
        if condition.value.value > reach_m:
            at_limit = () if stated else limit_facts(limits, 'link_range_sight_m')
            yield beyond(
                Rule.RADIO,
                'comm_range',
                reach if reach is not None else condition.value,
                f'links/{link.id}/range_m',
                ('range_m' if stated else 'link_range_sight_m', reach_m),
                f'{link.sender} and {link.receiver} are to stay {condition.value.value:g} m '
                f'apart; the link reaches {reach_m:g} m.',
                (
                    *says(f'links/{link.id}/range_m', reach),
                    *says(f'conditions/{condition.id}/value', condition.value),
                    *at_limit,
                ),
            )


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
    changing = altitude_changes(spec)
    for above in spec.missions:
        if {above.uav, above.target} & changing.keys():
            continue
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


def _stated_distances(
    spec: ScenarioSpec, limits: Limits, geometry: Geometry
) -> Iterator[Certificate]:
    """A stated condition that no phase of the stated flight can meet.

    Of several phases one may be meant.
    """
    for condition in spec.conditions:
        if not (whole(condition) and is_stated(condition.value)):
            continue
        value = condition.value.value
        in_air = limits.uav_altitude_min_m <= value <= limits.uav_altitude_max_m
        if condition.quantity == QuantityName.ALTITUDE and not in_air:
            continue  # told of as a number beyond a limit
        bands = [(m, _band(condition, m, geometry)) for m in spec.missions]
        flown = [(m, band) for m, band in bands if band is not None]
        outside = [
            (condition.op in ('<', '<=') and low > value)
            or (condition.op in AT_LEAST and high < value)
            for _, (low, high) in flown
        ]
        if not flown or not all(outside):
            continue
        too_far = condition.op in ('<', '<=')
        mission, (low, high) = flown[0]
        yield contradiction(
            Rule.FLIGHT_BAND,
            'spatial_contradiction',
            f'conditions/{condition.id}',
            f'{told(condition)}; the flight of {mission.uav} as it is stated gives '
            f'{"at least" if too_far else "at most"} {low if too_far else high:.1f} m.',
            condition.span,
            (
                *says(f'conditions/{condition.id}/value', condition.value),
                *(fact for m, _ in flown for fact in geometry.facts(m)),
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
        if mission is None or not (apart and whole(condition)) or is_stated(mission.standoff_m):
            continue
        asked = condition.value.value
        if asked > reach or (asked == reach and condition.op == '>'):
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
