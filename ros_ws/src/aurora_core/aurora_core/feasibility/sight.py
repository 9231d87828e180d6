# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse what is to be seen from where the camera does not reach it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.geometry import Geometry
from aurora_core.feasibility.operands import upward
from aurora_core.feasibility.zones import is_half_read, is_over, place_distances, roof_reach_m
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Landmark
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, StatedCondition, UavMission
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Relation

# From a landmark to whoever stands where the road leads to it, at most (m): no map comes in with
# a longer way, half a bus included. Who is at the landmark or near it may be `near_m` beside that.
_APPROACH_M = 160.0
_AT = frozenset({Relation.AT, Relation.NEAR, Relation.PARKED_AT})


def check_sight(
    spec: ScenarioSpec, map_model: MapModel, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return targets, landmarks and parked bodies that are out of reach of who is to see them."""
    yield from _targets(spec, limits, Geometry(spec, limits, tolerances))
    yield from _places(spec, map_model, limits, tolerances)


def _targets(spec: ScenarioSpec, limits: Limits, geometry: Geometry) -> Iterator[Certificate]:
    weather, hour = spec.world.weather.value, spec.world.time_of_day.value
    reach = limits.sensing_range(weather, hour)
    for mission in spec.missions:
        if mission.target is None or mission.mode is MissionMode.NAVIGATE:
            continue
        near, kept = geometry.slant(mission)[0], tuple[StatedCondition, ...]()
        if near <= reach:
            near, kept = geometry.slant_kept_m(mission), geometry.kept_off(mission)
        if near > reach:
            yield beyond(
                Rule.SENSING,
                'sensing_range',
                max((c.value for c in kept), key=lambda v: v.value, default=_leading(mission)),
                f'missions/{mission.id}',
                ('sensing_range_m', reach),
                f'{mission.uav} would be at least {near:.0f} m from {mission.target}; its camera '
                f'reaches {reach:g} m ({weather}, {hour}).',
                (
                    *geometry.facts(mission),
                    *(f for c in kept for f in says(f'conditions/{c.id}/value', c.value)),
                    *says('world/weather', weather),
                    *says('world/time_of_day', hour),
                    *limit_facts(limits, f'sensing_range_m/{weather}', f'sensing_factor/{hour}'),
                ),
            )


def _places(
    spec: ScenarioSpec, map_model: MapModel, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """A landmark, or who is parked at one, is too far from all hovers that are to see it."""
    weather, hour = spec.world.weather.value, spec.world.time_of_day.value
    reach = limits.sensing_range(weather, hour)
    marks = {f'{LANDMARK}{m.name}': m for m in map_model.landmarks}
    for condition in spec.conditions:
        seen = condition.quantity in (QuantityName.VISIBLE_TIME, QuantityName.VISIBLE_FRACTION)
        target, aside_m, facts = _where(spec, condition.of[-1], marks, tolerances)
        positive = upward(condition) and condition.value.value > 0.0
        if not (seen and positive) or target is None:
            continue
        flown = [m for m in spec.missions if m.uav == condition.of[0]]
        away = []
        for mission in flown:
            mark = marks.get(mission.target or '')
            if mark is None or mission.mode is not MissionMode.HOVER:
                away.append(0.0)
                continue
            _, far = place_distances(mission, limits, tolerances)
            if is_over(mission):
                far = max(far, roof_reach_m(mark, map_model.buildings))
            apart = math.hypot(mark.x_m - target.x_m, mark.y_m - target.y_m)
            away.append(apart - far - aside_m)
        if not flown or min(away) <= reach or any(is_half_read(spec, m) for m in flown):
            continue
        yield beyond(
            Rule.SENSING,
            'sensing_range',
            condition.value,
            f'conditions/{condition.id}',
            ('sensing_range_m', reach),
            f'{condition.of[0]} hovers at least {min(away):.0f} m from {condition.of[-1]}; its '
            f'camera reaches {reach:g} m ({weather}, {hour}).',
            (
                *says(f'conditions/{condition.id}/value', condition.value),
                *facts,
                *(f for m in flown for f in says(f'missions/{m.id}/target', m.target)),
                *(f for m in flown for f in says(f'missions/{m.id}/standoff_m', m.standoff_m)),
                *says('world/weather', weather),
                *says('world/time_of_day', hour),
                *limit_facts(limits, f'sensing_range_m/{weather}', f'sensing_factor/{hour}'),
                *tolerance_facts(tolerances, 'pattern_centre_m', 'hover_drift_wind_m'),
            ),
        )


def _where(
    spec: ScenarioSpec, name: str, marks: Mapping[str, Landmark], tolerances: Tolerances
) -> tuple[Landmark | None, float, tuple[Fact, ...]]:
    """Return the landmark that something is at, and how far from it that may be, metres."""
    if name in marks:
        return marks[name], 0.0, ()
    agent = next((a for a in spec.agents if a.id == name), None)
    moves = any(isinstance(e.action, AgentAction) and e.action.agent == name for e in spec.events)
    if agent is None or moves or {b.kind for b in agent.behaviors} != {BehaviorKind.PARK}:
        return None, 0.0, ()
    for k, placed in enumerate(agent.placements):
        if placed.relation in _AT and placed.of is not None and placed.of in marks:
            base = f'agents/{name}'
            facts = (
                *says(f'{base}/placements/{k}/relation', placed.relation.value),
                *says(f'{base}/placements/{k}/of', placed.of),
                *tolerance_facts(tolerances, 'near_m'),
            )
            return marks[placed.of], tolerances.near_m + _APPROACH_M, facts
    return None, 0.0, ()


def _leading(mission: UavMission) -> Parameter:
    """Return the stated number that puts the UAV far from its target."""
    standoff = mission.standoff_m
    if standoff is not None and is_stated(standoff) and standoff.value > mission.altitude_m.value:
        return standoff
    return mission.altitude_m
