# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a proof rests on: what request, limits, tolerances and map say, and where."""

from __future__ import annotations

from aurora_core.knowledge.limits import Limits, Tolerance, Tolerances
from aurora_core.outcomes.feasibility import Fact, FactSource
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.stated import is_stated


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


def map_fact(path: str, value: float | str) -> Fact:
    """Return what the map says of a no-fly zone; `nofly_helipad/floor_m` is a path."""
    return Fact(source=FactSource.MAP, path=path, value=value)


def _entry(table: Limits | Tolerances, path: str) -> float:
    name, _, key = path.partition('/')
    value = getattr(table, name)
    if not key:
        return float(value)
    return float(value[key] if isinstance(value, dict) else getattr(value, key))
