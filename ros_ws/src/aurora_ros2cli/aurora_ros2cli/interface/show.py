# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 interface show`: the definition of a type, nested types indented below their field."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.interface.index import KINDS
from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import package_prefix

# Type of a field: "Name", "package/Name", possibly with a length bound or brackets, then a
# field name that is not a constant.
_FIELD = re.compile(
    r'^([A-Za-z]\w*(?:/[A-Za-z]\w*)?)(?:<=\d+)?(?:\[[^\]]*\])?\s+[A-Za-z]\w*\s*([^=\s].*)?$'
)
_BUILT_IN = re.compile(r'^(bool|byte|char|w?string|u?int(8|16|32|64)|float(32|64))$')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    comments = parser.add_mutually_exclusive_group()
    comments.add_argument(
        '--all-comments', action='store_true', help='Show all comments, also of nested types'
    )
    comments.add_argument(
        '--no-comments', action='store_true', help='Show no comments or whitespace'
    )
    parser.add_argument(
        'type', help="Interface (e.g. 'std_msgs/msg/String'); '-' reads it from stdin"
    )


def main(arguments: argparse.Namespace) -> int:
    """Print a definition.

    Raises:
        CliError: If the name is malformed or names nothing.
    """
    name = sys.stdin.readline().strip() if arguments.type == '-' else arguments.type
    for line in definition(
        name, comments=not arguments.no_comments, nested_comments=arguments.all_comments
    ):
        emit(line)
    return 0


def definition(
    name: str, *, comments: bool, nested_comments: bool, indent: int = 0
) -> Iterator[str]:
    """Yield the lines of a definition.

    Args:
        name: `package/kind/Name`.
        comments: Whether comments and empty lines are kept at this level.
        nested_comments: The same for the types inside.
        indent: Depth of nesting; one tab each.
    """
    package = name.split('/')[0]
    for raw in definition_path(name).read_text(encoding='utf-8').splitlines():
        line = raw.rstrip()
        code = line.split('#')[0].rstrip()
        if comments or code:
            shown = line if comments else code
            yield '\t' * indent + shown if shown else ''
        nested = nested_type(code, package)
        if nested is not None:
            yield from definition(
                nested,
                comments=nested_comments,
                nested_comments=nested_comments,
                indent=indent + 1,
            )


def nested_type(code: str, package: str) -> str | None:
    """Return the message type of a field, or None for built-in types and other lines.

    Args:
        code: A line without its comment.
        package: Package of the definition; a type without one belongs to it.
    """
    field = _FIELD.match(code.strip())
    if field is None or _BUILT_IN.match(field[1]):
        return None
    owner, _, name = field[1].rpartition('/')
    return f'{owner or package}/msg/{name}'


def definition_path(name: str) -> Path:
    """Return the file that defines an interface.

    Args:
        name: `package/kind/Name`.

    Raises:
        CliError: If the name is malformed or names nothing.
    """
    parts = name.split('/')
    if len(parts) != 3 or parts[1] not in KINDS:
        raise CliError(f"Invalid name '{name}'. Expected three parts separated by '/'")
    package, kind, base = parts
    path = package_prefix(package) / 'share' / package / kind / f'{base}.{kind}'
    if not path.is_file():
        raise CliError(f"Could not find the interface '{name}'")
    return path
