# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 doctor` and its alias `ros2 wtf`."""

from __future__ import annotations

import argparse
import sys

from aurora_ros2cli.doctor.checks import CHECKS
from aurora_ros2cli.doctor.report import print_report
from aurora_ros2cli.graph import add_look_arguments, settled_node
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    what = parser.add_mutually_exclusive_group()
    what.add_argument('-r', '--report', action='store_true', help='Print all reports.')
    what.add_argument(
        '-rf', '--report-failed', action='store_true', help='Print reports of failed checks only.'
    )
    parser.add_argument(
        '-iw', '--include-warnings', action='store_true', help='Count warnings as failures.'
    )


def main(arguments: argparse.Namespace) -> int:
    """Check the set-up, or print all that is known about it."""
    with settled_node(arguments) as node:
        if arguments.report:
            print_report(node)
            return 0
        failed = []
        for name, check in CHECKS.items():
            findings = check(node)
            for finding in findings:
                kind = 'ERROR' if finding.error else 'WARNING'
                sys.stderr.write(f'{name}: {kind}: {finding.text}\n')
            if any(finding.error or arguments.include_warnings for finding in findings):
                failed.append(name)
        if not failed:
            emit(f'\nAll {len(CHECKS)} checks passed\n')
            return 0
        emit(f'\n{len(failed)}/{len(CHECKS)} check(s) failed\n')
        emit(f'Failed modules: {" ".join(failed)}')
        if arguments.report_failed:
            print_report(node, failed)
        return 1
