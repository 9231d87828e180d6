# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs of `ros2 param` ask a node."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python

from aurora_ros2cli.calling import call

LIST = '/list_parameters'
TYPE_WORDS = {
    ParameterType.PARAMETER_BOOL: 'boolean',
    ParameterType.PARAMETER_INTEGER: 'integer',
    ParameterType.PARAMETER_DOUBLE: 'double',
    ParameterType.PARAMETER_STRING: 'string',
    ParameterType.PARAMETER_BYTE_ARRAY: 'byte array',
    ParameterType.PARAMETER_BOOL_ARRAY: 'boolean array',
    ParameterType.PARAMETER_INTEGER_ARRAY: 'integer array',
    ParameterType.PARAMETER_DOUBLE_ARRAY: 'double array',
    ParameterType.PARAMETER_STRING_ARRAY: 'string array',
    ParameterType.PARAMETER_NOT_SET: 'not set',
}


def list_parameters(node: Node, other: str, prefixes: Sequence[str] = ()) -> list[str]:
    """Return the names of a node's parameters, sorted.

    Raises:
        CliError: If the node does not answer.
    """
    request = ListParameters.Request(prefixes=list(prefixes))
    return sorted(call(node, ListParameters, other + LIST, request).result.names)


def describe_parameters(node: Node, other: str, names: Sequence[str]) -> list[Any]:
    """Return the descriptors of parameters (`rcl_interfaces/msg/ParameterDescriptor`).

    Raises:
        CliError: If the node does not answer.
    """
    request = DescribeParameters.Request(names=list(names))
    return list(
        call(node, DescribeParameters, f'{other}/describe_parameters', request).descriptors
    )


def get_parameters(node: Node, other: str, names: Sequence[str]) -> list[Any]:
    """Return the values of parameters (`rcl_interfaces/msg/ParameterValue`).

    Raises:
        CliError: If the node does not answer.
    """
    request = GetParameters.Request(names=list(names))
    return list(call(node, GetParameters, f'{other}/get_parameters', request).values)


def plain(value: Any) -> Any:
    """Return the value of a parameter as Python has it; arrays become lists."""
    found = parameter_value_to_python(value)
    if isinstance(found, (bool, int, float, str)) or found is None:
        return found
    return [item if not isinstance(item, bytes) else int.from_bytes(item) for item in found]
