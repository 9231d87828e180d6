# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora bench outcome FILE…`: prompt to verdict, and whether the verdict is right."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.rulers.command import Ruler, measure
from aurora_bench.rulers.runs import OutcomeWork
from aurora_llm.parse import check_model_name


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('--model', default='offline', help='who reads, as in aurora run')
    parser.add_argument(
        '--transcripts',
        type=Path,
        default=None,
        metavar='DIR',
        help='recorded replies in place of the models',
    )


def _work(options: argparse.Namespace, folder: Path) -> OutcomeWork:
    return OutcomeWork(
        folder=folder,
        keep=options.keep is not None,
        map_name=options.map,
        repair=options.repair,
        model=options.model,
        transcripts=options.transcripts,
    )


OUTCOME = Ruler(
    name='outcome',
    about='Prompts that end with the right verdict',
    word='right outcome',
    of='',
    takes=lambda _prompt: True,
    work=_work,
    add_options=_add_options,
    check_options=lambda options: check_model_name(options.model),
    own_options=('model', 'transcripts'),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code."""
    return measure(OUTCOME, arguments)


if __name__ == '__main__':
    sys.exit(main())
