# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 launch`."""

from __future__ import annotations

import argparse
import runpy
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.launching.description import (
    Command,
    DeclareLaunchArgument,
    ExecuteProcess,
    LaunchDescription,
    Node,
    modules,
    text_of,
)
from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import package_prefix

_FUNCTION = 'generate_launch_description'


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        '-s',
        '--show-args',
        '--show-arguments',
        dest='show',
        action='store_true',
        help='Show arguments that may be given to the launch file.',
    )
    parser.add_argument(
        'package_name', help='Name of the ROS package which contains the launch file, or a path'
    )
    parser.add_argument('launch_file_name', nargs='?', help='Name of the launch file')
    parser.add_argument(
        'launch_arguments', nargs='*', help="Arguments to the launch file; '<name>:=<value>'"
    )


def main(arguments: argparse.Namespace) -> int:
    """Start what a launch file describes, until all of it has ended.

    Raises:
        CliError: The file is not there, is none, or asks for what this stand-in does not have.
    """
    path, words = _file(arguments)
    description = load(path)
    declared = [e for e in description.entities if isinstance(e, DeclareLaunchArgument)]
    if arguments.show:
        _show(declared)
        return 0
    commands = commands_of(description, _given(declared, words))
    # Imported here: to show arguments needs no process.
    from aurora_ros2cli.launching.processes import run_all

    run_all(commands)
    return 0


def _file(arguments: argparse.Namespace) -> tuple[Path, list[str]]:
    """Return the launch file, and the words that are left for it."""
    name, words = arguments.launch_file_name, list(arguments.launch_arguments)
    direct = Path(arguments.package_name)
    if direct.is_file():
        return direct, [*([] if name is None else [name]), *words]
    if name is None:
        raise CliError(
            f"'{arguments.package_name}' is no file: name a package and its launch file"
        )
    share = package_prefix(arguments.package_name) / 'share' / arguments.package_name
    found = sorted(path for path in share.rglob('*') if path.name == name)
    if not found:
        raise CliError(
            f"file '{name}' was not found in the share directory of package "
            f"'{arguments.package_name}' which is at '{share}'"
        )
    return found[0], words


def load(path: Path) -> LaunchDescription:
    """Return what a launch file describes; it is Python of the caller's own choice.

    Raises:
        CliError: It is no launch file, or needs more of `launch` than is here.
    """
    if path.suffix != '.py':
        raise CliError(f'{path}: only launch files in Python are read here')
    ours = modules()
    before = {name: sys.modules.get(name) for name in ours}
    sys.modules.update(ours)
    try:
        made = runpy.run_path(str(path)).get(_FUNCTION)
        description = None if made is None else made()
    except (ImportError, TypeError) as err:
        raise CliError(f'{path}: {err} (a full ROS 2 has the whole of launch)') from err
    finally:
        for name, module in before.items():
            if module is None:
                del sys.modules[name]
            else:
                sys.modules[name] = module
    if not isinstance(description, LaunchDescription):
        raise CliError(f'{path}: {_FUNCTION}() has to return a LaunchDescription')
    return description


def commands_of(description: LaunchDescription, given: Mapping[str, str]) -> list[Command]:
    """Return the processes that a description starts, in its order.

    Raises:
        CliError: It holds something else, or an argument has no value.
    """
    commands = []
    for entity in description.entities:
        if isinstance(entity, (Node, ExecuteProcess)):
            commands.append(entity.command(given))
        elif not isinstance(entity, DeclareLaunchArgument):
            raise CliError(f'{type(entity).__name__} cannot be launched here')
    return commands


def _given(declared: Sequence[DeclareLaunchArgument], words: Sequence[str]) -> dict[str, str]:
    given: dict[str, str] = {}
    for word in words:
        name, sign, value = word.partition(':=')
        if not sign or not name:
            raise CliError(
                f"malformed launch argument '{word}', expected format '<name>:=<value>'"
            )
        given[name] = value
    for one in declared:
        if one.name in given:
            continue
        if one.default_value is None:
            raise CliError(f"Required launch argument '{one.name}' was not provided")
        given[one.name] = text_of(one.default_value, given)
    return given


def _show(declared: Sequence[DeclareLaunchArgument]) -> None:
    emit("Arguments (pass arguments as '<name>:=<value>'):")
    if not declared:
        emit('\n  No arguments.')
    for one in declared:
        emit(f"\n    '{one.name}':\n        {one.description or 'no description given'}")
        if one.default_value is not None:
            emit(f'        (default: {_shown(one.default_value)})')


def _shown(value: Any) -> str:
    return repr(value) if isinstance(value, str) else str(value)
