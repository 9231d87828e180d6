# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 daemon status|stop`: there is none, which is what both say."""

from __future__ import annotations

import argparse

from aurora_ros2cli.output import emit


def add_arguments(_parser: argparse.ArgumentParser) -> None:
    """Declare nothing."""


def main(_arguments: argparse.Namespace) -> int:
    """Print the words of ros2cli for a daemon that does not run."""
    emit('The daemon is not running')
    return 0
