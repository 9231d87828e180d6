# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param set`."""

from __future__ import annotations

import argparse
import sys

from rcl_interfaces.msg import Parameter
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import get_parameter_value

from aurora_ros2cli.calling import add_node_arguments, call, node_that_sees
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser)
    parser.add_argument('parameter_name', help='Name of the parameter')
    parser.add_argument('value', help='Value of the parameter, in YAML')


def main(arguments: argparse.Namespace) -> int:
    """Set a parameter; a refusal goes to standard error with exit code 0, as in ros2cli.

    Raises:
        CliError: If the node is not there.
    """
    parameter = Parameter(
        name=arguments.parameter_name, value=get_parameter_value(arguments.value)
    )
    with node_that_sees(arguments) as (node, other):
        request = SetParameters.Request(parameters=[parameter])
        (result,) = call(node, SetParameters, f'{other}/set_parameters', request).results
    reason = f': {result.reason}' if result.reason else ''
    if result.successful:
        emit(f'Set parameter successful{reason}')
    else:
        sys.stderr.write(f'Setting parameter failed{reason}\n')
    return 0
