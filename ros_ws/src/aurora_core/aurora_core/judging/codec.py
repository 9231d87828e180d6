# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read conditions from JSON text, each with the argument type of its quantity."""

from __future__ import annotations

from typing import Any

from pydantic import JsonValue, TypeAdapter, ValidationError

from aurora_core.errors import VerificationError
from aurora_core.judging.recorded import upgraded
from aurora_core.judging.registry import KINDS
from aurora_core.outcomes.condition import Condition

_ROWS: TypeAdapter[list[dict[str, JsonValue]]] = TypeAdapter(list[dict[str, JsonValue]])


def conditions_from_json(text: str) -> tuple[Condition, ...]:
    """Read conditions, also those that were recorded before each quantity had its own arguments.

    Raises:
        VerificationError: The text is not JSON of conditions, or ids repeat.
    """
    try:
        conditions = tuple(_condition(row) for row in _ROWS.validate_json(text))
    except (ValidationError, ValueError) as err:
        raise VerificationError(f'conditions cannot be read: {err}') from err
    ids = [condition.id for condition in conditions]
    repeated = sorted({i for i in ids if ids.count(i) > 1})
    if repeated:
        raise VerificationError(f'condition ids must be unique, repeated: {", ".join(repeated)}')
    return conditions


def _condition(row: dict[str, Any]) -> Condition:
    arguments = row.get('arguments')
    if isinstance(arguments, dict):
        if 'kind' not in arguments:
            arguments = upgraded(str(row.get('quantity')), arguments)
        kind = KINDS.get(str(arguments.get('kind')))
        if kind is None:
            raise ValueError(f'{row.get("id")} is of the kind {arguments.get("kind")!r}: unknown')
        if kind.name != row.get('quantity'):
            raise ValueError(f'{row.get("id")}: {kind.name.value} is not what it is about')
        row = row | {'arguments': kind.model_validate(arguments, strict=False)}
    return Condition.model_validate(row, strict=False)
