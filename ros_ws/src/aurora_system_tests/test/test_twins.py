# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two nodes of one name in a domain: a run does not begin beside a second graph."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import AuroraError
from aurora_nodes.modules import MODULES
from aurora_ros import interfaces as on
from aurora_ros.testing.forked import ForkedNode
from aurora_system_tests.graph import RunningGraph, running_graph

pytestmark = pytest.mark.ros

PROMPT = 'A scenario of 18 seconds. A drone hovers 5 m above the ego car for 1 second.'
LIMIT_S = 120.0


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[RunningGraph]:
    limit = ['--ros-args', '-p', 'twin_limit_s:=8.0']
    with running_graph(tmp_path, more_arguments=lambda _domain: {'executor': limit}) as running:
        yield running


def test_a_second_sync_is_named_and_is_forgotten_when_it_was_killed(
    graph: RunningGraph, tmp_path: Path
) -> None:
    elsewhere = tmp_path / 'elsewhere'
    elsewhere.mkdir()
    domain = graph.play.node.context.get_domain_id()
    twin = ForkedNode(MODULES['sync'], domain, elsewhere)
    try:
        twin.await_ready()
        with pytest.raises(AuroraError, match='another graph runs in this') as caught:
            graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=PROMPT, wait=True)
        assert caught.value.component == 'sync', graph.logs()
    finally:
        twin.kill()
    # At once: the run waits until the middleware has forgotten the one that was killed.
    response = graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=PROMPT, wait=True)
    assert response.status == 'verified', (response.report_json[-2000:], graph.logs())
