# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench`: measurements of `aurora_bench` as commands; options are theirs."""

from __future__ import annotations

import importlib
from collections.abc import Sequence

from aurora_cli.output import USAGE

_ARGPARSE_USAGE = 2


def bench_command(package: str, arguments: Sequence[str]) -> int:
    """Run a measurement and return its exit code."""
    module = importlib.import_module(f'aurora_bench.{package}.__main__')
    try:
        return int(module.main(list(arguments)))
    except SystemExit as end:  # argparse: help, or options that it does not know
        return USAGE if end.code == _ARGPARSE_USAGE else int(end.code or 0)
