# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Writers that should not be there are found while they are there, and after they have gone."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.action.server import ActionServer
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from aurora_core.errors import ExecutionError
from aurora_ros import interfaces as on
from aurora_ros.interfaces import NAMESPACE, Topic
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import partner
from aurora_ros.writers import (
    MatchedWriters,
    Stranger,
    named,
    second_one,
    second_servers,
    strangers,
)

pytestmark = pytest.mark.ros

LIMIT_S = 60.0
Make = Callable[..., Node]


@pytest.fixture
def make() -> Iterator[Make]:
    """Return a maker of nodes in a domain of their own, each with a participant of its own."""
    with ExitStack() as stack:
        domain = stack.enter_context(own_domain())

        def node(name: str, namespace: str = NAMESPACE) -> Node:
            context = Context()
            rclpy.init(context=context, domain_id=domain)
            stack.callback(lambda: rclpy.try_shutdown(context=context))
            made = Node(name, namespace=namespace, context=context)
            stack.callback(made.destroy_node)
            return made

        yield node


def writer(node: Node, topic: Topic) -> Publisher:
    return node.create_publisher(topic.type, topic.full_name, topic.qos)


def found(asks: Node, topic: Topic, *participants: str) -> list[str]:
    return sorted({s.node for s in strangers(asks, [topic], participants)})


def known(asks: Node, topic: Topic, count: int) -> bool:
    """Wait until so many writers are known by name."""

    def named() -> bool:
        infos = asks.get_publishers_info_by_topic(topic.full_name)
        return len(infos) == count and not any('UNKNOWN' in i.node_name for i in infos)

    return wait_until(named, LIMIT_S)


def test_every_topic_of_a_run_has_writers() -> None:
    for topic in on.RUN_TOPICS:
        assert topic.writers
        assert set(topic.writers) <= set(on.NODES)
    assert set(on.JUDGED) <= set(on.RUN_TOPICS)


@pytest.mark.parametrize(
    ('name', 'namespace'), [('intruder', '/'), ('executor', '/other'), ('sync', NAMESPACE)]
)
def test_somebody_else_is_named(make: Make, name: str, namespace: str) -> None:
    asks = make('executor')
    writer(asks, on.UAV_COMMAND)
    assert known(asks, on.UAV_COMMAND, 1)
    assert found(asks, on.UAV_COMMAND, 'executor') == []
    writer(make(name, namespace), on.UAV_COMMAND)
    assert known(asks, on.UAV_COMMAND, 2)
    full = f'/{namespace.strip("/")}/{name}'.replace('//', '/')
    assert found(asks, on.UAV_COMMAND, 'executor') == [full]
    (stranger,) = strangers(asks, [on.UAV_COMMAND], ['executor'])
    error = second_one(stranger)
    assert error.message == f'second writer on /aurora/uav/command: node {full}'
    assert error.hint


def test_one_that_has_taken_the_name_is_a_second_one(make: Make) -> None:
    asks = make('sync')
    for _ in range(2):
        writer(make('executor'), on.EVENTS)
    assert known(asks, on.EVENTS, 2)
    assert found(asks, on.EVENTS, 'executor') == ['/aurora/executor']


def test_who_takes_no_part_in_a_run_may_stand_beside_its_dead_self(make: Make) -> None:
    asks = make('executor')
    for _ in range(2):
        writer(make('parser'), on.AGSG)
    assert known(asks, on.AGSG, 2)
    assert found(asks, on.AGSG, 'executor', 'recorder') == []


def matched(tap: Subscription, count: int) -> bool:
    return wait_until(lambda: tap.get_publisher_count() == count, LIMIT_S)


def test_who_has_gone_again_was_there(make: Make) -> None:
    hears = make('recorder')
    topic = on.UAV_COMMAND
    tap = hears.create_subscription(topic.type, topic.full_name, lambda _message: None, topic.qos)
    writer(make('executor'), topic)
    assert matched(tap, 1)
    writers = MatchedWriters(hears, {topic: tap})
    writers.begin()
    writers.check()
    intruder = make('intruder', '/')
    second = writer(intruder, topic)
    assert matched(tap, 2)
    with pytest.raises(ExecutionError, match='second writer on /aurora/uav/command: node /intr'):
        writers.check()
    intruder.destroy_publisher(second)
    assert matched(tap, 1)
    with pytest.raises(ExecutionError, match='/aurora/uav/command: a node that is gone again'):
        writers.check()
    writers.begin()
    writers.check(last=True)
    writers.close()


def told(writers: MatchedWriters) -> str:
    """Return what is said of a stranger, empty when nobody is."""
    try:
        writers.check(last=True)
    except ExecutionError as err:
        return err.message
    return ''


