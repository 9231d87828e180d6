# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which interfaces the packages of the environment have."""

from __future__ import annotations

import argparse

from aurora_ros2cli.packages import package_prefixes

# Kind → the word for it in options and headings.
KINDS = {'msg': 'Messages', 'srv': 'Services', 'action': 'Actions'}


def add_kind_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that select kinds."""
    parser.add_argument(
        '-m', '--only-msgs', action='store_true', help='Print out only the message types'
    )
    parser.add_argument(
        '-s', '--only-srvs', action='store_true', help='Print out only the service types'
    )
    parser.add_argument(
        '-a', '--only-actions', action='store_true', help='Print out only the action types'
    )


def chosen_kinds(arguments: argparse.Namespace) -> list[str]:
    """Return the kinds that were asked for: all, unless some were named."""
    named = [kind for kind in KINDS if getattr(arguments, f'only_{kind}s')]
    return named or list(KINDS)


def interfaces(kind: str, package: str | None = None) -> list[str]:
    """Return the names of interfaces, sorted.

    Args:
        kind: `msg`, `srv` or `action`.
        package: Only of this package.

    Returns:
        Names such as `std_msgs/msg/String`.
    """
    return sorted(
        f'{name}/{kind}/{path.stem}'
        for name, prefix in package_prefixes().items()
        if package in (None, name)
        for path in (prefix / 'share' / name / kind).glob(f'*.{kind}')
    )
