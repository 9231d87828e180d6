# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg list` and `ros2 pkg executables`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import executables, package_prefixes
from aurora_ros2cli.verbs import add_verbs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the verbs of the command."""
    verbs = add_verbs(parser)
    listing = verbs.add_parser('list', help='Output a list of available packages')
    listing.set_defaults(main=list_packages)
    programs = verbs.add_parser(
        'executables', help='Output a list of package specific executables'
    )
    programs.add_argument('package_name', nargs='?', help='The package name')
    programs.add_argument(
        '--full-path', action='store_true', help='Show full path of each executable'
    )
    programs.set_defaults(main=list_executables)


def list_packages(_arguments: argparse.Namespace) -> int:
    """Print the names of all packages."""
    for name in sorted(package_prefixes()):
        emit(name)
    return 0


def list_executables(arguments: argparse.Namespace) -> int:
    """Print package and executable, one pair a line."""
    named = arguments.package_name
    for name in sorted(package_prefixes()) if named is None else [named]:
        for path in executables(name):
            emit(str(path) if arguments.full_path else f'{name} {path.name}')
    return 0
