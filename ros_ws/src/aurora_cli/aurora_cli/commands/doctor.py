# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora doctor`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_cli.doctor.machine import Machine
from aurora_cli.doctor.run import CHECKS, as_json, as_lines, check, fix
from aurora_cli.output import print_json, say
from aurora_core.report.visible import one_line


def doctor_command(machine: Machine, *, repair: bool, json_wanted: bool) -> int:
    """Run every check and return the exit code: 0 clean, 1 findings are left.

    Args:
        machine: What is looked at.
        repair: Remove what is provably ours and dead, close unfinished runs.
        json_wanted: One JSON document instead of lines.
    """
    results = []
    for name, function in CHECKS:
        result = check(name, function, machine)
        if repair:
            result = fix(result, machine)
        results.append(result)
        if json_wanted:
            say(f'aurora: {name}: {result.open or "no"} finding{"" if result.open == 1 else "s"}')
        else:
            for text in as_lines(machine, result):
                sys.stdout.write(f'{one_line(text)}\n')
            sys.stdout.flush()
    left = sum(result.open for result in results)
    if json_wanted:
        print_json(as_json(machine, results))
    else:
        told = 'nothing to complain about' if left == 0 else f'{left} left to deal with'
        sys.stdout.write(f'{len(results)} checks, {told}\n')
    return 1 if left else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the doctor by itself, without the rest of the command line."""
    parser = argparse.ArgumentParser(prog='doctor', description='What is wrong with this machine?')
    parser.add_argument('--json', action='store_true', help='one JSON document on standard output')
    parser.add_argument('--fix', action='store_true', help='remove what is provably ours and dead')
    parser.add_argument(
        '--runs', type=Path, default=Path('runs'), help='folder of the run folders'
    )
    parser.add_argument('--model', default='offline', help='language model')
    options = parser.parse_args(arguments)
    machine = Machine(runs=options.runs, model=options.model)
    return doctor_command(machine, repair=options.fix, json_wanted=options.json)
