# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The form of an answer in a few lines: its JSON Schema is four times as long."""

from __future__ import annotations

import json
from functools import lru_cache
from typing import Any

from aurora_core.parsing.llm.reading import Reading


@lru_cache(maxsize=1)
def schema_text() -> str:
    """Return the JSON Schema of an answer, without titles and descriptions."""
    return json.dumps(_bare(Reading.model_json_schema()), sort_keys=True)


def _bare(schema: Any) -> Any:
    if isinstance(schema, dict):
        return {
            name: _bare(value)
            for name, value in schema.items()
            if name not in ('title', 'description')
        }
    return [_bare(one) for one in schema] if isinstance(schema, list) else schema


@lru_cache(maxsize=1)
def form_text() -> str:
    """Return one line per object: its fields with their types; `?` may be left out.

    A word that several fields have as their values is a line of its own, too.
    """
    schema = Reading.model_json_schema()
    kinds = schema['$defs']
    lines = [f'{_name(name)}: {_type(kind)}' for name, kind in kinds.items() if _own(kind)]
    return '\n'.join([f'Answer: {_type(schema)}', *lines])


def _own(kind: dict[str, Any]) -> bool:
    return 'properties' in kind or 'enum' in kind


def _name(reference: str) -> str:
    return reference.rsplit('/', 1)[-1].removesuffix('Reading')


def _type(schema: dict[str, Any]) -> str:
    if '$ref' in schema:
        return _name(schema['$ref'])
    if 'anyOf' in schema:
        return '|'.join(_type(one) for one in schema['anyOf'] if one.get('type') != 'null')
    if 'enum' in schema:
        return '|'.join(map(str, schema['enum']))
    if 'const' in schema:
        return str(schema['const'])
    if 'properties' in schema:
        needed = schema.get('required', [])
        fields = schema['properties'].items()
        told = (f'{name}{"" if name in needed else "?"}: {_type(field)}' for name, field in fields)
        return '{' + ', '.join(told) + '}'
    if schema['type'] == 'array':
        return f'[{_type(schema["items"])}]'
    return str(schema['type'])
