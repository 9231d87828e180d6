# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages as text: YAML and CSV, as ros2cli writes them."""

from __future__ import annotations

import array
import sys
from dataclasses import dataclass
from typing import Any

import yaml

TRUNCATED = '...'
TRUNCATE_LENGTH = 128


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """How much of a message is shown.

    Attributes:
        longest: Strings and sequences are cut after this many elements; None cuts nothing.
        arrays: Whether elements of sequences are shown.
        strings: Whether strings are shown.
        flow: One line in braces instead of indented lines.
    """

    longest: int | None = TRUNCATE_LENGTH
    arrays: bool = True
    strings: bool = True
    flow: bool = False


CUT = Style()
WHOLE = Style(longest=None)


def as_yaml(message: Any, style: Style = CUT) -> str:
    """Render a message, fields in order; ends with a line break."""
    text: str = yaml.dump(
        to_plain(message, style),
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=style.flow,
        width=sys.maxsize,
    )
    return text


def as_csv(message: Any, style: Style = CUT) -> str:
    """Render the innermost values of a message, separated by commas."""
    return ','.join(_leaves(to_plain(message, style)))


def _leaves(value: Any) -> list[str]:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [leaf for item in value for leaf in _leaves(item)]
    return [str(value)]


def to_plain(value: Any, style: Style = CUT, kind: str = '') -> Any:
    """Turn a message or a field value into what YAML can hold, in field order.

    Args:
        value: Message or value of a field.
        style: What is left out.
        kind: Type of the field, as in `get_fields_and_field_types`.
    """
    longest = style.longest
    if hasattr(value, 'get_fields_and_field_types'):
        return {
            name: to_plain(getattr(value, name), style, field_type)
            for name, field_type in value.get_fields_and_field_types().items()
        }
    if isinstance(value, bytes):
        value = list(value)
    elif isinstance(value, array.array) or hasattr(value, 'tolist'):
        value = value.tolist()
    if isinstance(value, str):
        if not style.strings:
            return f'<string length: <{len(value)}>>'
        cut = longest is not None and len(value) > longest
        return value[:longest] + TRUNCATED if cut else value
    if isinstance(value, (list, tuple)):
        if not style.arrays:
            return _short(kind, len(value))
        cut = longest is not None and len(value) > longest
        items = [to_plain(item, style) for item in (value[:longest] if cut else value)]
        return [*items, TRUNCATED] if cut else items
    return value


def _short(kind: str, length: int) -> str:
    if kind.startswith('sequence<'):
        element = kind.removeprefix('sequence<').removesuffix('>').partition(',')[0]
        return f'<sequence type: {element}, length: {length}>'
    return f'<array type: {kind}>'
