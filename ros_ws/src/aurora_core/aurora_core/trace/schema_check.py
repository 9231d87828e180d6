# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Does a definition that a bag brings along say the same as ours? Field by field, comments aside.

A bag is read by its own definitions: where they agree with ours, ours decode it; where they do
not, nobody guesses. Code is never generated from a definition out of a file (a fixed array of 2^32
texts would be unrolled).
"""

from __future__ import annotations

from dataclasses import dataclass

from mcap.records import Schema
from rosbags.interfaces import Nodetype
from rosbags.interfaces.typing import FieldDesc, Typesdict
from rosbags.typesys import TypesysError, get_types_from_msg

from aurora_core.trace.definitions import MessageDefinitions

ENCODING = 'ros2msg'
# Ours have up to 10 kB.
_TEXT_LIMIT = 256 << 10


@dataclass(frozen=True, slots=True)
class ForeignSchema:
    """A definition that is not ours; `text` says where they part, for people."""

    text: str


def check_schema(
    schema: Schema, type_name: str, definitions: MessageDefinitions
) -> ForeignSchema | None:
    """Return where a definition differs from ours, None when messages read alike by both.

    Args:
        schema: As it stands in the bag.
        type_name: What the topic has to carry.
        definitions: Ours.
    """
    if schema.name != type_name:
        return ForeignSchema(f'its type is {schema.name[:80]!r}, expected {type_name}')
    if schema.encoding != ENCODING:
        return ForeignSchema(
            f'{type_name} is defined as {schema.encoding[:20]!r}, expected {ENCODING}'
        )
    ours = definitions.text(type_name)
    if schema.data == ours.encode('utf-8'):
        return None
    if len(schema.data) > _TEXT_LIMIT:
        return ForeignSchema(f'the definition of {type_name} has {len(schema.data)} bytes')
    try:
        theirs = get_types_from_msg(schema.data.decode('utf-8'), type_name)
    except (TypesysError, ValueError, LookupError, AssertionError, RecursionError) as err:
        return ForeignSchema(
            f'the definition of {type_name} cannot be read ({type(err).__name__})'
        )
    return _compare(theirs, get_types_from_msg(ours, type_name))


def _compare(theirs: Typesdict, ours: Typesdict) -> ForeignSchema | None:
    for name, (constants, fields) in ours.items():
        if name not in theirs:
            return ForeignSchema(f'it does not define {name}')
        their_constants, their_fields = theirs[name]
        for number, (field, kind) in enumerate(fields):
            if number >= len(their_fields):
                return ForeignSchema(f'{name} has no field {field!r}')
            their_field, their_kind = their_fields[number]
            if (their_field, their_kind) != (field, kind):
                return ForeignSchema(
                    f'field {number + 1} of {name} is {_kind(their_kind)} {their_field}, '
                    f'expected {_kind(kind)} {field}'
                )
        if len(their_fields) > len(fields):
            return ForeignSchema(f'{name} has a further field {their_fields[len(fields)][0]!r}')
        known = {constant: value for constant, _, value in constants}
        for constant, _, value in their_constants:
            if known.get(constant) != value:
                return ForeignSchema(
                    f'constant {constant} of {name} is {value!r}, expected '
                    f'{known.get(constant, "no such constant")!r}'
                )
    return None


def _kind(kind: FieldDesc) -> str:
    if kind[0] is Nodetype.NAME:
        return str(kind[1])
    if kind[0] is Nodetype.BASE:
        name, limit = kind[1]
        return f'{name}<={limit}' if limit else str(name)
    inner, count = kind[1]
    if kind[0] is Nodetype.ARRAY:
        return f'{_kind(inner)}[{count}]'
    return f'{_kind(inner)}[<={count}]' if count else f'{_kind(inner)}[]'
