# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Certificates of the checks that look at several stated numbers at once."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.feasibility.verdict import Certificate, Fact, FactSource, Rule
from aurora_core.knowledge.limits import Limits, Tolerance, Tolerances
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span


def contradiction(
    rule: Rule,
    reason: str,
    path: str,
    sentence: str,
    span: Span | None = None,
    facts: Iterable[Fact] = (),
) -> Certificate:
    """Return the proof that two stated things exclude each other."""
    return Certificate(
        kind='contradiction',
        reason=reason,
        path=path,
        span=span,
        sentence=sentence,
        rule=rule,
        facts=tuple(facts),
    )


def beyond(
    rule: Rule,
    reason: str,
    parameter: Parameter,
    path: str,
    limit: tuple[str, float],
    sentence: str,
    facts: Iterable[Fact] = (),
) -> Certificate:
    """Return the proof that what a stated number implies is beyond a limit (name, value)."""
    name, value = limit
    return Certificate(
        kind='limit_exceeded',
        reason=reason,
        path=path,
        requested=parameter.value,
        unit=parameter.unit.value,
        limit_name=name,
        limit=value,
        span=parameter.span,
        sentence=sentence,
        rule=rule,
        facts=tuple(facts),
    )


def says(path: str, value: Parameter | float | str | None) -> tuple[Fact, ...]:
    """Return the fact that the request states this; none where it does not."""
    if isinstance(value, Parameter):
        if not is_stated(value):
            return ()
        value = value.value
    if value is None:
        return ()
    return (Fact(source=FactSource.REQUEST, path=path, value=value),)


def limit_facts(limits: Limits, *names: str) -> tuple[Fact, ...]:
    """Return limits by name; `sensing_range_m/fog` is one entry of a table."""
    return tuple(
        Fact(source=FactSource.LIMITS, path=name, value=_entry(limits, name)) for name in names
    )


def tolerance_facts(tolerances: Tolerances, *names: str) -> tuple[Fact, ...]:
    """Return tolerances by name, one that has two parts as both."""
    paths = [
        path
        for name in names
        for path in (
            (f'{name}/absolute', f'{name}/relative')
            if isinstance(getattr(tolerances, name), Tolerance)
            else (name,)
        )
    ]
    return tuple(
        Fact(source=FactSource.TOLERANCES, path=path, value=_entry(tolerances, path))
        for path in paths
    )


def _entry(table: Limits | Tolerances, path: str) -> float:
    name, _, key = path.partition('/')
    value = table.model_dump()[name]
    return float(value[key] if key else value)


def is_stated(parameter: Parameter | None) -> bool:
    """Return whether the prompt states this number itself."""
    return parameter is not None and parameter.provenance is Provenance.EXPLICIT


def least(parameter: Parameter | None, tolerance: float, otherwise: float) -> float:
    """Return the least value that still meets a request; unstated: `otherwise`."""
    if parameter is None or not is_stated(parameter) or parameter.bound is Bound.AT_MOST:
        return otherwise
    return max(otherwise, parameter.value - tolerance)


def most(parameter: Parameter | None, tolerance: float, otherwise: float) -> float:
    """Return the greatest value that still meets a request; unstated: `otherwise`."""
    if parameter is None or not is_stated(parameter) or parameter.bound is Bound.AT_LEAST:
        return otherwise
    return min(otherwise, parameter.value + tolerance)
