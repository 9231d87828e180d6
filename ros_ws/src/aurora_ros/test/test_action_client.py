# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The race of rclpy's action client: an answer that is faster than the note of its request."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.context import Context
from rclpy.node import Node

from aurora_msgs.action import ExecuteScenario
from aurora_ros.action_client import ThreadedActionClient
from aurora_ros.testing.domains import own_domain


@pytest.fixture
def client() -> Iterator[ThreadedActionClient]:
    context = Context()
    with own_domain() as domain:
        rclpy.init(context=context, domain_id=domain)
        node = Node('caller', context=context)
        yield ThreadedActionClient(node, ExecuteScenario, 'execute')
        node.destroy_node()
        rclpy.shutdown(context=context)


def test_no_answer_is_taken_between_sending_and_noting(client: ThreadedActionClient) -> None:
    taken = threading.Event()

    def take() -> None:
        client.take_data()
        taken.set()

    def send_goal_request(_request: Any) -> int:
        # The answer comes now, in the executor's thread.
        threading.Thread(target=take, daemon=True).start()
        assert not taken.wait(0.2), 'taken before its number was noted'
        return 7

    client._is_goal_response_ready = client._is_cancel_response_ready = False
    client._is_feedback_ready = client._is_status_ready = False
    client._is_result_response_ready = False
    client._client_handle = SimpleNamespace(
        send_goal_request=send_goal_request, destroy_when_not_in_use=lambda: None
    )
    client.send_goal_async(ExecuteScenario.Goal())
    assert 7 in client._pending_goal_requests
    assert taken.wait(5.0)
