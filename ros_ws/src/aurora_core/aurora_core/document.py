# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The base of every value that is handed on: frozen, closed, keyword-only."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

# In the JSON schema: the field is left out of a document when it has its default.
OMITTED = 'x-omitted-when-default'


class Document(BaseModel):
    """Base of every value that a stage hands on: frozen, closed, keyword-only."""

    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)


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
