# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param get`."""

from __future__ import annotations

import argparse

from rcl_interfaces.msg import ParameterType

from aurora_ros2cli.calling import add_node_arguments, node_that_sees
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.output import emit
from aurora_ros2cli.param.services import get_parameters, plain

LABELS = {
    ParameterType.PARAMETER_BOOL: 'Boolean value is:',
    ParameterType.PARAMETER_INTEGER: 'Integer value is:',
    ParameterType.PARAMETER_DOUBLE: 'Double value is:',
    ParameterType.PARAMETER_STRING: 'String value is:',
    ParameterType.PARAMETER_BYTE_ARRAY: 'Byte values are:',
    ParameterType.PARAMETER_BOOL_ARRAY: 'Boolean values are:',
    ParameterType.PARAMETER_INTEGER_ARRAY: 'Integer values are:',
    ParameterType.PARAMETER_DOUBLE_ARRAY: 'Double values are:',
    ParameterType.PARAMETER_STRING_ARRAY: 'String values are:',
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser)
    parser.add_argument('parameter_name', help='Name of the parameter')
    parser.add_argument('--hide-type', action='store_true', help='Hide the type information')


def main(arguments: argparse.Namespace) -> int:
    """Print the value of a parameter.

    Raises:
        CliError: If the node is not there or does not have the parameter.
    """
    with node_that_sees(arguments) as (node, other):
        values = get_parameters(node, other, [arguments.parameter_name])
    if not values:
        raise CliError('Parameter not set')
    (value,) = values
    if value.type == ParameterType.PARAMETER_NOT_SET:
        emit('None' if arguments.hide_type else 'Parameter not set.')
        return 0
    text = plain(value)
    emit(str(text) if arguments.hide_type else f'{LABELS[value.type]} {text}')
    return 0
