# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is there twice."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.context import Context
from rclpy.node import Node

from aurora_ros import interfaces as on
from aurora_ros.matching import twins, wait_until
from aurora_ros.testing.domains import own_domain

LIMIT_S = 60.0


def publishing(name: str, namespace: str, context: Context) -> Node:
    node = Node(name, namespace=namespace, context=context)
    topic = on.HEARTBEAT
    node.create_publisher(topic.type, topic.name, topic.qos)
    return node


def test_only_a_name_that_is_there_twice_in_this_namespace_is_a_twin() -> None:
    contexts = [Context(), Context()]
    with own_domain() as domain:
        for context in contexts:
            rclpy.init(context=context, domain_id=domain)
        asking = publishing('executor', 'aurora', contexts[0])
        others = [
            publishing('sync', 'aurora', contexts[0]),
            publishing('monitor', 'aurora', contexts[0]),
            publishing('monitor', 'elsewhere', contexts[1]),
            publishing('sync', 'aurora', contexts[1]),
        ]
        names = ('executor', 'sync', 'monitor')
        try:
            assert wait_until(lambda: twins(asking, on.HEARTBEAT, names) == ['sync'], LIMIT_S)
            others[-1].destroy_node()
            assert wait_until(lambda: not twins(asking, on.HEARTBEAT, names), LIMIT_S)
        finally:
            for node in (asking, *others[:-1]):
                node.destroy_node()
            for context in contexts:
                rclpy.shutdown(context=context)
