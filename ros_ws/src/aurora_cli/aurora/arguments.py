# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the functions of `import aurora` may be given: checked once, where they are called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from inspect import signature
from os import PathLike, fspath
from typing import Annotated, Any, ParamSpec, TypeVar

from pydantic import AfterValidator, ConfigDict, PlainValidator, ValidationError, validate_call

from aurora_core.errors import ConfigError
from aurora_core.execution.faults import Fault

_Given = ParamSpec('_Given')
_Answer = TypeVar('_Answer')


def _named(path: str | PathLike[str]) -> str | PathLike[str]:
    # Path('') is the current folder, which nobody named.
    if not fspath(path) or '\0' in fspath(path):
        raise ValueError('the name of a file or folder is not empty and has no NUL')
    return path


def _several(faults: Any) -> tuple[Any, ...]:
    if isinstance(faults, str | bytes | Mapping) or not isinstance(faults, Iterable):
        raise ValueError('faults are a list of Fault or of mappings')
    return tuple(faults)


PathName = Annotated[str | PathLike[str], AfterValidator(_named)]
# What one fault may be the request says.
Faults = Annotated[Iterable[Fault | Mapping[str, Any]], PlainValidator(_several)]


def checked(function: Callable[_Given, _Answer]) -> Callable[_Given, _Answer]:
    """Return a function that takes what its annotations say, and nothing to be turned into it.

    Raises:
        ConfigError: From the function: an argument is not one that it takes, and is named.
    """
    strict = validate_call(config=ConfigDict(strict=True, arbitrary_types_allowed=True))(function)

    owner, _, last = function.__qualname__.rpartition('.')
    name = owner if last == '__init__' else last

    @wraps(function)
    def call(*args: _Given.args, **kwargs: _Given.kwargs) -> _Answer:
        try:
            return strict(*args, **kwargs)
        except ValidationError as err:
            if err.title != function.__qualname__ and err.title != function.__name__:
                raise
            raise _unusable(name, tuple(signature(function).parameters), err) from None

    return call


def _unusable(name: str, arguments: tuple[str, ...], err: ValidationError) -> ConfigError:
    told: dict[str, str] = {}
    for problem in err.errors(include_url=False, include_input=False):
        where = problem['loc'][0]
        argument = arguments[where] if isinstance(where, int) else where
        # Of a union each member complains: the first one is told.
        told.setdefault(argument, problem['msg'].removeprefix('Value error, '))
    return ConfigError(
        '; '.join(f'the argument {which} of {name}: {what}' for which, what in told.items()),
        hint=f'help(aurora.{name}) says what each argument takes',
    )
