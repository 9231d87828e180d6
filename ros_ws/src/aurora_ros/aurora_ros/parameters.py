# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Typed node parameters: declared by type, values from `config/<node>.param.yaml`.

No default stands in code: a value comes from the file, and the command line (`--ros-args -p` and
`--params-file`) wins over it. Parameters are read-only once the node runs.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import yaml
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy.exceptions import ParameterException
from rclpy.node import Node

from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_text
from aurora_core.knowledge.config_files import config_path

_T = TypeVar('_T')

_WIRE_TYPES: dict[Any, int] = {
    bool: ParameterType.PARAMETER_BOOL,
    int: ParameterType.PARAMETER_INTEGER,
    float: ParameterType.PARAMETER_DOUBLE,
    str: ParameterType.PARAMETER_STRING,
    tuple[str, ...]: ParameterType.PARAMETER_STRING_ARRAY,
}


def read_parameters(path: Path, settings: type[_T]) -> dict[str, Any]:
    """Read a parameter file and check its names and types against a dataclass.

    Raises:
        ConfigError: The file is damaged, or a name is missing, unknown or of another type.
    """
    hints = get_type_hints(settings)
    try:
        document = yaml.safe_load(read_text(path, CONFIG_BYTES))
        values = dict(document['/**']['ros__parameters'])
    except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError) as err:
        raise ConfigError(
            f'expected parameters under /**: ros__parameters: in {path}, but: {err!r}'
        ) from err
    if values.keys() != hints.keys():
        raise ConfigError(
            f'expected the parameters {sorted(hints)} in {path}, found {sorted(map(str, values))}'
        )
    for name, kind in hints.items():
        values[name] = _checked(values[name], kind, f'{name} in {path}')
    return values


def declare(node: Node, file_stem: str, settings: type[_T]) -> _T:
    """Declare one parameter per field of a frozen dataclass and return its values.

    Args:
        node: The node that owns the parameters.
        file_stem: `<file_stem>.param.yaml` in the configuration folder.
        settings: Dataclass whose fields are bool, int, float, str or tuple[str, ...].

    Raises:
        ConfigError: See `read_parameters`; or the command line gives a value of another type.
    """
    hints = get_type_hints(settings)
    values = read_parameters(config_path(f'{file_stem}.param.yaml'), settings)
    final: dict[str, Any] = {}
    for name, value in values.items():
        descriptor = ParameterDescriptor(name=name, type=_WIRE_TYPES[hints[name]], read_only=True)
        wire_value = list(value) if isinstance(value, tuple) else value
        try:
            parameter = node.declare_parameter(name, wire_value, descriptor)
        except ParameterException as err:
            raise ConfigError(f'parameter {name} of {node.get_name()}: {err}') from err
        final[name] = _checked(parameter.value, hints[name], name)
    try:
        return settings(**final)
    except ValueError as err:
        raise ConfigError(f'parameters of {node.get_name()}: {err}') from err


def require_positive(settings: Any, *names: str) -> None:
    """Refuse numbers that are not above zero; for `__post_init__` of settings.

    Raises:
        ValueError: With the name and the value.
    """
    for name in names:
        value = getattr(settings, name)
        if not value > 0:
            raise ValueError(f'{name} must be above 0, found {value}')


def _checked(value: Any, kind: Any, where: str) -> Any:
    if kind == tuple[str, ...]:
        if isinstance(value, list | tuple) and all(isinstance(item, str) for item in value):
            return tuple(value)
    elif type(value) is kind:
        return value
    raise ConfigError(f'{where}: expected {kind}, found {value!r}')
