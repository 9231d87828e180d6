# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg executables`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import executables, package_prefixes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument('package_name', nargs='?', help='The package name')
    parser.add_argument(
        '--full-path', action='store_true', help='Show full path of each executable'
    )


def main(arguments: argparse.Namespace) -> int:
    """Print package and executable, one pair a line.

    Raises:
        CliError: If there is no such package.
    """
    named = arguments.package_name
    for name in sorted(package_prefixes()) if named is None else [named]:
        for path in executables(name):
            emit(str(path) if arguments.full_path else f'{name} {path.name}')
    return 0
