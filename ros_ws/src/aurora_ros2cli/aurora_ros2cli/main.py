# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Dispatches `ros2 COMMAND [VERB] …`; imports only the module of the verb that is called."""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress

from aurora_ros2cli.commands import COMMANDS, Group, Verb
from aurora_ros2cli.errors import CliError

EXIT_FAILURE = 1
EXIT_INTERRUPTED = 2  # what ros2cli returns after Ctrl-C: the number of SIGINT


def main(arguments: Sequence[str]) -> int:
    """Run one command.

    Args:
        arguments: The command line without the program's name.

    Returns:
        The exit code: 0, 1 after a failure, 2 after Ctrl-C; a usage error exits with 2 at once.
    """
    parser = _parser([word for word in arguments if not word.startswith('-')])
    parsed = parser.parse_args(list(arguments))
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


def _parser(words: Sequence[str]) -> argparse.ArgumentParser:
    """Build the parser for a command line.

    Args:
        words: The words that are no options; the first two select what is imported.
    """
    parser = argparse.ArgumentParser(
        prog='ros2',
        description='ros2 is an extensible command-line tool for ROS 2.\n\n'
        '(This is the small stand-in of AURORA, used where no full ROS 2 is installed.)',
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        '--use-python-default-buffering',
        action='store_true',
        help='Accepted as by the full ros2; output is passed on line by line either way.',
    )
    called = words[0] if words else ''
    for name, command in _add_all(parser, COMMANDS, 'command').items():
        if name != called:
            continue
        entry = COMMANDS[name]
        if isinstance(entry, Verb):
            _load(entry, command)
            continue
        verb = words[1] if len(words) > 1 else ''
        for verb_name, verb_parser in _add_all(command, entry.verbs, 'verb').items():
            if verb_name == verb:
                _load(entry.verbs[verb], verb_parser)
    return parser


def _add_all(
    parser: argparse.ArgumentParser, entries: Mapping[str, Verb | Group], dest: str
) -> dict[str, argparse.ArgumentParser]:
    """Offer entries as sub-commands; without one of them the help is printed."""

    def show_help(_arguments: argparse.Namespace) -> int:
        parser.print_help()
        return 0

    parser.set_defaults(main=show_help)
    width = max(map(len, entries))
    added = parser.add_subparsers(
        title='Commands',
        description='\n'.join(f'{name:<{width}}  {entries[name].help}' for name in entries),
        metavar=f'Call `{parser.prog} <command> -h` for more detailed usage.',
        dest=dest,
    )
    return {
        name: added.add_parser(
            name,
            prog=f'{parser.prog} {name}',
            description=entry.help,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        for name, entry in entries.items()
    }


def _load(verb: Verb, parser: argparse.ArgumentParser) -> None:
    module = importlib.import_module(f'aurora_ros2cli.{verb.module}')
    # Options of some shared verbs depend on the command they stand under.
    parser.set_defaults(main=module.main)
    module.add_arguments(parser)
