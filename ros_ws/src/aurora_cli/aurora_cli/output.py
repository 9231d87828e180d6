# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Standard output carries the answer alone; everything else goes to standard error."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from aurora_core.errors import AuroraError
from aurora_core.report.visible import visible, visible_json

if TYPE_CHECKING:
    from pydantic import BaseModel
    from rich.console import Console

# Exit code of a broken command; the table is in report/status.py, whose import takes time.
BROKEN = 4
USAGE = 64
INTERRUPTED = 130


class UsageProblem(Exception):  # noqa: N818  (a mistake of the user, not an error of ours)
    """The command line asks for something that cannot be: exit code 64."""


def say(text: str) -> None:
    """Write a line to standard error; what a terminal would obey in it is shown instead."""
    sys.stderr.write(f'{visible(text)}\n')
    sys.stderr.flush()


def answer_console() -> Console:
    """Return the console of standard output (colours only in a terminal, NO_COLOR heeded)."""
    from rich.console import Console

    return Console(file=sys.stdout)


def print_json(document: BaseModel | dict[str, Any]) -> None:
    """Write one JSON document to standard output."""
    value = document if isinstance(document, dict) else document.model_dump(mode='json')
    text = json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False)
    sys.stdout.write(visible_json(text) + '\n')
    sys.stdout.flush()


def print_error(err: AuroraError, *, as_json: bool) -> None:
    """Tell what broke and what to do."""
    say(f'aurora: {err.component}: {err.message}')
    if err.hint:
        say(f'        {err.hint}')
    if as_json:
        print_json(
            {
                'status': 'error',
                'error': {
                    'code': err.code,
                    'component': err.component,
                    'message': err.message,
                    'hint': err.hint,
                },
            }
        )


@contextmanager
def quiet_stdout() -> Iterator[None]:
    """Send what libraries print (also from C) to standard error meanwhile."""
    sys.stdout.flush()
    try:
        saved = os.dup(1)
    except OSError:
        # Standard output is closed: there is nothing to keep clean.
        yield
        return
    try:
        os.dup2(2, 1)
        yield
    finally:
        sys.stdout.flush()
        os.dup2(saved, 1)
        os.close(saved)
