# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A record: something that AURORA knows, in words to search by and in values to show."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable

from pydantic import JsonValue

from aurora_core.document import Document
from aurora_core.outcomes.retrieval import RecordKind


class Record(Document):
    """One entry of the knowledge base.

    Attributes:
        id: Unique in its kind.
        text: Words by which it is found.
        source: File below the configuration folder (or package data) that its values are read
            from, or the run that it is the record of.
        data: Values as a model is shown them: SI units, ENU map metres.
    """

    kind: RecordKind
    id: str
    text: str
    source: str
    data: dict[str, JsonValue]


def corpus_sha256(records: Iterable[Record]) -> str:
    """Return a digest of records: equal for equal records in any order."""
    lines = sorted(record.model_dump_json() for record in records)
    return hashlib.sha256('\n'.join(lines).encode('utf-8')).hexdigest()
