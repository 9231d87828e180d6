# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A prompt file as plain documents, for tools that write into it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from aurora_bench.prompts.reading import file_text
from aurora_bench.results import write_whole

Doc = dict[str, Any]


def read_documents(path: Path) -> list[Doc]:
    """Return the lines of a prompt file, with the fields and the order that they have there.

    Raises:
        ResultsError: It cannot be read or is not UTF-8.
    """
    return [json.loads(line) for line in file_text(path).split('\n') if line.strip()]


def write_documents(path: Path, documents: Iterable[Doc]) -> None:
    """Write a prompt file whole or not at all.

    Raises:
        ResultsError: It cannot be written.
    """
    text = ''.join(json.dumps(document, ensure_ascii=False) + '\n' for document in documents)
    write_whole(path, text.encode())
