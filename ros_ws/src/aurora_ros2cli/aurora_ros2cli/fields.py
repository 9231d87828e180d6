# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Fill messages from plain YAML values."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from typing import Any

import yaml
from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

# Generated messages check neither ranges nor lengths unless asked to; a value that does not fit
# would be cut silently when it is sent. The stem of a type name gives its bits.
_BITS = {'int8': 8, 'int16': 16, 'short': 16, 'int32': 32, 'long': 32}
_BITS |= {'int64': 64, 'long long': 64}


class FieldError(ValueError):
    """A value does not fit the field of a message."""


Stamp = Callable[[Any], None]


def read_fields(message: Any, text: str) -> list[Stamp]:
    """Fill a message in place from YAML text.

    Args:
        message: Any generated message.
        text: Field names to values; blank stands for none. `auto` for a header and `now` for a
            time stand for the time of sending.

    Returns:
        Setters for those times, which take a `builtin_interfaces/msg/Time`.

    Raises:
        FieldError: If the text is no YAML, or its values do not fit the message.
    """
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as err:
        raise FieldError(str(err)) from err
    stamps: list[Stamp] = []
    set_fields(message, values, stamps)
    return stamps


def set_fields(message: Any, values: Any, stamps: list[Stamp] | None = None) -> None:
    """Fill a message in place.

    Args:
        message: Any generated message.
        values: Field names to values, as YAML gives them; None stands for an empty mapping.
        stamps: Takes up a setter for each time that is asked for with `auto` or `now`.

    Raises:
        FieldError: If a field does not exist or a value does not fit it.
    """
    stamps = [] if stamps is None else stamps
    values = {} if values is None else values
    if not isinstance(values, Mapping):
        raise FieldError(f'expected a mapping of fields, found {values!r}')
    kinds = dict(zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True))
    for name, value in values.items():
        if name not in kinds:
            raise FieldError(f"'{type(message).__name__}' object has no attribute '{name}'")
        try:
            if _is_now(kinds[name], value):
                stamps.append(_setter(message, name))
            else:
                setattr(message, name, _convert(kinds[name], value, stamps))
        except (AssertionError, TypeError, ValueError, OverflowError) as err:
            raise FieldError(f'{name}: {err}') from err


def _is_now(kind: Any, value: Any) -> bool:
    words = {('std_msgs', 'Header'): 'auto', ('builtin_interfaces', 'Time'): 'now'}
    return (
        isinstance(kind, NamespacedType)
        and isinstance(value, str)
        and words.get((kind.namespaces[0], kind.name)) == value
    )


def _setter(message: Any, name: str) -> Stamp:
    def stamp(time: Any) -> None:
        field = getattr(message, name)
        if hasattr(field, 'stamp'):
            field.stamp = time
        else:
            setattr(message, name, time)

    return stamp


def _convert(kind: Any, value: Any, stamps: list[Stamp]) -> Any:
    if isinstance(kind, NamespacedType):
        module = importlib.import_module('.'.join(kind.namespaces))
        message = getattr(module, kind.name)()
        set_fields(message, value, stamps)
        return message
    if isinstance(kind, AbstractNestedType):
        if not isinstance(value, list):
            raise FieldError(f'expected a list, found {value!r}')
        if isinstance(kind, Array) and len(value) != kind.size:
            raise FieldError(f'expected {kind.size} elements, found {len(value)}')
        if isinstance(kind, BoundedSequence) and len(value) > kind.maximum_size:
            raise FieldError(f'expected at most {kind.maximum_size} elements, found {len(value)}')
        return [_convert(kind.value_type, item, stamps) for item in value]
    if isinstance(kind, (AbstractString, AbstractWString)):
        if isinstance(value, (Mapping, list)) or value is None:
            raise FieldError(f'expected a string, found {value!r}')
        most = getattr(kind, 'maximum_size', None)
        if most is not None and len(str(value).encode()) > most:
            raise FieldError(f'expected at most {most} bytes, found {len(str(value).encode())}')
        return _text(str(value))
    if _is(kind, 'boolean'):
        if not isinstance(value, (bool, int)):
            raise FieldError(f'expected true or false, found {value!r}')
        return bool(value)
    if _is(kind, 'octet'):
        return bytes([value])
    if _is(kind, 'float', 'double', 'long double'):
        return float(value)
    return _integer(kind, value)


def _text(value: str) -> str:
    if '\0' in value:
        raise FieldError(f'a NUL would cut the string at {value.index(chr(0))}')
    try:
        value.encode()
    except UnicodeEncodeError as err:
        raise FieldError(f'expected Unicode, found a lone surrogate at {err.start}') from err
    return value


def _integer(kind: Any, value: Any) -> int:
    if isinstance(value, float) and not value.is_integer():
        raise FieldError(f'expected an integer, found {value!r}')
    number = int(value)
    name = kind.typename.replace('unsigned ', 'u')
    bits = _BITS.get(name.removeprefix('u'))
    if bits is None:
        return number
    least = 0 if name.startswith('u') else -(1 << (bits - 1))
    if not least <= number < least + (1 << bits):
        raise FieldError(f'{number} does not fit {kind.typename}')
    return number


def _is(kind: Any, *names: str) -> bool:
    return isinstance(kind, BasicType) and kind.typename in names
