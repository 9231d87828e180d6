# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who counts as dead, with a clock of the test's own."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.context import Context
from rclpy.node import Node

from aurora_msgs.msg import Heartbeat
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.testing.domains import own_domain


class Clock:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def watch(clock: Clock) -> Iterator[HeartbeatWatch]:
    context = Context()
    with own_domain() as domain:
        rclpy.init(context=context, domain_id=domain)
        node = Node('watcher', context=context)
        yield HeartbeatWatch(node, clock)
        node.destroy_node()
        rclpy.shutdown(context=context)


def hear(watch: HeartbeatWatch, name: str) -> None:
    watch._on_heartbeat(Heartbeat(node=name))


def lose(watch: HeartbeatWatch) -> None:
    watch._on_liveliness(SimpleNamespace(alive_count_change=-1, not_alive_count_change=1))


def test_a_node_that_was_never_heard_is_not_dead(watch: HeartbeatWatch) -> None:
    lose(watch)
    assert not watch.is_dead('sync')


def test_silence_alone_is_not_death_nor_is_a_loss_alone(
    watch: HeartbeatWatch, clock: Clock
) -> None:
    hear(watch, 'sync')
    clock.now_s += 60.0
    assert not watch.is_dead('sync'), 'it may be busy: the middleware would have lost it'
    hear(watch, 'sync')
    lose(watch)
    assert not watch.is_dead('sync'), 'somebody else went'


def test_the_silent_one_is_dead_after_a_loss_and_lives_when_it_speaks_again(
    watch: HeartbeatWatch, clock: Clock
) -> None:
    hear(watch, 'sync')
    hear(watch, 'recorder')
    clock.now_s += 1.0
    lose(watch)
    hear(watch, 'recorder')
    clock.now_s += 0.6
    assert watch.is_dead('sync')
    assert not watch.is_dead('recorder')
    hear(watch, 'sync')
    assert not watch.is_dead('sync')
