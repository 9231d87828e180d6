# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages from and to YAML values."""

from __future__ import annotations

from typing import Any

import pytest

std_msgs = pytest.importorskip('std_msgs.msg')
geometry_msgs = pytest.importorskip('geometry_msgs.msg')
sensor_msgs = pytest.importorskip('sensor_msgs.msg')

from aurora_ros2cli.fields import FieldError, set_fields, to_plain  # noqa: E402
from aurora_ros2cli.topic import as_yaml  # noqa: E402


def test_fields_of_every_kind_are_set() -> None:
    stamped = geometry_msgs.PoseStamped()
    set_fields(stamped, {'header': {'frame_id': 'map'}, 'pose': {'position': {'x': 3}}})
    assert (stamped.header.frame_id, stamped.pose.position.x) == ('map', 3.0)

    image = sensor_msgs.Image()
    set_fields(image, {'height': 2, 'is_bigendian': True, 'data': [1, 2]})
    assert (image.height, list(image.data)) == (2, [1, 2])

    joints = sensor_msgs.JointState()
    set_fields(joints, {'name': ['a', 'b'], 'position': [1, 2.5]})
    assert (joints.name, list(joints.position)) == (['a', 'b'], [1.0, 2.5])

    layout = std_msgs.MultiArrayLayout()
    set_fields(layout, {'dim': [{'label': 'rows', 'size': 4}]})
    assert layout.dim[0].label == 'rows'

    octets = std_msgs.ByteMultiArray()
    set_fields(octets, {'data': [1, 255]})
    assert b''.join(octets.data) == b'\x01\xff'


def test_numbers_and_words_become_strings_as_the_field_asks() -> None:
    text = std_msgs.String()
    set_fields(text, {'data': 42})
    assert text.data == '42'


def test_nothing_leaves_the_defaults() -> None:
    text = std_msgs.String()
    set_fields(text, None)
    assert text.data == ''


@pytest.mark.parametrize(
    ('message', 'values'),
    [
        ('String', {'date': 'x'}),
        ('String', 'x'),
        ('String', {'data': {'a': 1}}),
        ('UInt8', {'data': 256}),
        ('UInt8', {'data': -1}),
        ('Int16', {'data': 40000}),
        ('UInt8', {'data': 1.5}),
        ('UInt8', {'data': 'many'}),
        ('Bool', {'data': 'perhaps'}),
        ('Float64MultiArray', {'data': 3}),
        ('Header', {'stamp': {'sec': 'now'}}),
    ],
)
def test_values_that_do_not_fit_are_refused(message: str, values: Any) -> None:
    with pytest.raises(FieldError):
        set_fields(getattr(std_msgs, message)(), values)


def test_the_last_value_of_each_range_fits() -> None:
    for name, value in (
        ('UInt8', 255),
        ('Int8', -128),
        ('UInt64', 2**64 - 1),
        ('Int64', -(2**63)),
    ):
        message = getattr(std_msgs, name)()
        set_fields(message, {'data': value})
        assert message.data == value


def test_an_array_of_fixed_size_must_be_filled() -> None:
    camera = sensor_msgs.CameraInfo()
    set_fields(camera, {'k': [1.0] * 9})
    assert list(camera.k) == [1.0] * 9

    with pytest.raises(FieldError, match='expected 9 elements, found 2'):
        set_fields(camera, {'k': [1.0, 2.0]})


def test_a_message_becomes_yaml_in_field_order() -> None:
    stamped = geometry_msgs.PointStamped()
    stamped.header.frame_id = 'map'

    assert as_yaml(stamped) == (
        'header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: map\n'
        'point:\n  x: 0.0\n  y: 0.0\n  z: 0.0\n'
    )


def test_long_fields_are_cut_unless_asked_for() -> None:
    text = std_msgs.String(data='x' * 200)
    assert to_plain(text) == {'data': 'x' * 128 + '...'}
    assert to_plain(text, None) == {'data': 'x' * 200}

    numbers = std_msgs.Float64MultiArray(data=[0.5] * 200)
    assert to_plain(numbers)['data'] == [0.5] * 128 + ['...']


def test_arrays_of_fixed_size_and_bytes_become_lists() -> None:
    camera = sensor_msgs.CameraInfo()
    assert to_plain(camera)['k'] == [0.0] * 9
    assert to_plain(std_msgs.ByteMultiArray(data=[b'\x07']))['data'] == [[7]]


@pytest.mark.parametrize('text', ['a\0b', '\ud800'])
def test_text_that_would_arrive_changed_is_refused(text: str) -> None:
    with pytest.raises(FieldError, match=r'NUL|surrogate'):
        set_fields(std_msgs.String(), {'data': text})
