# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg prefix`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import package_prefix


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument('package_name', help='The package name')
    parser.add_argument(
        '--share', action='store_true', help='Show share directory for the package'
    )


def main(arguments: argparse.Namespace) -> int:
    """Print the folder that a package was installed into.

    Raises:
        CliError: If there is no such package.
    """
    prefix = package_prefix(arguments.package_name)
    emit(str(prefix / 'share' / arguments.package_name if arguments.share else prefix))
    return 0
