# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The base of every value that is handed on, and its one JSON text."""

from __future__ import annotations

import json
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

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
