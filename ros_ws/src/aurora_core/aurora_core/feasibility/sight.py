# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse what is to be seen from where the camera does not reach it."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.feasibility.certificates import beyond
from aurora_core.feasibility.facts import limit_facts, says
from aurora_core.feasibility.geometry import Geometry
from aurora_core.feasibility.operands import upward
from aurora_core.feasibility.spots import Spots
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, StatedCondition, UavMission
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import MissionMode


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
    spots = Spots(spec, map_model, limits, tolerances)
    for condition in spec.conditions:
        seen = condition.quantity in (QuantityName.VISIBLE_TIME, QuantityName.VISIBLE_FRACTION)
        if not (seen and upward(condition) and condition.value.value > 0.0):
            continue
        target = condition.of[-1]
        flown = [m for m in spec.missions if m.uav == condition.of[0]]
        near = min((spots.apart_m(m, target)[0] for m in flown), default=0.0)
        if near <= reach:
            continue
        yield beyond(
            Rule.SENSING,
            'sensing_range',
            condition.value,
            f'conditions/{condition.id}',
            ('sensing_range_m', reach),
            f'{condition.of[0]} hovers at least {near:.0f} m from {target}; its '
            f'camera reaches {reach:g} m ({weather}, {hour}).',
            (
                *says(f'conditions/{condition.id}/value', condition.value),
                *dict.fromkeys(f for m in flown for f in spots.facts(m, target)),
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
