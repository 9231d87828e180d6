# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse stated distances, times and shares below nothing."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import BaseModel

from aurora_core.feasibility.certificates import contradiction
from aurora_core.feasibility.facts import says
from aurora_core.feasibility.stated import is_stated
from aurora_core.feasibility.verdict import Certificate, Rule
from aurora_core.spec.parameter import Parameter, Unit
from aurora_core.spec.scenario import ScenarioSpec

_REASONS = {
    Unit.METRE: 'spatial_contradiction',
    Unit.SECOND: 'temporal_contradiction',
    Unit.METRE_PER_SECOND: 'speed_limit',
    Unit.ONE: 'comm_range',
}


def check_signs(spec: ScenarioSpec) -> Iterator[Certificate]:
    """Return the stated numbers below zero; a bearing may be one."""
    for path, parameter in _parameters(spec, ''):
        reason = _REASONS.get(parameter.unit)
        if reason is not None and is_stated(parameter) and parameter.value < 0.0:
            yield contradiction(
                Rule.SIGN,
                reason,
                path,
                f'{path} asks for {parameter.value:g} {parameter.unit.value}; '
                'it cannot be below zero.',
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
