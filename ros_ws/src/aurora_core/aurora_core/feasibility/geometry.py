# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse geometry that no flight inside the tolerances can meet.

Only what the prompt states counts: an altitude or standoff by default may still be chosen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from aurora_core.feasibility.certificates import beyond, contradiction, told
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.operands import AT_LEAST, AT_MOST, SLOWING, in_parts, whole
from aurora_core.feasibility.spots import Spots
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import ScenarioSpec, StatedCondition, UavAction, UavMission
from aurora_core.spec.stated import is_stated, least, most
from aurora_core.spec.vocabulary import MissionMode

# No point of a target that is looked at stands higher: half the height of the tallest vehicle.
TARGET_HEIGHT_M = 2.0


class Geometry:
    """The distances between a UAV and its target that a request leaves open."""

    def __init__(self, spec: ScenarioSpec, limits: Limits, tolerances: Tolerances) -> None:
        self._spec = spec
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
        return math.hypot(max(0.0, low - TARGET_HEIGHT_M), near), math.hypot(high, far)

    def kept_off(self, mission: UavMission) -> tuple[StatedCondition, ...]:
        """Return what keeps a UAV up, or away from its target, as long as a phase lasts.

        What is beyond any standoff is told of as such.
        """
        most_m = self._limits.uav_standoff_max_m + self._limits.tracking_horizontal_m
        target, pair = mission.target, {mission.uav, mission.target}
        if target is None or in_parts(self._spec, {mission.uav}):
            return ()
        return tuple(
            c
            for c in self._spec.conditions
            if c.op in AT_LEAST
            and whole(c)
            and is_stated(c.value)
            and (
                (c.quantity == QuantityName.DISTANCE and set(c.of) == pair)
                or (
                    c.quantity == QuantityName.HORIZONTAL_DISTANCE
                    and set(c.of) == pair
                    and c.value.value <= most_m
                )
                or (
                    c.quantity == QuantityName.ALTITUDE
                    and set(c.of) == {mission.uav}
                    and target not in self._flying
                )
            )
        )

    def slant_kept_m(self, mission: UavMission) -> float:
        """Return the least straight distance to the target with all that keeps it off, metres."""
        low = self.altitude(mission)[0]
        near, straight = self.horizontal(mission)[0], self.slant(mission)[0]
        for condition in self.kept_off(mission):
            value = condition.value.value
            if condition.quantity == QuantityName.ALTITUDE:
                low = max(low, value)
            elif condition.quantity == QuantityName.HORIZONTAL_DISTANCE:
                near = max(near, value)
            else:
                # It is measured to the ground, sight to the middle of a body.
                straight = max(straight, value - TARGET_HEIGHT_M)
        up = 0.0 if mission.target in self._flying else max(0.0, low - TARGET_HEIGHT_M)
        return max(straight, math.hypot(up, near))

    def speed(self, mission: UavMission) -> tuple[float, float] | None:
        """Return the speeds of a route for most of it, None where none is stated."""
        stated = mission.speed_mps
        if mission.mode is not MissionMode.NAVIGATE or stated is None or not is_stated(stated):
            return None
        slack = self._tolerances.route_speed_mps.of(stated.value, approximate=stated.approximate)
        return least(stated, slack, 0.0), most(stated, slack, math.inf)

    def speed_facts(self, mission: UavMission) -> tuple[Fact, ...]:
        """Return what the speeds of a route follow from."""
        return (
            *says(f'missions/{mission.id}/speed_mps', mission.speed_mps),
            *tolerance_facts(self._tolerances, 'route_speed_mps'),
        )

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
    spec: ScenarioSpec, map_model: MapModel, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return what separation and stated distances rule out."""
    spots = Spots(spec, map_model, limits, tolerances)
    yield from _separation(spec, limits)
    yield from _stated_distances(spec, limits, tolerances, spots)
    yield from _tracked_from_afar(spec, limits)


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
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances, spots: Spots
) -> Iterator[Certificate]:
    """A stated condition that no phase of the stated flight, and no stated drive, can meet.

    Of several phases one may be meant.
    """
    geometry = Geometry(spec, limits, tolerances)
    for condition in spec.conditions:
        if not (whole(condition) and is_stated(condition.value)):
            continue
        value = condition.value.value
        in_air = limits.uav_altitude_min_m <= value <= limits.uav_altitude_max_m
        if condition.quantity == QuantityName.ALTITUDE and not in_air:
            continue  # told of as a number beyond a limit
        bands = [*_flown(spec, condition, geometry, spots), *_driven(spec, condition, tolerances)]
        outside = [
            (condition.op in AT_MOST and band.low > value)
            or (condition.op in AT_LEAST and band.high < value)
            for band in bands
        ]
        if not bands or not all(outside):
            continue
        too_much, band = condition.op in AT_MOST, bands[0]
        yield contradiction(
            Rule.FLIGHT_BAND,
            'spatial_contradiction',
            f'conditions/{condition.id}',
            f'{told(condition)}; {band.what} as it is stated gives '
            f'{"at least" if too_much else "at most"} '
            f'{band.low if too_much else band.high:.1f} {condition.value.unit}.',
            condition.span,
            (
                *says(f'conditions/{condition.id}/value', condition.value),
                *dict.fromkeys(fact for band in bands for fact in band.facts),
            ),
        )


@dataclass(frozen=True, slots=True)
class _Band:
    """What a stated flight or drive gives for a condition's quantity."""

    what: str
    low: float
    high: float
    facts: tuple[Fact, ...]


