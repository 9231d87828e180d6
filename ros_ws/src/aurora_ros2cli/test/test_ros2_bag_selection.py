# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics are recorded and with which profile they are played."""

from __future__ import annotations

import re
from typing import Any

import pytest

pytest.importorskip('rclpy')

from rclpy.qos import DurabilityPolicy, HistoryPolicy, ReliabilityPolicy
from rosbags.rosbag2.metadata import parse_qos

from aurora_ros2cli.bag.profiles import DEPTH, stored, to_offer
from aurora_ros2cli.bag.recorder import Selection


@pytest.mark.parametrize(
    ('selection', 'taken'),
    [
        (Selection(every=True), {'/a', '/b/c'}),
        (Selection(every=True, hidden=True), {'/a', '/b/c', '/_h'}),
        (Selection(topics=frozenset({'/_h'})), {'/_h'}),
        (Selection(pattern=re.compile('b')), {'/b/c'}),
        (Selection(every=True, excluded=frozenset({'/a'})), {'/b/c'}),
        (Selection(every=True, excluded_pattern=re.compile('/b')), {'/a'}),
    ],
)
def test_selection(selection: Selection, taken: set[str]) -> None:
    assert {name for name in ('/a', '/b/c', '/_h') if selection.takes(name)} == taken


def recorded(**changes: Any) -> Any:
    """Return a profile as rosbags reads it."""
    values = {
        'history': 'keep_last', 'depth': 4, 'reliability': 'reliable', 'durability': 'volatile',
        'deadline': {'sec': 0, 'nsec': 0}, 'lifespan': {'sec': 0, 'nsec': 0},
        'liveliness': 'automatic', 'liveliness_lease_duration': {'sec': 0, 'nsec': 0},
        'avoid_ros_namespace_conventions': False, **changes,
    }  # fmt: skip
    return parse_qos([values])[0]  # type: ignore[list-item]


def test_what_is_offered_connects_to_who_listened() -> None:
    latched = to_offer([recorded(durability='transient_local')])
    assert latched.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert latched.depth == 4

    mixed = to_offer([recorded(), recorded(reliability='best_effort')])
    assert mixed.reliability == ReliabilityPolicy.BEST_EFFORT

    assert to_offer([recorded(history='keep_all')]).history == HistoryPolicy.KEEP_ALL
    assert to_offer([]).depth == DEPTH
    timed = to_offer([recorded(deadline={'sec': 1, 'nsec': 5})])
    assert timed.deadline.nanoseconds == 1_000_000_005


def test_a_profile_survives_the_bag() -> None:
    offered = to_offer([recorded(durability='transient_local', depth=2)])

    (again,) = parse_qos([stored(offered)])  # type: ignore[list-item]

    assert to_offer([again]) == offered
