# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The base of every value that is handed on, and its one JSON text."""

from __future__ import annotations

import json
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

# In the JSON schema: the field is left out of a document when it has its default.
OMITTED = 'x-omitted-when-default'


class Document(BaseModel):
    """Base of every value that a stage hands on: frozen, closed, keyword-only."""

    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)

    def canonical_json(self) -> str:
        """Return the one byte-exact JSON text that files, messages and digests use."""
        return canonical_json(self.model_dump(mode='json'))


def canonical_json(value: object) -> str:
    """Return the one byte-exact JSON text of plain values: sorted keys, no blanks."""
    return json.dumps(value, sort_keys=True, separators=(',', ':'), ensure_ascii=False)


def first_difference(one: Document, other: Document) -> tuple[str, object, object] | None:
    """Return the path of the first value in which documents differ and both values, None: equal.

    A value that is not there is None; names of a path are separated by slashes.
    """
    return _first_difference(one.model_dump(mode='json'), other.model_dump(mode='json'), ())


def _first_difference(
    one: object, other: object, path: tuple[str, ...]
) -> tuple[str, object, object] | None:
    if isinstance(one, list) and isinstance(other, list):
        one, other = dict(enumerate(one)), dict(enumerate(other))
    if isinstance(one, dict) and isinstance(other, dict):
        for name in dict.fromkeys((*one, *other)):
            found = _first_difference(one.get(name), other.get(name), (*path, str(name)))
            if found is not None:
                return found
        return None
    return None if one == other else ('/'.join(path), one, other)


def first_problem(err: Exception) -> str:
    """Return in one line what is wrong with a document: of a schema's findings the first one."""
    if not isinstance(err, ValidationError):
        return str(err)
    first, *others = err.errors(include_url=False, include_input=False)
    where = '.'.join(str(part) for part in first['loc'])
    what = f'{where}: {first["msg"]}' if where else str(first['msg'])
    return f'{what}, and {len(others)} more' if others else what


def omitted(default: object) -> Any:
    """Return a field that is left out of documents when it has its default.

    For what was added after documents were written: digests of specifications that do not use it
    stay what they were.
    """
    return Field(
        default=default,
        exclude_if=lambda value: bool(value == default),
        json_schema_extra={OMITTED: True},
    )
