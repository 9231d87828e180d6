# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages as text."""

from __future__ import annotations

import pytest

std_msgs = pytest.importorskip('std_msgs.msg')
geometry_msgs = pytest.importorskip('geometry_msgs.msg')
sensor_msgs = pytest.importorskip('sensor_msgs.msg')

from aurora_ros2cli.rendering import WHOLE, Style, as_csv, as_yaml, to_plain  # noqa: E402


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
    assert to_plain(text, WHOLE) == {'data': 'x' * 200}

    numbers = std_msgs.Float64MultiArray(data=[0.5] * 200)
    assert to_plain(numbers)['data'] == [0.5] * 128 + ['...']


def test_arrays_of_fixed_size_and_bytes_become_lists() -> None:
    camera = sensor_msgs.CameraInfo()
    assert to_plain(camera)['k'] == [0.0] * 9
    assert to_plain(std_msgs.ByteMultiArray(data=[b'\x07']))['data'] == [[7]]


def test_a_message_in_one_line() -> None:
    point = geometry_msgs.PointStamped()
    point.header.frame_id = 'map'
    point.point.x = 1e-05

    assert as_csv(point) == '0,0,map,1e-05,0.0,0.0'
    assert as_yaml(point.point, Style(flow=True)) == '{x: 1.0e-05, y: 0.0, z: 0.0}\n'


def test_what_is_not_wanted_is_named_by_its_size() -> None:
    style = Style(arrays=False, strings=False)

    joints = to_plain(sensor_msgs.JointState(name=['a', 'b'], position=[1.0]), style)
    assert joints['position'] == '<sequence type: double, length: 1>'
    assert joints['name'] == '<sequence type: string, length: 2>'
    assert joints['header']['frame_id'] == '<string length: <0>>'
    assert to_plain(sensor_msgs.CameraInfo(), style)['k'] == '<array type: double[9]>'
