# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who counts as dead, with a clock of the test's own."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.context import Context
from rclpy.node import Node

from aurora_msgs.msg import Heartbeat
from aurora_ros.heartbeat import HeartbeatPublisher, HeartbeatWatch
from aurora_ros.matching import wait_until
from aurora_ros.processes import ProcessState, pid_space
from aurora_ros.testing.domains import own_domain

LIMIT_S = 60.0


class Clock:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    return Clock()


class Kernel:
    """Processes of the test's own."""

    def __init__(self) -> None:
        self.states: dict[int, ProcessState] = {7: ProcessState(started=70, stopped=False)}
        self.dumping: set[int] = set()

    def __call__(self, pid: int) -> ProcessState | None:
        return self.states.get(pid)


@pytest.fixture
def kernel() -> Kernel:
    return Kernel()


@pytest.fixture
def domain() -> Iterator[int]:
    with own_domain() as number:
        yield number


@pytest.fixture
def watch(clock: Clock, kernel: Kernel, domain: int) -> Iterator[HeartbeatWatch]:
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node('watcher', namespace='aurora', context=context)
    yield HeartbeatWatch(node, clock, look=kernel, dumps=kernel.dumping.__contains__)
    node.destroy_node()
    rclpy.shutdown(context=context)


def hear(watch: HeartbeatWatch, name: str) -> None:
    watch._on_heartbeat(Heartbeat(node=name))


def hear_process(watch: HeartbeatWatch, name: str, pid: int, state: int = 0) -> None:
    watch._on_heartbeat(Heartbeat(node=name, pid=pid, pid_space=pid_space(), state=state))


def lose(watch: HeartbeatWatch) -> None:
    watch._on_liveliness(SimpleNamespace(alive_count_change=-1, not_alive_count_change=1))


def test_who_asks_hears_all_who_spoke_though_nobody_serves_the_node(
    watch: HeartbeatWatch, domain: int
) -> None:
    """Heartbeats wake no executor, and none hides behind a later one."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    nodes = [Node(name, namespace='aurora', context=context) for name in ('sync', 'recorder')]
    speakers = [HeartbeatPublisher(node) for node in nodes]
    try:
        for number, speaker in enumerate(speakers, 1):
            speaker.start()
            speaker.busy(number)
        for number, name in enumerate(('sync', 'recorder'), 1):
            assert wait_until(partial(watch.is_busy, name), LIMIT_S)
            assert watch.run_number(name) == number
    finally:
        for speaker in speakers:
            speaker.close()
        for node in nodes:
            node.destroy_node()
        rclpy.shutdown(context=context)


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


def test_a_process_that_has_ended_is_dead_at_once(watch: HeartbeatWatch, kernel: Kernel) -> None:
    hear_process(watch, 'sync', 7)
    assert not watch.is_dead('sync')
    del kernel.states[7]
    assert watch.cause_of_death('sync') == 'died (process 7)'


def test_another_process_with_the_same_id_is_not_the_node(
    watch: HeartbeatWatch, kernel: Kernel
) -> None:
    hear_process(watch, 'sync', 7)
    kernel.states[7] = ProcessState(started=71, stopped=False)
    assert watch.is_dead('sync')


def test_a_stopped_process_is_dead_once_it_is_silent_for_longer_than_the_lease(
    watch: HeartbeatWatch, kernel: Kernel, clock: Clock
) -> None:
    hear_process(watch, 'sync', 7)
    kernel.states[7] = ProcessState(started=70, stopped=True)
    assert not watch.is_dead('sync')
    clock.now_s += 1.6
    assert watch.cause_of_death('sync') == 'was stopped (process 7)'


def test_a_crashed_process_is_dead_while_its_core_is_still_being_written(
    watch: HeartbeatWatch, kernel: Kernel, clock: Clock
) -> None:
    hear_process(watch, 'sync', 7)
    kernel.dumping.add(7)
    clock.now_s += 1.6
    assert watch.cause_of_death('sync') == 'crashed (process 7)'


def test_a_starved_process_that_lives_is_not_taken_for_the_one_that_went(
    watch: HeartbeatWatch, clock: Clock
) -> None:
    hear_process(watch, 'sync', 7)
    lose(watch)
    clock.now_s += 60.0
    assert not watch.is_dead('sync')


def test_a_restarted_node_is_another_process(watch: HeartbeatWatch, kernel: Kernel) -> None:
    hear_process(watch, 'sync', 7)
    assert watch.process('sync') == (7, 70)
    kernel.states = {8: ProcessState(started=80, stopped=False)}
    hear_process(watch, 'sync', 8)
    assert watch.process('sync') == (8, 80)
    assert not watch.is_dead('sync')
    assert watch.process('recorder') == (0, 0)


def test_a_process_of_another_machine_is_judged_by_the_middleware(
    watch: HeartbeatWatch, kernel: Kernel
) -> None:
    kernel.states.clear()
    watch._on_heartbeat(Heartbeat(node='sync', pid=7, pid_space='elsewhere'))
    assert not watch.is_dead('sync')


def test_busy_is_what_the_node_said_last(watch: HeartbeatWatch) -> None:
    assert not watch.is_busy('sync')
    hear_process(watch, 'sync', 7, Heartbeat.BUSY)
    assert watch.is_busy('sync')
    hear_process(watch, 'sync', 7, Heartbeat.IDLE)
    assert not watch.is_busy('sync')


def test_long_work_goes_on_as_long_as_a_node_says_how_far_it_is(
    watch: HeartbeatWatch, clock: Clock
) -> None:
    watch._on_heartbeat(Heartbeat(node='monitor', detail='step 1 of its work'))
    begun_s = clock.now_s
    clock.now_s += 5.0
    watch._on_heartbeat(Heartbeat(node='monitor', detail='step 1 of its work'))
    assert watch.came_further_s('monitor') == begun_s
    watch._on_heartbeat(Heartbeat(node='monitor', detail='step 2 of its work'))
    assert watch.came_further_s('monitor') == clock.now_s
