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

_BUFFERING = '--use-python-default-buffering'

EXIT_FAILURE = 1
EXIT_INTERRUPTED = 2  # what ros2cli returns after Ctrl-C: the number of SIGINT


def main(arguments: Sequence[str]) -> int:
    """Run one command.

    Args:
        arguments: The command line without the program's name.

    Returns:
        The exit code: 0, 1 after a failure, 2 after Ctrl-C; a usage error exits with 2 at once.
    """
    rest = list(arguments)
    if rest[:1] == [_BUFFERING]:
        rest.pop(0)
    try:
        parser, rest = _parser(rest)
        parsed = parser.parse_args(rest)
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


def _parser(words: list[str]) -> tuple[argparse.ArgumentParser, list[str]]:
    """Return the parser of the verb that is called, and the words that are left for it.

    The table is walked by hand: sub-parsers of argparse cost more than all the rest of `ros2 run`.
    They only serve where no verb is named, to print help or the usage.
    """
    parser = argparse.ArgumentParser(
        prog='ros2',
        description='ros2 is an extensible command-line tool for ROS 2.\n\n'
        '(This is the small stand-in of AURORA, used where no full ROS 2 is installed.)',
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        _BUFFERING,
        action='store_true',
        help='Accepted as by the full ros2; output is passed on line by line either way.',
    )
    entries: Mapping[str, Verb | Group] = COMMANDS
    for depth, word in enumerate(words):
        if word not in entries:
            break
        entry = entries[word]
        parser = argparse.ArgumentParser(
            prog=f'{parser.prog} {word}',
            description=entry.help,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        if isinstance(entry, Verb):
            module = importlib.import_module(f'aurora_ros2cli.{entry.module}')
            parser.set_defaults(main=module.main, command=words[0])
            module.add_arguments(parser)
            return parser, words[depth + 1 :]
        entries = entry.verbs
    _offer(parser, entries)
    return parser, words[len(parser.prog.split()) - 1 :]


def _offer(parser: argparse.ArgumentParser, entries: Mapping[str, Verb | Group]) -> None:
    """Let a parser print its help, and the usage after a word that is no entry."""

    def show_help(_arguments: argparse.Namespace) -> int:
        parser.print_help()
        return 0

    parser.set_defaults(main=show_help)
    width = max(map(len, entries))
    choices = parser.add_subparsers(
        title='Commands',
        description='\n'.join(f'{name:<{width}}  {entries[name].help}' for name in entries),
        metavar=f'Call `{parser.prog} <command> -h` for more detailed usage.',
    )
    for name in entries:
        choices.add_parser(name)
