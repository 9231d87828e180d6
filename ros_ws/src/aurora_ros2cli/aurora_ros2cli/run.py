# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 run`: replaces this process by an executable of a package."""

from __future__ import annotations

import argparse
import os
import shlex
import sys

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.packages import executables


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the command."""
    parser.add_argument('--prefix', help='command that goes before the executable')
    parser.add_argument('package_name', help='Name of the ROS package')
    parser.add_argument('executable_name', help='Name of the executable')
    parser.add_argument(
        'argv', nargs=argparse.REMAINDER, help='Pass arbitrary arguments to the executable'
    )
    parser.set_defaults(main=main)


def main(arguments: argparse.Namespace) -> int:
    """Execute in place of this process, so that signals and the exit code pass through.

    Raises:
        CliError: If package or executable do not exist, or several match.
    """
    wanted = arguments.executable_name
    paths = [path for path in executables(arguments.package_name) if path.name == wanted]
    if not paths:
        raise CliError('No executable found')
    if len(paths) > 1:
        raise CliError('\n- '.join(['Multiple executables found:', *map(str, paths)]))
    prefix = shlex.split(arguments.prefix) if arguments.prefix else []
    command = [*prefix, str(paths[0]), *arguments.argv]
    sys.stdout.flush()
    try:
        os.execvp(command[0], command)
    except OSError as err:
        raise CliError(f'{command[0]}: {err.strerror}') from err
