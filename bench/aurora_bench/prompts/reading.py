# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read a prompt file; each line stands or falls by itself."""

from __future__ import annotations

import json
from pathlib import Path

from pydantic import ValidationError

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.results import ResultsError
from aurora_core.files import DOCUMENT_BYTES, read_text


def read_lines(text: str) -> tuple[tuple[AnnotatedPrompt, ...], tuple[Finding, ...]]:
    """Return the prompts that can be read and what is wrong with the other lines."""
    prompts: list[AnnotatedPrompt] = []
    findings: list[Finding] = []
    for number, line in enumerate(text.split('\n'), start=1):
        if not line.strip():
            continue
        where = f'line {number}'
        try:
            # A repeated key would silently win over the first one.
            document = json.loads(line, object_pairs_hook=_without_repetition)
        except ValueError as err:
            findings.append(Finding(where=where, rule=Rule.JSON, text=f'expected JSON: {err}'))
            continue
        if isinstance(document, dict) and isinstance(document.get('id'), str):
            where = document['id']
        try:
            prompts.append(AnnotatedPrompt.model_validate(document))
        except ValidationError as err:
            for problem in err.errors():
                path = '.'.join(str(part) for part in problem['loc'])
                text_of = f'{path}: {problem["msg"]}'
                findings.append(Finding(where=where, rule=Rule.FORMAT, text=text_of))
    return tuple(prompts), tuple(findings)


def read_prompts(path: Path) -> tuple[AnnotatedPrompt, ...]:
    """Return the prompts of a file that must be in order.

    Raises:
        ResultsError: It cannot be read, or a line is not a prompt.
    """
    prompts, findings = read_lines(file_text(path))
    if findings:
        raise ResultsError(
            f'{path} is no prompt file: {findings[0]}',
            hint=f'python -m aurora_bench.prompts {path} lists every error',
        )
    return prompts


def file_text(path: Path) -> str:
    """Return the text of a file.

    Raises:
        ResultsError: It cannot be read or is not UTF-8.
    """
    try:
        return read_text(path, DOCUMENT_BYTES)
    except (OSError, UnicodeDecodeError) as err:
        raise ResultsError(f'expected a UTF-8 prompt file at {path}: {err}') from err


def _without_repetition(pairs: list[tuple[str, object]]) -> dict[str, object]:
    keys = [key for key, _ in pairs]
    for key in keys:
        if keys.count(key) > 1:
            raise ValueError(f'key {key!r} is there twice')
    return dict(pairs)
