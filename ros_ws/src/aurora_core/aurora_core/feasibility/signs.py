# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse stated numbers that nothing can have: below zero, a pattern or phase of no extent."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import BaseModel

from aurora_core.feasibility.certificates import contradiction
from aurora_core.feasibility.facts import says
from aurora_core.outcomes.feasibility import Certificate, Rule
from aurora_core.spec.parameter import Bound, Parameter, Unit
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import MissionMode, Pattern

_REASONS = {
    Unit.METRE: 'spatial_contradiction',
    Unit.SECOND: 'temporal_contradiction',
    Unit.METRE_PER_SECOND: 'speed_limit',
    Unit.METRE_PER_SECOND_SQUARED: 'speed_limit',
    Unit.ONE: 'comm_range',
}
# Pure numbers that count something, by the last part of their path.
_COUNTS = frozenset({'waypoint_count', 'retransmissions', 'turns'})
# Flown along a width as well as a length; a line is [length, 0].
_WIDE = frozenset({Pattern.RECTANGLE, Pattern.LAWNMOWER})


def check_signs(spec: ScenarioSpec) -> Iterator[Certificate]:
    """Return the stated numbers below zero, and zeros and broken counts that leave nothing.

    A bearing may be below zero; what is "at least" a number can lie above it.
    """
    for path, parameter in _parameters(spec, ''):
        reason = _reason(path, parameter.unit)
        if reason is not None and _is_binding(parameter) and parameter.value < 0.0:
            yield _impossible(path, parameter, reason, 'it cannot be below zero')
    for index, mission in enumerate(spec.missions):
        for name, number in _extents(mission):
            if _is_binding(number) and number.value == 0.0:
                path = f'missions/{index}/{name}'
                reason = _reason(path, number.unit) or 'spatial_contradiction'
                yield _impossible(path, number, reason, 'with zero there is nothing to fly')
        count = mission.waypoint_count
        exact = count is not None and is_stated(count) and count.bound is Bound.EXACTLY
        if count is not None and exact and count.value > 0.0 and not count.value.is_integer():
            path = f'missions/{index}/waypoint_count'
            yield _impossible(path, count, 'count', 'only whole things are counted')


def _extents(mission: UavMission) -> Iterator[tuple[str, Parameter]]:
    """Yield the numbers of a mission without which there is no pattern, no way or no phase."""
    if mission.duration_s is not None:
        yield 'duration_s', mission.duration_s
    if mission.mode is not MissionMode.NAVIGATE:
        return
    if mission.speed_mps is not None:
        yield 'speed_mps', mission.speed_mps
    if mission.radius_m is not None:
        yield 'radius_m', mission.radius_m
    if mission.waypoint_count is not None:
        yield 'waypoint_count', mission.waypoint_count
    if mission.turns is not None:
        yield 'turns', mission.turns
    if mission.size_m is not None:
        yield 'size_m/0', mission.size_m[0]
        if mission.pattern in _WIDE:
            yield 'size_m/1', mission.size_m[1]


def _is_binding(parameter: Parameter) -> bool:
    """Return whether the prompt states it so that it cannot be met by something greater."""
    return is_stated(parameter) and parameter.bound is not Bound.AT_LEAST


def _reason(path: str, unit: Unit) -> str | None:
    return 'count' if path.rpartition('/')[2] in _COUNTS else _REASONS.get(unit)


def _impossible(path: str, parameter: Parameter, reason: str, why: str) -> Certificate:
    unit = '' if parameter.unit is Unit.ONE else f' {parameter.unit.value}'
    return contradiction(
        Rule.SIGN,
        reason,
        path,
        f'{path} asks for {parameter.value:g}{unit}; {why}.',
        parameter.span,
        says(path, parameter),
    )


def _parameters(value: object, path: str) -> Iterator[tuple[str, Parameter]]:
    if isinstance(value, Parameter):
        yield path, value
    elif isinstance(value, BaseModel):
        for name, inner in value:
            yield from _parameters(inner, f'{path}/{name}' if path else name)
    elif isinstance(value, tuple):
        for k, inner in enumerate(value):
            yield from _parameters(inner, f'{path}/{k}')
