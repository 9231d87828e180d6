# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 interface package`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.interface.index import add_kind_arguments, chosen_kinds, interfaces
from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import package_prefixes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_kind_arguments(parser)
    parser.add_argument('package_name', help="Name of the ROS package (e.g. 'example_interfaces')")


def main(arguments: argparse.Namespace) -> int:
    """Print the interfaces of one package.

    Raises:
        CliError: If there is no such package.
    """
    package = arguments.package_name
    if package not in package_prefixes():
        raise CliError(f"Unknown package '{package}'")
    for kind in chosen_kinds(arguments):
        for name in interfaces(kind, package):
            emit(name)
    return 0
