# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 interface list`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.interface.index import KINDS, add_kind_arguments, chosen_kinds, interfaces
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_kind_arguments(parser)


def main(arguments: argparse.Namespace) -> int:
    """Print every interface below the heading of its kind."""
    for kind in chosen_kinds(arguments):
        emit(f'{KINDS[kind]}:')
        for name in interfaces(kind):
            emit(f'    {name}')
    return 0
