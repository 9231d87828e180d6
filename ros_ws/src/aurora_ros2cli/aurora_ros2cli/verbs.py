# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sub-commands: `ros2 topic list` and the like."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    SubParsers = argparse._SubParsersAction[argparse.ArgumentParser]


def add_verbs(parser: argparse.ArgumentParser) -> SubParsers:
    """Prepare a command for verbs; without one its help is printed."""

    def show_help(_arguments: argparse.Namespace) -> int:
        parser.print_help()
        return 0

    parser.set_defaults(main=show_help)
    return parser.add_subparsers(
        title='Commands',
        metavar=f'Call `{parser.prog} <command> -h` for more detailed usage.',
    )
