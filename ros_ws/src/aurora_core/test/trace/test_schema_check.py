# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A definition of a bag either reads as ours or is foreign, with the place where it parts."""

from __future__ import annotations

import pytest
from mcap.records import Schema

from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.schema_check import check_schema

STATE = 'aurora_msgs/msg/GroundState'
OURS = message_definitions().text(STATE)


def _check(text: str | bytes, name: str = STATE, encoding: str = 'ros2msg') -> str:
    data = text if isinstance(text, bytes) else text.encode()
    schema = Schema(id=1, name=name, encoding=encoding, data=data)
    found = check_schema(schema, STATE, message_definitions())
    return '' if found is None else found.text


def test_comments_and_blanks_do_not_matter() -> None:
    assert 'uint64 tick' in OURS
    assert _check(OURS) == ''
    assert _check(OURS.replace('uint64 tick', '# a comment\nuint64   tick  # k\n')) == ''


@pytest.mark.parametrize(
    ('old', 'new', 'said'),
    [
        ('uint64 tick', 'uint32 tick', 'is uint32 tick, expected uint64 tick'),
        ('uint64 tick', 'uint64 tack', 'is uint64 tack, expected uint64 tick'),
        ('float64[] data', 'float64[4] data', 'is float64[4] data, expected float64[] data'),
        ('float64[] data', 'float64[<=4] data', 'is float64[<=4] data'),
        ('float64[] data', '', "has no field 'data'"),
        ('float64[] data', 'float64[] data\nuint8 more', "further field 'more'"),
        ('uint8 WIDTH=7', 'uint8 WIDTH=8', 'constant WIDTH of aurora_msgs/msg/GroundState is 8'),
        ('uint8 WIDTH=7', 'uint8 WIDTH=7\nuint8 OTHER=1', 'no such constant'),
        ('std_msgs/Header header', 'std_msgs/String header', 'expected std_msgs/msg/Header'),
    ],
)
def test_the_first_difference_is_named(old: str, new: str, said: str) -> None:
    assert old in OURS
    assert said in _check(OURS.replace(old, new))


def test_an_older_definition_that_lacks_a_constant_reads_alike() -> None:
    assert _check(OURS.replace('uint8 WIDTH=7\n', '')) == ''


@pytest.mark.parametrize(
    ('text', 'name', 'encoding', 'said'),
    [
        (OURS, 'std_msgs/msg/String', 'ros2msg', "its type is 'std_msgs/msg/String'"),
        (OURS, STATE, 'ros2idl', "defined as 'ros2idl'"),
        ('float64[4294967295] data\nstring[4294967295] more', STATE, 'ros2msg', 'field 1'),
        (b'\xff\xfe\x00', STATE, 'ros2msg', 'cannot be read'),
        ('what is this?', STATE, 'ros2msg', 'field 1'),
        ('!', STATE, 'ros2msg', 'cannot be read'),
        ('uint8 x\n' * 40_000, STATE, 'ros2msg', 'bytes'),
    ],
)
def test_what_is_not_ours_is_foreign(
    text: str | bytes, name: str, encoding: str, said: str
) -> None:
    assert said in _check(text, name, encoding)
