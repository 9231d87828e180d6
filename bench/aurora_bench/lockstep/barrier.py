# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bare barrier: sync -> two workers -> sync, three processes, rclpy and nothing else.

The yardstick for the graph's tick on the same machine at the same time. Each worker answers a tick
with 11 doubles; reliable, keep all; each process waits on a wait set of its own.

Run as a program it is one of the three: `python -m aurora_bench.lockstep.barrier ROLE TICKS`.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from array import array
from typing import Any

from aurora_bench.results import ResultsError

STATE_DOUBLES = 11
WORKERS = ('worker_a', 'worker_b')
SYNC = 'sync'
_WARM_UP = 200
_MATCH_LIMIT_S = 20.0
_SILENCE_LIMIT_S = 5.0
_POLL_S = 0.01


def measure_barrier(ticks: int, domain: int) -> float:
    """Start the three processes, run, and return the wall time of a tick in microseconds.

    Args:
        ticks: How many, after a warm-up.
        domain: ROS_DOMAIN_ID.

    Raises:
        ResultsError: A process failed; with what it printed.
    """
    environment = {**os.environ, 'ROS_DOMAIN_ID': str(domain)}
    command = [sys.executable, '-m', 'aurora_bench.lockstep.barrier']
    workers = [
        subprocess.Popen(
            [*command, role, str(ticks)], env=environment, stdin=subprocess.PIPE, text=True
        )
        for role in WORKERS
    ]
    try:
        done = subprocess.run(
            [*command, SYNC, str(ticks)], env=environment, capture_output=True, text=True,
            check=False,
        )  # fmt: skip
        for worker in workers:
            worker.communicate(timeout=_MATCH_LIMIT_S)  # closes its input
    except subprocess.TimeoutExpired as err:
        raise ResultsError(f'a worker of the bare barrier did not end: {err}') from err
    finally:
        for worker in workers:
            worker.kill()
            worker.wait()
    if done.returncode != 0:
        raise ResultsError(f'the bare barrier failed: {done.stderr.strip()[-500:]}')
    return float(done.stdout)


class _Member:
    """One process: a node, a publisher, subscriptions that are waited for directly."""

    def __init__(self, name: str, domain: int) -> None:
        import rclpy
        from rclpy.impl.implementation_singleton import rclpy_implementation
        from rclpy.node import Node
        from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy
        from std_msgs.msg import Float64MultiArray

        rclpy.init(domain_id=domain)
        self.type = Float64MultiArray
        self.node: Any = Node(name, namespace='/bare')
        self._qos = QoSProfile(
            history=HistoryPolicy.KEEP_ALL, reliability=ReliabilityPolicy.RELIABLE
        )
        self._wait_set_type = rclpy_implementation.WaitSet
        self._subscriptions: list[Any] = []
        self._wait_set: Any = None

    def publisher(self, topic: str) -> Any:
        return self.node.create_publisher(self.type, topic, self._qos)

    def subscribe(self, topic: str) -> Any:
        subscription = self.node.create_subscription(
            self.type, topic, lambda _message: None, self._qos
        )
        self._subscriptions.append(subscription)
        context = self.node.context.handle
        with context:
            self._wait_set = self._wait_set_type(len(self._subscriptions), 0, 0, 0, 0, 0, context)
        return subscription

    def messages(self) -> list[list[float]]:
        """Wait until something has come and return all of it.

        Raises:
            TimeoutError: Nothing came.
        """
        deadline = time.monotonic() + _SILENCE_LIMIT_S
        while time.monotonic() < deadline:
            self._wait_set.clear_entities()
            for subscription in self._subscriptions:
                self._wait_set.add_subscription(subscription.handle)
            self._wait_set.wait(int(_SILENCE_LIMIT_S * 1e9))
            found = []
            for subscription in self._subscriptions:
                while taken := subscription.handle.take_message(self.type, False):
                    found.append(taken[0].data)
            if found:
                return found
        raise TimeoutError(f'nothing came for {_SILENCE_LIMIT_S:g} s')


def _await(count: Any, wanted: int) -> None:
    """Wait until an endpoint is matched.

    Raises:
        TimeoutError: It is not.
    """
    deadline = time.monotonic() + _MATCH_LIMIT_S
    while count() < wanted:
        if time.monotonic() > deadline:
            raise TimeoutError(f'not matched within {_MATCH_LIMIT_S:g} s')
        time.sleep(_POLL_S)


def _work(member: _Member, role: str, last: int) -> None:
    states = member.publisher(role)
    # sync begins when both workers hear it: by then their answers must have a reader.
    _await(states.get_subscription_count, 1)
    member.subscribe('tick')
    tick = 0
    while tick < last:
        for data in member.messages():
            tick = int(data[0])
            state = array('d', [float(tick)] + [0.5] * (STATE_DOUBLES - 1))
            states.publish(member.type(data=state))
    # The last answer is not lost with this process: it ends when its parent says that sync has.
    sys.stdin.read()


def _synchronise(member: _Member, last: int) -> float:
    for role in WORKERS:
        member.subscribe(role)
    ticks = member.publisher('tick')
    _await(ticks.get_subscription_count, len(WORKERS))
    begin = 0.0
    for tick in range(1, last + 1):
        if tick == _WARM_UP + 1:
            begin = time.perf_counter()
        ticks.publish(member.type(data=array('d', [float(tick)])))
        missing = len(WORKERS)
        while missing:
            missing -= sum(int(data[0]) == tick for data in member.messages())
    return (time.perf_counter() - begin) / (last - _WARM_UP) * 1e6


def main(arguments: list[str]) -> int:
    """Play one role; sync writes microseconds per tick to standard output."""
    import rclpy

    role, last = arguments[0], int(arguments[1]) + _WARM_UP
    member = _Member(role, int(os.environ['ROS_DOMAIN_ID']))
    try:
        if role == SYNC:
            sys.stdout.write(f'{_synchronise(member, last)}\n')
        else:
            _work(member, role, last)
    finally:
        member.node.destroy_node()
        rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
