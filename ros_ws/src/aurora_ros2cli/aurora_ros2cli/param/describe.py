# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param describe`."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

from aurora_ros2cli.calling import add_node_arguments, node_that_sees
from aurora_ros2cli.output import emit
from aurora_ros2cli.param.services import TYPE_WORDS, describe_parameters


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser)
    parser.add_argument('parameter_names', nargs='+', help='Names of the parameters')


def main(arguments: argparse.Namespace) -> int:
    """Print type, description and limits of parameters.

    Raises:
        CliError: If the node is not there or does not answer.
    """
    with node_that_sees(arguments) as (node, other):
        for descriptor in describe_parameters(node, other, arguments.parameter_names):
            for line in _lines(descriptor):
                emit(line)
    return 0


def _lines(descriptor: Any) -> Iterator[str]:
    yield f'Parameter name: {descriptor.name}'
    yield f'  Type: {TYPE_WORDS.get(descriptor.type, "unknown")}'
    if descriptor.description:
        yield f'  Description: {descriptor.description}'
    yield '  Constraints:'
    if descriptor.read_only:
        yield '    Read only: true'
    # A parameter has at most one range, of the kind of its own type.
    for limits in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        yield f'    Min value: {limits.from_value}'
        yield f'    Max value: {limits.to_value}'
        if limits.step:
            yield f'    Step: {limits.step}'
    if descriptor.additional_constraints:
        yield f'    Additional constraints: {descriptor.additional_constraints}'