def test_of_several_who_may_write_one_comes_late_and_another_goes(make: Make) -> None:
    asks, topic = make('sync'), on.HEARTBEAT
    leaving = make('repair')
    repairs = writer(leaving, topic)
    assert known(asks, topic, 1)
    writers = MatchedWriters.on(asks, [topic, on.RUN_END])
    assert wait_until(lambda: repairs.get_subscription_count() == 1, LIMIT_S)
    writers.begin()
    writer(make('grounding'), topic)
    writer(make('executor'), on.RUN_END)
    assert known(asks, topic, 2)
    assert known(asks, on.RUN_END, 1)
    assert told(writers) == ''
    leaving.destroy_publisher(repairs)
    assert known(asks, topic, 1)
    assert told(writers) == ''


@pytest.mark.parametrize('topic', [on.HEARTBEAT, on.RUN_END, on.TICK_DONE, on.AGSG])
def test_who_passes_by_is_noticed_beside_who_should_write(make: Make, topic: Topic) -> None:
    asks, intruder = make('sync'), make('intruder', '/')
    writer(make('executor'), topic)
    assert known(asks, topic, 1)
    writers = MatchedWriters.on(asks, [topic])
    writers.begin()
    passing = writer(intruder, topic)
    assert known(asks, topic, 2)
    intruder.destroy_publisher(passing)
    assert known(asks, topic, 1)
    expected = f'second writer on {topic.full_name}: a node that is gone again'
    assert wait_until(lambda: told(writers) == expected, LIMIT_S)
    writers.close()


def served(asks: Node, service: str, count: int) -> bool:
    """Wait until so many servers are known by name."""
    replies = f'rr/{NAMESPACE}/{service}Reply'

    def named() -> bool:
        infos = asks.get_publishers_info_by_topic(replies, no_mangle=True)
        return len(infos) == count and not any('UNKNOWN' in i.node_name for i in infos)

    return wait_until(named, LIMIT_S)


@pytest.mark.parametrize(
    ('name', 'namespace'), [('helper', '/'), ('parser', '/other'), ('parser', NAMESPACE)]
)
def test_who_serves_a_call_as_well_is_named(make: Make, name: str, namespace: str) -> None:
    asks = make('orchestrator')
    full_name = f'/{NAMESPACE}/{on.PARSE.name}'
    for server in (make('parser'), make(name, namespace)):
        server.create_service(on.PARSE.type, full_name, lambda _asked, answer: answer)
    assert served(asks, on.PARSE.name, 2)
    error = second_one(second_servers(asks, [on.PARSE, on.CHECK])[0])
    full = f'/{namespace.strip("/")}/{name}'.replace('//', '/')
    assert error.message == f'second server of {full_name}: node {full}'
    assert error.hint


def test_a_name_that_comes_late_is_awaited() -> None:
    looks = iter(('', '', '/helper', '/helper'))
    found = named(lambda: [Stranger(place='writer on /clock', node=next(looks))])
    assert [s.node for s in found] == ['/helper']
    assert named(list) == []


def test_a_second_server_of_an_action_is_named_once(make: Make) -> None:
    asks, helper = make('orchestrator'), make('helper', '/')
    for node in (make('executor'), helper):
        ActionServer(node, on.EXECUTE.type, f'/{NAMESPACE}/{on.EXECUTE.name}', lambda _goal: None)
        if node is not helper:
            assert served(asks, on.EXECUTE.services[0], 1)
            assert second_servers(asks, [on.EXECUTE]) == []
    assert all(served(asks, service, 2) for service in on.EXECUTE.services)
    assert [s.node for s in second_servers(asks, [on.EXECUTE])] == ['/helper']


def test_an_answer_is_not_believed_when_another_node_may_have_given_it(make: Make) -> None:
    node, helper = make('parser'), make('helper', '/')
    node.create_service(on.PARSE.type, on.PARSE.name, lambda _asked, answer: answer)
    with partner(node.context.get_domain_id()) as asks, serving(node):
        assert asks.call(on.PARSE).understood is False
        helper.create_service(
            on.PARSE.type, f'/{NAMESPACE}/{on.PARSE.name}', lambda _asked, answer: answer
        )
        assert served(asks.node, on.PARSE.name, 2)
        with pytest.raises(ExecutionError, match='second server of /aurora/parse: node /helper'):
            asks.call(on.PARSE)


@contextmanager
def serving(node: Node) -> Iterator[None]:
    """Spin a node in a thread of its own."""
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    try:
        yield
    finally:
        executor.shutdown()
        thread.join()
