# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The short way of subscriptions and the stock way of everything else, in one process."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from aurora_msgs.msg import Ack, Tick
from aurora_msgs.srv import StartSync
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.polling import PolledGroup, drain
from aurora_ros.testing.domains import own_domain
from aurora_ros.waitset_executor import WaitSetExecutor, is_supported

LIMIT_S = 60.0


class Pair:
    """A node under test, and one beside it, in two executors that the test spins in turn."""

    def __init__(self, context: Context) -> None:
        self.node = Node('tested', context=context)
        self.other = Node('other', context=context)
        self.executor = WaitSetExecutor(context=context)
        self.executor.add_node(self.node)
        self.stock = SingleThreadedExecutor(context=context)
        self.stock.add_node(self.other)

    def close(self) -> None:
        """Leave nothing behind that the next test, in the same domain, would be matched with."""
        self.executor.shutdown()
        self.stock.shutdown()
        self.node.destroy_node()
        self.other.destroy_node()

    def until(self, is_true: Callable[[], bool]) -> None:
        deadline = time.monotonic() + LIMIT_S
        # A timer ends waits that nothing else would end.
        timer = self.node.create_timer(0.05, lambda: None)
        while not is_true():
            assert time.monotonic() < deadline
            self.executor.spin_once()
            self.stock.spin_once(timeout_sec=0.0)
        self.node.destroy_timer(timer)


@pytest.fixture
def context() -> Iterator[Context]:
    made = Context()
    with own_domain() as domain:
        rclpy.init(context=made, domain_id=domain)
        yield made
        if made.ok():
            rclpy.shutdown(context=made)


@pytest.fixture
def pair(context: Context) -> Iterator[Pair]:
    made = Pair(context)
    yield made
    made.close()


def echo(pair: Pair, last: int) -> list[int]:
    """Let the node answer each tick by an ack and the other by the next tick; return the ticks."""
    ticks: list[int] = []
    acks = pair.node.create_publisher(Ack, 'a', qos.STREAM)

    def on_tick(message: Tick) -> None:
        ticks.append(message.tick)
        acks.publish(Ack(tick=message.tick))

    pair.node.create_subscription(Tick, 't', on_tick, qos.STREAM)
    publisher = pair.other.create_publisher(Tick, 't', qos.STREAM)

    def on_ack(message: Ack) -> None:
        if message.tick < last:
            publisher.publish(Tick(tick=message.tick + 1))

    pair.other.create_subscription(Ack, 'a', on_ack, qos.STREAM)
    pair.until(lambda: publisher.get_subscription_count() and acks.get_subscription_count())
    publisher.publish(Tick(tick=0))
    return ticks


def test_this_rclpy_has_the_short_way() -> None:
    assert is_supported()


def test_messages_come_in_order_each_once(pair: Pair) -> None:
    ticks = echo(pair, 300)
    pair.until(lambda: len(ticks) > 300)
    assert ticks == list(range(301))


def test_services_and_timers_are_served_while_messages_flow(pair: Pair) -> None:
    calls = 0
    fired: list[int] = []

    def serve(_request: StartSync.Request, response: StartSync.Response) -> StartSync.Response:
        nonlocal calls
        calls += 1
        return response

    pair.node.create_service(StartSync, 's', serve)
    client = pair.other.create_client(StartSync, 's')
    ticks = echo(pair, 10**9)
    pair.node.create_timer(0.03, lambda: fired.append(ticks[-1] if ticks else -1))
    pair.until(client.service_is_ready)
    for number in range(3):
        future = client.call_async(StartSync.Request())
        pair.until(future.done)
        assert calls == number + 1
    pair.until(lambda: len(set(fired)) > 3 and len(ticks) > 10)


def test_a_subscription_made_or_destroyed_between_messages(pair: Pair) -> None:
    ticks = echo(pair, 10**9)
    pair.until(lambda: len(ticks) > 20)
    late: list[int] = []
    added = pair.node.create_subscription(
        Tick, 't', lambda message: late.append(message.tick), qos.STREAM
    )
    pair.until(lambda: len(late) > 20)
    pair.node.destroy_subscription(added)
    count = len(late)
    before = len(ticks)
    pair.until(lambda: len(ticks) > before + 20)
    assert len(late) <= count + 1


