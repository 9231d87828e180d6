# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`options_json` of services and actions: every setting of a run but its prompt."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from aurora_core.errors import SpecError
from aurora_core.pipeline.stages import RunRequest, request_of

# The short name that people type, and the field it stands for.
_SHORT_NAMES = {'map': 'map_name'}
_RUNS_DIRECTORY = 'out'
_PROCESSES = 'jobs'


def options_json(request: RunRequest) -> str:
    """Return the options of a request."""
    return request.model_dump_json(exclude={'prompt'})


def run_request(prompt: str, options: str) -> RunRequest:
    """Return the request of a prompt and its options ('' = defaults).

    Raises:
        SpecError: The options are not a JSON object of known names and values.
    """
    fields = {_SHORT_NAMES.get(name, name): value for name, value in _given(options).items()}
    for other in (_RUNS_DIRECTORY, _PROCESSES):
        fields.pop(other, None)
    return request_of({**fields, 'prompt': prompt}, 'options_json')


def runs_directory(options: str) -> Path | None:
    """Return the folder for the run folder that the options name as `out`, None without one.

    Raises:
        SpecError: It is not an absolute path, or the options are not valid.
    """
    named = _given(options).get(_RUNS_DIRECTORY)
    if named is None:
        return None
    if not isinstance(named, str) or not Path(named).is_absolute():
        raise SpecError(
            f'expected an absolute path as {_RUNS_DIRECTORY}, found {named!r}',
            hint='the node and its client may run in different folders',
        )
    return Path(named)


def repair_processes(options: str) -> int | None:
    """Return how many processes the options name as `jobs`, None where they name none.

    Raises:
        SpecError: It is no number from 1 on, or the options are not valid.
    """
    named = _given(options).get(_PROCESSES)
    if named is None:
        return None
    if not isinstance(named, int) or isinstance(named, bool) or named < 1:
        raise SpecError(f'options_json: expected a number from 1 on as jobs, found {named!r}')
    return named


def _given(options: str) -> dict[str, Any]:
    try:
        given = json.loads(options) if options else {}
    except (ValueError, RecursionError) as err:
        raise SpecError(f'options_json is not JSON: {err}') from err
    if not isinstance(given, dict):
        raise SpecError(f'options_json: expected a JSON object, found {given!r}')
    _check_text(given)
    return given


def _check_text(given: dict[str, Any]) -> None:
    """Refuse what JSON can write and no string of an answer can carry."""
    text = json.dumps(given, ensure_ascii=False)
    try:
        text.encode('utf-8')
    except UnicodeEncodeError as err:
        raise SpecError('options_json: expected Unicode, found a lone surrogate') from err
    if '\\u0000' in text:
        raise SpecError('options_json: expected no NUL in a string, found one')
