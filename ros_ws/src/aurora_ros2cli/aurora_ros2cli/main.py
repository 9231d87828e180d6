# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Dispatches `ros2 COMMAND [VERB] …`; imports only the module of the command that is called."""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Sequence
from contextlib import suppress

from aurora_ros2cli.errors import CliError

# Command → module, what it is for. A module offers `add_arguments(parser)`, which sets the
# default `main`: a function that takes the parsed arguments and returns the exit code.
COMMANDS = {
    'interface': ('aurora_ros2cli.interface', 'Show information about ROS interfaces'),
    'node': ('aurora_ros2cli.node', 'Various node related sub-commands'),
    'pkg': ('aurora_ros2cli.pkg', 'Various package related sub-commands'),
    'run': ('aurora_ros2cli.run', 'Run a package specific executable'),
    'service': ('aurora_ros2cli.service', 'Various service related sub-commands'),
    'topic': ('aurora_ros2cli.topic', 'Various topic related sub-commands'),
}

EXIT_FAILURE = 1
EXIT_INTERRUPTED = 2  # what ros2cli returns after Ctrl-C


def main(arguments: Sequence[str]) -> int:
    """Run one command.

    Args:
        arguments: The command line without the program's name.

    Returns:
        The exit code: 0, 1 after a failure, 2 after Ctrl-C; a usage error exits with 2 at once.
    """
    parser = _parser(arguments[0] if arguments else '')
    parsed = parser.parse_args(list(arguments))
    if not hasattr(parsed, 'main'):
        parser.print_help()
        return 0
    try:
        code: int = parsed.main(parsed)
        sys.stdout.flush()
    except CliError as err:
        sys.stderr.write(f'{err}\n')
        return EXIT_FAILURE
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    except BrokenPipeError:
        # `ros2 topic list | head -1`: nobody reads on. Python flushes once more at its end.
        with suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_FAILURE
    return code


def _parser(called: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog='ros2',
        description='The command line of ROS 2 (the small stand-in of AURORA).',
    )
    commands = parser.add_subparsers(title='Commands', metavar='COMMAND')
    for name, (module, description) in COMMANDS.items():
        command = commands.add_parser(name, help=description, description=description)
        if name == called:
            importlib.import_module(module).add_arguments(command)
    return parser