def _flown(
    spec: ScenarioSpec, condition: StatedCondition, geometry: Geometry, spots: Spots
) -> Iterator[_Band]:
    """Yield what each phase gives that a condition may be about."""
    for mission in (m for m in spec.missions if m.uav in condition.of):
        others = [name for name in condition.of if name != mission.uav]
        if condition.quantity == QuantityName.ALTITUDE:
            band, facts = geometry.altitude(mission), geometry.facts(mission)
        elif condition.quantity == QuantityName.SPEED:
            speed = None if in_parts(spec, condition.of) else geometry.speed(mission)
            if speed is None:
                continue
            band, facts = speed, geometry.speed_facts(mission)
        elif len(others) == 1:
            between = _between(spec, condition.quantity, mission, others[0], geometry, spots)
            if between is None:
                continue
            band = between
            facts = (*geometry.facts(mission), *spots.facts(mission, others[0]))
        else:
            continue
        yield _Band(f'the flight of {mission.uav}', *band, facts)


def _between(
    spec: ScenarioSpec,
    quantity: str,
    mission: UavMission,
    other: str,
    geometry: Geometry,
    spots: Spots,
) -> tuple[float, float] | None:
    """Return how near and far a flight is from somebody; None when nothing bounds that."""
    watched = mission.mode is not MissionMode.NAVIGATE and mission.target == other
    grounded = is_place(other) or other in {a.id for a in spec.agents}
    if not (watched or grounded):
        return None
    near_m, far_m = spots.apart_m(mission, other)
    if quantity == QuantityName.HORIZONTAL_DISTANCE:
        low_m, high_m = geometry.horizontal(mission) if watched else (0.0, math.inf)
        return max(low_m, near_m), min(high_m, far_m)
    if quantity != QuantityName.DISTANCE:
        return None
    low_m, high_m = geometry.slant(mission) if watched else (0.0, math.inf)
    if not grounded:
        return low_m, high_m
    # Wherever it flies, whoever is on the ground is below it.
    lowest_m, highest_m = geometry.altitude(mission)
    low_m = max(low_m, math.hypot(max(0.0, lowest_m - TARGET_HEIGHT_M), near_m))
    return low_m, min(high_m, math.hypot(highest_m, far_m))


def _driven(
    spec: ScenarioSpec, condition: StatedCondition, tolerances: Tolerances
) -> Iterator[_Band]:
    """Yield the stated speeds of who is never to be as fast; most of the time it drives so."""
    if condition.quantity != QuantityName.SPEED or condition.op not in AT_MOST:
        return
    for agent in (a for a in spec.agents if (a.id,) == condition.of):
        if in_parts(spec, {agent.id}) or any(b.kind in SLOWING for b in agent.behaviors):
            continue
        for k, behavior in enumerate(agent.behaviors):
            speed = behavior.speed_mps
            if speed is not None and is_stated(speed):
                slack = tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
                path = f'agents/{agent.id}/behaviors/{k}/speed_mps'
                facts = (*says(path, speed), *tolerance_facts(tolerances, 'route_speed_mps'))
                yield _Band(f'the drive of {agent.id}', least(speed, slack, 0.0), math.inf, facts)


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
