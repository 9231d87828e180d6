# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 interface packages`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.interface.index import add_kind_arguments, chosen_kinds, interfaces
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_kind_arguments(parser)


def main(arguments: argparse.Namespace) -> int:
    """Print the names of the packages that have interfaces."""
    kinds = chosen_kinds(arguments)
    found = {name.partition('/')[0] for kind in kinds for name in interfaces(kind)}
    for name in sorted(found):
        emit(name)
    return 0
