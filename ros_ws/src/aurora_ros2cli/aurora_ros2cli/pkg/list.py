# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 pkg list`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import package_prefixes


def add_arguments(_parser: argparse.ArgumentParser) -> None:
    """Declare nothing."""


def main(_arguments: argparse.Namespace) -> int:
    """Print the names of all packages."""
    for name in sorted(package_prefixes()):
        emit(name)
    return 0
