# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a launch file may import from `launch` and `launch_ros`, as far as it is here.

Names and arguments are those of ROS 2's own packages, so that a file runs under both.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike, fspath
from types import ModuleType
from typing import Any

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.packages import executables


class LaunchConfiguration:
    """Stands for the value of a launch argument."""

    def __init__(self, variable_name: str) -> None:
        self.variable_name = variable_name


class DeclareLaunchArgument:
    """Names a launch argument and its default."""

    def __init__(
        self, name: str, *, default_value: str | None = None, description: str = ''
    ) -> None:
        self.name, self.default_value, self.description = name, default_value, description


class Shutdown:
    """Ends everything, as the `on_exit` of a process."""


# A text, a launch argument, or several of both one after the other.
Text = Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """A process to start.

    Attributes:
        name: Its lines begin with it.
        words: Command line.
        environment: Beside what is there.
        folder: Where it runs, None for here.
        ends_all: Its end ends the others.
    """

    name: str
    words: tuple[str, ...]
    environment: Mapping[str, str] = field(default_factory=dict)
    folder: str | None = None
    ends_all: bool = False


class ExecuteProcess:
    """A process by its command line."""

    def __init__(
        self,
        *,
        cmd: Sequence[Text],
        name: str | None = None,
        cwd: Text = None,
        additional_env: Mapping[str, Text] | None = None,
        output: str = 'log',
        on_exit: Shutdown | None = None,
    ) -> None:
        self._cmd, self._name, self._cwd = cmd, name, cwd
        self._environment, self._on_exit = additional_env or {}, on_exit

    def command(self, given: Mapping[str, str]) -> Command:
        """Return what to start.

        Args:
            given: Launch arguments.
        """
        words = tuple(text_of(word, given) for word in self._cmd)
        return Command(
            name=self._name or words[0].rpartition('/')[2],
            words=words,
            environment={k: text_of(v, given) for k, v in self._environment.items()},
            folder=None if self._cwd is None else text_of(self._cwd, given),
            ends_all=isinstance(self._on_exit, Shutdown),
        )


class Node:
    """A node by its package and executable."""

    def __init__(
        self,
        *,
        package: Text,
        executable: Text,
        name: Text = None,
        namespace: Text = None,
        parameters: Sequence[Mapping[str, Any] | str | PathLike[str]] = (),
        remappings: Sequence[tuple[Text, Text]] = (),
        arguments: Sequence[Text] = (),
        additional_env: Mapping[str, Text] | None = None,
        output: str = 'log',
        on_exit: Shutdown | None = None,
    ) -> None:
        self._package, self._executable = package, executable
        self._name, self._namespace = name, namespace
        self._parameters, self._remappings, self._arguments = parameters, remappings, arguments
        self._environment, self._on_exit = additional_env or {}, on_exit

    def command(self, given: Mapping[str, str]) -> Command:
        """Return what to start.

        Args:
            given: Launch arguments.

        Raises:
            CliError: There is no such package or executable.
        """
        package = text_of(self._package, given)
        executable = text_of(self._executable, given)
        path = next((p for p in executables(package) if p.name == executable), None)
        if path is None:
            raise CliError(f"executable '{executable}' not found in package '{package}'")
        words = [str(path), *(text_of(word, given) for word in self._arguments)]
        told = self._ros_arguments(given)
        return Command(
            name=executable,
            words=(*words, *(['--ros-args', *told] if told else [])),
            environment={k: text_of(v, given) for k, v in self._environment.items()},
            ends_all=isinstance(self._on_exit, Shutdown),
        )

    def _ros_arguments(self, given: Mapping[str, str]) -> list[str]:
        told = []
        for rule, value in (('__node', self._name), ('__ns', self._namespace)):
            if value is not None:
                told += ['-r', f'{rule}:={text_of(value, given)}']
        for old, new in self._remappings:
            told += ['-r', f'{text_of(old, given)}:={text_of(new, given)}']
        for values in self._parameters:
            if isinstance(values, Mapping):
                for key, value in values.items():
                    told += ['-p', f'{key}:={_parameter(value, given)}']
            else:
                told += ['--params-file', fspath(values)]
        return told


class LaunchDescription:
    """All that a launch file asks for, in its order."""

    def __init__(self, initial_entities: Sequence[Any] = ()) -> None:
        self.entities = list(initial_entities)

    def add_action(self, action: Any) -> None:
        """Append an action."""
        self.entities.append(action)


def text_of(text: Text, given: Mapping[str, str]) -> str:
    """Return a text with the launch arguments put in.

    Raises:
        CliError: An argument has no value.
    """
    if isinstance(text, LaunchConfiguration):
        if text.variable_name not in given:
            raise CliError(f"launch configuration '{text.variable_name}' does not exist")
        return given[text.variable_name]
    if isinstance(text, (list, tuple)):
        return ''.join(text_of(part, given) for part in text)
    return fspath(text) if isinstance(text, PathLike) else str(text)


def _parameter(value: Any, given: Mapping[str, str]) -> str:
    """Return the value of a parameter in YAML; a launch argument is read as YAML already."""
    if isinstance(value, LaunchConfiguration):
        return text_of(value, given)
    return json.dumps(value)


def modules() -> dict[str, ModuleType]:
    """Return the modules that a launch file imports, by their names."""
    found = {
        'launch': (LaunchDescription,),
        'launch.actions': (ExecuteProcess, DeclareLaunchArgument, Shutdown),
        'launch.substitutions': (LaunchConfiguration,),
        'launch_ros': (),
        'launch_ros.actions': (Node,),
    }
    made = {name: ModuleType(name) for name in found}
    for name, classes in found.items():
        for one in classes:
            setattr(made[name], one.__name__, one)
        parent, _, child = name.rpartition('.')
        if parent:
            setattr(made[parent], child, made[name])
    return made