def test_a_destroyed_subscription_is_gone_although_no_message_follows(pair: Pair) -> None:
    got: list[int] = []
    subscription = pair.node.create_subscription(
        Tick, 'v', lambda message: got.append(message.tick), qos.STREAM
    )
    publisher = pair.other.create_publisher(Tick, 'v', qos.STREAM)
    pair.until(lambda: publisher.get_subscription_count() == 1)
    for tick in range(20):
        publisher.publish(Tick(tick=tick))
        pair.until(lambda: len(got) > tick)  # noqa: B023
    quiet_until_s = time.monotonic() + 0.1
    pair.until(lambda: time.monotonic() > quiet_until_s)
    pair.node.destroy_subscription(subscription)
    pair.until(lambda: publisher.get_subscription_count() == 0)


def test_what_nobody_awaits_is_taken_too(pair: Pair, context: Context) -> None:
    awaited: list[Subscription] = []
    pair.executor = WaitSetExecutor(
        context=context, awaited=lambda: awaited[0] if awaited else None
    )
    pair.executor.add_node(pair.node)
    ticks = echo(pair, 10**9)
    commands: list[int] = []
    awaited.append(pair.node.create_subscription(Tick, 'never', lambda _message: None, qos.STREAM))
    pair.node.create_subscription(
        Tick, 'c', lambda message: commands.append(message.tick), qos.STREAM
    )
    publisher = pair.other.create_publisher(Tick, 'c', qos.STREAM)
    pair.until(lambda: publisher.get_subscription_count() == 1 and len(ticks) > 3)
    for tick in range(3):
        publisher.publish(Tick(tick=tick))
        pair.until(lambda: len(commands) > tick)  # noqa: B023
    # One that is destroyed is not waited for.
    pair.node.destroy_subscription(awaited[0])
    before = len(ticks)
    pair.until(lambda: len(ticks) > before + 3)
    assert commands == [0, 1, 2]


def test_polled_subscriptions_are_left_to_their_owner(pair: Pair) -> None:
    seen: list[int] = []
    tap = pair.node.create_subscription(
        Tick, 't', lambda message: seen.append(message.tick), qos.STREAM,
        callback_group=PolledGroup(), raw=True,
    )  # fmt: skip
    publisher = pair.other.create_publisher(Tick, 't', qos.STREAM)
    pair.until(lambda: publisher.get_subscription_count() == 1)
    for tick in range(5):
        publisher.publish(Tick(tick=tick))
    taken: list[bytes] = []

    def all_taken() -> bool:
        taken.extend(drain(tap))
        return len(taken) == 5

    pair.until(all_taken)
    assert not seen
    assert all(isinstance(item, bytes) for item in taken)


def test_an_exception_of_a_callback_comes_out(pair: Pair) -> None:
    def fail(_message: Tick) -> None:
        raise ValueError('a defect')

    pair.node.create_subscription(Tick, 'u', fail, QoSProfile(depth=1))
    publisher = pair.other.create_publisher(Tick, 'u', QoSProfile(depth=1))
    pair.until(lambda: publisher.get_subscription_count() > 0)
    publisher.publish(Tick())
    with pytest.raises(ValueError, match='a defect'):
        pair.until(lambda: False)


def test_a_shutdown_ends_the_wait(pair: Pair, context: Context) -> None:
    ticks = echo(pair, 10**9)
    pair.until(lambda: len(ticks) > 5)
    rclpy.shutdown(context=context)
    with pytest.raises(ExternalShutdownException):
        pair.executor.spin_once()


def test_interface_names_are_relative_and_full_names_are_not() -> None:
    assert on.TICK.full_name == '/aurora/tick'
    assert on.CLOCK.full_name == '/clock'
    assert on.CLOCK.type_name == 'rosgraph_msgs/msg/Clock'
    assert on.COMM.type_name == 'aurora_msgs/msg/LinkEvent'
