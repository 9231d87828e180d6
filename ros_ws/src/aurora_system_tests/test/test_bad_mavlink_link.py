# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph with a bad MAVLink link: the same trace, or an error that names the simulator."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from aurora_cli.installed import installed

pytest.importorskip('rclpy')

from aurora_cli.local_engine import LocalStages
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_folder import RunFolder
from aurora_msgs.action import RunScenario
from aurora_ros import interfaces as on
from aurora_system_tests.graph import RunningGraph, running_graph
from aurora_uav_bridge.testing.bad_link import LinkFaults
from aurora_uav_bridge.testing.udp_proxy import UdpProxy
from aurora_uav_sim.protocol import mavlink_port

pytestmark = pytest.mark.ros

PROMPT = 'A scenario of 18 seconds. A drone hovers at 5 meters over the ego car for 1 second.'
LIMIT_S = 120.0
BAD = LinkFaults(
    loss=0.2, duplication=0.2, reordering=0.2, truncation=0.05, corruption=0.05, delay_s=0.005
)


@dataclass(frozen=True, kw_only=True)
class Spoiled:
    """A graph whose UAV bridge reaches its simulator through a proxy."""

    graph: RunningGraph
    proxy: UdpProxy

    def run(self, **options: Any) -> Any:
        return self.graph.play.send_goal(
            on.RUN, RunScenario.Goal(prompt=PROMPT), LIMIT_S, **options
        )


@pytest.fixture(scope='module')
def spoiled(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Spoiled]:
    proxies: list[UdpProxy] = []
    with ExitStack() as stack:

        def arguments(domain: int) -> Mapping[str, Sequence[str]]:
            proxies.append(stack.enter_context(UdpProxy(mavlink_port(domain), LinkFaults())))
            return {'uav_bridge': ['--ros-args', '-p', f'port:={proxies[0].port}']}

        folder = tmp_path_factory.mktemp('graph')
        graph = stack.enter_context(running_graph(folder, more_arguments=arguments))
        yield Spoiled(graph=graph, proxy=proxies[0])
        assert 'Traceback' not in graph.logs()


class Still:
    """A clock for a run whose durations nobody reads."""

    def seconds(self) -> float:
        return 0.0


def test_a_bad_link_gives_the_trace_of_the_local_engine(spoiled: Spoiled, tmp_path: Path) -> None:
    local = run(
        RunRequest(prompt=PROMPT),
        LocalStages(installed()),
        installed(),
        RunFolder(tmp_path, '20260101T000000Z-000000'),
        RunControl(),
        Still(),
    )
    assert local.trace is not None
    spoiled.proxy.set_faults(BAD)
    result = spoiled.run()
    assert result.status == 'verified', (result.error_msg, spoiled.graph.logs())
    assert json.loads(result.report_json)['trace']['sha256'] == local.trace.sha256
    happened = spoiled.proxy.counts
    assert all(
        happened[name] > 0
        for name in ('loss', 'duplication', 'reordering', 'truncation', 'corruption')
    ), happened


def test_a_dead_link_is_an_error_that_names_the_simulator_and_heals(spoiled: Spoiled) -> None:
    spoiled.proxy.set_faults(LinkFaults())

    def cut(feedback: RunScenario.Feedback) -> None:
        if feedback.sim_time_s >= 2.0:
            spoiled.proxy.set_faults(LinkFaults(loss=1.0))

    result = spoiled.run(on_feedback=cut, raise_errors=False)
    assert result.status == 'error', (result.report_json[-2000:], spoiled.graph.logs())
    error = json.loads(result.report_json)['error']
    assert error['component'] == 'uav_sim'
    assert 'did not answer within 3 s' in error['message']
    spoiled.proxy.set_faults(LinkFaults())
    assert spoiled.run().status == 'verified', spoiled.graph.logs()
