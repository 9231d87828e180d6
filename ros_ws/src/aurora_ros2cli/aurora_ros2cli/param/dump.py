# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param dump`."""

from __future__ import annotations

import argparse
from typing import Any

import yaml

from aurora_ros2cli.calling import add_node_arguments, node_that_sees
from aurora_ros2cli.output import emit
from aurora_ros2cli.param.services import get_parameters, list_parameters, plain


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser)


def main(arguments: argparse.Namespace) -> int:
    """Print all parameters of a node as a file that `--params-file` takes.

    Raises:
        CliError: If the node is not there or does not answer.
    """
    with node_that_sees(arguments) as (node, other):
        names = list_parameters(node, other)
        values = [plain(value) for value in get_parameters(node, other, names)]
    tree = {other: {'ros__parameters': nested(dict(zip(names, values, strict=True)))}}
    emit(yaml.safe_dump(tree, default_flow_style=False, allow_unicode=True))
    return 0


def nested(values: dict[str, Any]) -> dict[str, Any]:
    """Turn dotted names into a tree; a name that is also a prefix stays dotted."""
    tree: dict[str, Any] = {}
    for name, value in sorted(values.items()):
        *groups, leaf = name.split('.')
        branch = tree
        for group in groups:
            below = branch.setdefault(group, {})
            if not isinstance(below, dict):
                branch, leaf = tree, name
                break
            branch = below
        branch[leaf] = value
    return tree
