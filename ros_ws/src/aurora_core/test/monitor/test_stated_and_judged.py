# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nothing that a request can state is without a run on which a condition fails because of it.

The tables of condition kinds have runs that violate a condition. Here each of these conditions is
asked what it depends on; together they have to depend on every field of the specification.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Literal, get_args, get_origin

from kind_rows import Outcome, Row, all_rows
from pydantic import BaseModel
from trace_builder import LIMITS, TOLERANCES

from aurora_core.agsg.judged import NO_CHOICE, conditions_depending, paths_stated
from aurora_core.conditions.derive import derive_conditions
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec

# What no run can do yet, or what no condition is about; each with what the product says instead.
OPEN = {
    # What is said of these is `not_encoded`, see `conditions/unsaid.py`.
    ('UavMission', 'dwell_s'),
}


def _fields(model: type[BaseModel]) -> Iterator[tuple[str, str]]:
    """Yield every field below a model in which something can be stated."""
    for name, info in model.model_fields.items():
        if name in NO_CHOICE or name.endswith('span'):
            continue
        if get_origin(info.annotation) is Literal and len(get_args(info.annotation)) == 1:
            continue  # a word that names the kind itself
        parts = [part for part in _parts(info.annotation) if issubclass(part, BaseModel)]
        below = [part for part in parts if part is not Parameter]
        if not below:
            yield model.__name__, name
        for part in below:
            yield from _fields(part)


def _parts(annotation: Any) -> Iterator[type]:
    """Yield the classes in an annotation."""
    if isinstance(annotation, type) and not get_args(annotation):
        yield annotation
    for part in get_args(annotation):
        if not isinstance(part, str):
            yield from _parts(part)


def _owner(spec: ScenarioSpec, path: str) -> tuple[str, str]:
    """Return class and field of what stands at a path."""
    value: Any = spec
    found: Any = spec
    name = ''
    for part in path.split('/'):
        if isinstance(value, tuple):
            by_id = {getattr(item, 'id', None): item for item in value}
            value = by_id[part] if part in by_id else value[int(part)]
        else:
            found, name = value, part
            value = getattr(value, part)
    return type(found).__name__, name


def _depends(row: Row, judged: set[tuple[str, str]]) -> set[tuple[str, str]]:
    """Return which fields the row's condition depends on, beside those judged already."""
    asked, facts = row.request()
    explicit = _all_explicit(asked)
    owners = {path: _owner(explicit, path) for path in paths_stated(explicit)}
    open_paths = {path for path, owner in owners.items() if owner not in judged}
    if not open_paths:
        return set()

    def derive(spec: ScenarioSpec) -> Sequence[Condition]:
        return derive_conditions(spec, facts, LIMITS, TOLERANCES).conditions

    found = conditions_depending(explicit, derive(explicit), derive, open_paths)
    return {owners[path] for path, ids in found.items() if row.id in ids}


def _all_explicit(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the request with every number stated."""

    def stated(value: Any) -> Any:
        if isinstance(value, dict):
            if value.keys() >= {'value', 'unit', 'provenance'}:
                return {**value, 'provenance': 'explicit', 'span': {'start': 0, 'end': 1}}
            return {name: stated(part) for name, part in value.items()}
        return [stated(part) for part in value] if isinstance(value, list) else value

    return ScenarioSpec.model_validate(stated(spec.model_dump(mode='json')))


def test_every_field_has_a_run_on_which_a_condition_fails() -> None:
    asked = set(_fields(ScenarioSpec))
    judged: set[tuple[str, str]] = set()
    for row in all_rows():
        if row.margin is None or row.shows is not Outcome.VIOLATED:
            continue
        judged |= _depends(row, judged)
    assert asked - judged == OPEN
