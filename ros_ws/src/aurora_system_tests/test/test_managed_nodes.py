# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Lifecycle of the managed nodes, and `autostart`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState

from aurora_core.errors import ExecutionError
from aurora_nodes.modules import MODULES
from aurora_ros import interfaces as on
from aurora_ros.interfaces import Call
from aurora_ros.matching import wait_until
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import nodes

pytestmark = pytest.mark.ros

MANAGED = ('sync', 'sumo_bridge', 'uav_bridge', 'executor')


class Managed:
    """Changes and asks the state of one node."""

    def __init__(self, play: Partner, name: str) -> None:
        self._client = {
            kind: play.node.create_client(kind, f'{name}/{service}')
            for kind, service in ((ChangeState, 'change_state'), (GetState, 'get_state'))
        }
        self._await_answers()

    def _await_answers(self) -> None:
        """Ask until the node answers: its first answer may precede the discovery of who asks."""
        client = self._client[GetState]
        assert client.wait_for_service(10.0)
        assert wait_until(
            lambda: client.call(GetState.Request(), timeout_sec=2.0) is not None, 20.0
        )

    def _call(self, request: Any, kind: Any) -> Any:
        client = self._client[kind]
        assert client.wait_for_service(10.0)
        response = client.call(request, timeout_sec=10.0)
        assert response is not None
        return response

    def change(self, transition: int) -> bool:
        request = ChangeState.Request()
        request.transition.id = transition
        return bool(self._call(request, ChangeState).success)

    @property
    def state(self) -> int:
        return int(self._call(GetState.Request(), GetState).current_state.id)


def endpoints(play: Partner, name: str) -> int:
    """Count publishers and subscriptions that a node makes when it is configured."""
    topics = [on.FAULT, on.TICK_DONE, on.SYNC_STATUS, on.TICK, on.GROUND_STATE, on.UAV_STATE]
    found = [
        info
        for topic in topics
        for info in (
            *play.node.get_publishers_info_by_topic(topic.full_name),
            *play.node.get_subscriptions_info_by_topic(topic.full_name),
        )
    ]
    return sum(info.node_name == name for info in found)


def settled_endpoints(play: Partner, name: str) -> int:
    """Count endpoints once discovery has found the last of them."""
    assert wait_until(lambda: endpoints(play, name) > 0, 10.0)
    count = -1
    while count != (count := endpoints(play, name)):
        wait_until(lambda: False, 0.3)
    return count


@pytest.mark.parametrize('name', MANAGED)
def test_a_managed_node_goes_through_its_states_and_back(name: str, tmp_path: Path) -> None:
    with own_domain() as domain, partner(domain) as play:
        process = ForkedNode(
            MODULES[name], domain, tmp_path, ['--ros-args', '-p', 'autostart:=false']
        )
        with nodes(process):
            managed = Managed(play, name)
            assert managed.state == State.PRIMARY_STATE_UNCONFIGURED
            counts = []
            for _ in range(2):
                assert managed.change(Transition.TRANSITION_CONFIGURE), process.log
                assert managed.state == State.PRIMARY_STATE_INACTIVE
                counts.append(settled_endpoints(play, name))
                assert managed.change(Transition.TRANSITION_ACTIVATE), process.log
                assert managed.state == State.PRIMARY_STATE_ACTIVE
                assert managed.change(Transition.TRANSITION_DEACTIVATE), process.log
                assert managed.change(Transition.TRANSITION_CLEANUP), process.log
                assert managed.state == State.PRIMARY_STATE_UNCONFIGURED
                assert wait_until(lambda: endpoints(play, name) == 0, 10.0)
            assert counts[0] == counts[1], 'configuring again must not double the endpoints'
            assert process.end() == 0
            assert 'Traceback' not in process.log


@pytest.mark.parametrize(
    ('name', 'call', 'fields'),
    [
        ('sync', on.SYNC_LOAD, {'participants': ['x'], 'dt_s': 0.05, 'horizon_s': 1.0}),
        ('sumo_bridge', on.GROUND_LOAD, {}),
        ('uav_bridge', on.UAV_LOAD, {}),
    ],
)
def test_an_inactive_node_refuses_a_load_and_serves_once_activated(
    name: str, call: Call, fields: dict[str, Any], tmp_path: Path
) -> None:
    with own_domain() as domain, partner(domain) as play:
        process = ForkedNode(
            MODULES[name], domain, tmp_path, ['--ros-args', '-p', 'autostart:=false']
        )
        with nodes(process):
            managed = Managed(play, name)
            managed.change(Transition.TRANSITION_CONFIGURE)
            with pytest.raises(ExecutionError, match=f'{name} is not active') as caught:
                play.call(call, **fields)
            assert caught.value.component == name
            assert 'lifecycle set' in caught.value.hint
            managed.change(Transition.TRANSITION_ACTIVATE)
            if name == 'sync':
                assert play.call(call, **fields).ok
