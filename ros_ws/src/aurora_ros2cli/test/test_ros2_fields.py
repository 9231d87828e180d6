# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages from YAML values."""

from __future__ import annotations

from typing import Any

import pytest

std_msgs = pytest.importorskip('std_msgs.msg')
geometry_msgs = pytest.importorskip('geometry_msgs.msg')
sensor_msgs = pytest.importorskip('sensor_msgs.msg')

from aurora_ros2cli.fields import FieldError, read_fields, set_fields  # noqa: E402


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


def test_times_of_sending_are_filled_in_later() -> None:
    stamped = geometry_msgs.PoseStamped()
    stamps = read_fields(stamped, '{header: auto, pose: {position: {x: 1}}}')
    header = std_msgs.Header()
    stamps += read_fields(header, '{stamp: now, frame_id: map}')
    time = type(header.stamp)(sec=7)

    for stamp in stamps:
        stamp(time)

    assert (stamped.header.stamp.sec, stamped.pose.position.x) == (7, 1.0)
    assert (header.stamp.sec, header.frame_id) == (7, 'map')


def test_text_that_is_no_yaml_is_refused() -> None:
    with pytest.raises(FieldError):
        read_fields(std_msgs.String(), '{data: [')


@pytest.mark.parametrize('text', ['a\0b', '\ud800'])
def test_text_that_would_arrive_changed_is_refused(text: str) -> None:
    with pytest.raises(FieldError, match=r'NUL|surrogate'):
        set_fields(std_msgs.String(), {'data': text})
