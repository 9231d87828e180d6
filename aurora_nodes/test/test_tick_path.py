# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is named when the clock waits in vain for the executor."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import ParticipantSilentError
from aurora_core.trace.layout import GROUND_WIDTH
from aurora_msgs.msg import GroundState, SyncStatus
from aurora_nodes.tick_path import ActiveRun, TickPath
from aurora_ros import interfaces as on
from aurora_ros.conversions.messages import message_builder
from aurora_ros.errors import write_error
from aurora_ros.interfaces import Topic

RUN = 5


class Executor:
    """Takes the place of the node: keeps what is called back."""

    def __init__(self) -> None:
        self.callbacks: dict[Topic, Callable[[Any], None]] = {}

    def get_name(self) -> str:
        return 'executor'

    def publisher(self, _topic: Topic) -> None:
        return None

    def subscription(self, topic: Topic, callback: Callable[[Any], None]) -> None:
        self.callbacks[topic] = callback


@pytest.mark.parametrize(
    ('heard', 'stepped', 'silent', 'named'),
    [
        ((), -1, 'executor', 'sumo_bridge'),
        ((on.GROUND_STATE,), -1, 'executor', 'uav_bridge'),
        ((on.GROUND_STATE,), -1, 'recorder', 'recorder'),
        ((), 0, 'executor', 'executor'),
    ],
)
def test_a_bridge_that_sent_no_state_is_named_and_nobody_else(
    heard: tuple[Topic, ...], stepped: int, silent: str, named: str
) -> None:
    node = Executor()
    path = TickPath(node)  # type: ignore[arg-type]
    run = ActiveRun(
        run_number=RUN,
        dt_s=0.05,
        builder=message_builder(RUN, 0.05),
        stepper=None,  # type: ignore[arg-type]
        has_uavs=True,
        on_tick=lambda _tick: None,
    )
    path.arm(run)
    run.last_tick = stepped
    for topic in heard:
        state = GroundState(run_number=RUN, tick=0, data=np.zeros(GROUND_WIDTH))
        node.callbacks[topic](state)
    status = SyncStatus(run_number=RUN, tick=0, state=SyncStatus.FAILED, failed_participant=silent)
    write_error(status, ParticipantSilentError(f'{silent} was silent', component=silent))
    node.callbacks[on.SYNC_STATUS](status)
    assert run.ended.is_set()
    assert isinstance(run.error, ParticipantSilentError)
    assert run.error.component == named
    assert named in str(run.error)
