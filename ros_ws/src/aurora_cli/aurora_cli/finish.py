# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What every command shares: options of the answer, and how it ends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, NoReturn

import typer

from aurora_cli.output import BROKEN, print_error
from aurora_core.errors import AuroraError

Json = Annotated[bool, typer.Option('--json', help='One JSON document on standard output.')]
Quiet = Annotated[
    bool, typer.Option('-q', '--quiet', help='The verdict and what to do alone; no progress.')
]


def finish(command: Callable[[], int], *, as_json: bool) -> NoReturn:
    """Run a command and leave with its exit code; what broke is told, never dumped."""
    try:
        code = command()
    except AuroraError as err:
        print_error(err, as_json=as_json)
        code = BROKEN
    raise typer.Exit(code)
