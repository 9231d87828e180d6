# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A process in the ROS domain that writes into a run, or serves its calls, is named: it ends."""

from __future__ import annotations

import json
import queue
import signal
import tempfile
import threading
from array import array
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from mcap.reader import make_reader

from aurora_core.errors import AuroraError, ExecutionError
from aurora_core.trace.bag_reader import bag_files
from aurora_msgs.action import RunScenario
from aurora_msgs.msg import Heartbeat
from aurora_ros import interfaces as on
from aurora_ros.cdr import run_and_tick, time_ns
from aurora_ros.matching import wait_until
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner
from aurora_system_tests.graph import RunningGraph, running_graph
from aurora_system_tests.intruder import NAME, TOPICS
from aurora_system_tests.second_server import CALLS
from aurora_system_tests.second_server import NAME as SERVER

pytestmark = pytest.mark.ros

PROMPT = (
    'A scenario of 150 seconds. A drone hovers at 20 meters for 10 seconds while a motorcycle '
    'drives through the streets.'
)
# Who comes in its middle is known long before its end, which is all that some runs are about.
FLOWN = PROMPT.replace('150', '80')
SHORT = 'A scenario of 18 seconds. A drone hovers at 5 meters over the ego car for 1 second.'
# Heard by many, by the executor itself, by the monitor alone, by nobody beside the recorder.
KINDS = ('clock', 'command', 'heartbeat', 'run_end', 'state')
ANOTHER_LOAD: dict[str, Any] = {
    'dt_s': 0.05,
    'horizon_s': 60.0,
    'uav_id': ['uav1'],
    'system_id': array('B', [1]),
    'home_xy_m': array('d', [0.0, 0.0]),
    'home_yaw_enu_rad': array('d', [0.0]),
    'wind_mean_east_mps': 7.0,
}
LIMIT_S = 120.0
AGAIN = 5
TWIN_LIMIT_S = 4.0


@pytest.fixture(scope='module')
def graph(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningGraph]:
    limit = ['--ros-args', '-p', f'twin_limit_s:={TWIN_LIMIT_S}']
    arguments = {'executor': limit, 'orchestrator': limit}
    folder = tmp_path_factory.mktemp('graph')
    with running_graph(folder, more_arguments=lambda _domain: arguments) as running:
        yield running


@contextmanager
def intruder(graph: RunningGraph, *arguments: str, kind: str = 'intruder') -> Iterator[ForkedNode]:
    """Have an intruder in the domain of a graph; it ends properly and leaves no lease."""
    domain = graph.play.node.context.get_domain_id()
    folder = Path(tempfile.mkdtemp(dir=graph.runs.parent))
    process = ForkedNode(f'aurora_system_tests.{kind}', domain, folder, arguments)
    try:
        assert wait_until(lambda: process.log == 'ready\n', LIMIT_S), process.log
        yield process
    finally:
        process.send(signal.SIGTERM)
        try:
            process.wait(LIMIT_S)
        finally:
            process.kill()  # whoever missed the signal would write into the next test's domain


def run(graph: RunningGraph, prompt: str = PROMPT) -> Any:
    return graph.play.send_goal(
        on.RUN,
        RunScenario.Goal(prompt=prompt),
        LIMIT_S,
        on_feedback=lambda _feedback: None,
        raise_errors=False,
    )


def assert_verified(result: Any, graph: RunningGraph) -> None:
    assert result.status == 'verified', (json.loads(result.report_json), graph.logs())


def assert_next_is_verified(graph: RunningGraph) -> None:
    """The stranger is gone: a run of any length will do."""
    assert_verified(run(graph, SHORT), graph)


def test_without_a_stranger_the_run_is_verified(graph: RunningGraph) -> None:
    assert_verified(run(graph, SHORT), graph)


@pytest.mark.parametrize('kind', KINDS)
def test_who_writes_during_a_run_is_named(graph: RunningGraph, kind: str) -> None:
    with intruder(graph, kind):
        result = run(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error', graph.logs()
    assert report['error']['component'] == 'network', report['error']
    expected = f'second writer on {TOPICS[kind].full_name}: node /{NAME}'
    assert expected in report['error']['message'], (report['error'], graph.logs())
    assert_next_is_verified(graph)


def recorded(run_folder: Path, topic: on.Topic) -> Iterator[bytes]:
    """Yield the messages (CDR) that the recordings of a run have of a topic."""
    for bag in run_folder.glob('bag.*'):
        for file in bag_files(bag):
            with file.open('rb') as stream:
                for _, _, message in make_reader(stream).iter_messages(topics=[topic.full_name]):
                    yield message.data


class Intervention:
    """Loads uav_bridge once more, with a wind, as soon as it is loaded for a run.

    Args:
        play: Calls.
        answers: Gets what the bridge refused with, or None.
        detour: Load it for another run in between.
    """

    def __init__(
        self, play: Partner, answers: queue.Queue[AuroraError | None], *, detour: bool
    ) -> None:
        self._play = play
        self._answers = answers
        self._detour = detour
        self._loaded: queue.Queue[int] = queue.Queue()
        self._over = False
        play.on(on.HEARTBEAT, self._on_heartbeat)
        threading.Thread(target=self._work, daemon=True).start()

    def end(self) -> None:
        self._over = True

    @property
    def begun(self) -> bool:
        """Whether the bridge was heard when there was something to do."""
        return self._over

    def _on_heartbeat(self, message: Heartbeat) -> None:
        armed = message.node == 'uav_bridge' and message.state == Heartbeat.BUSY
        # Refused whenever it comes; for the detour the run must not have begun.
        early = message.tick == 0 or not self._detour
        if armed and early and not self._over:
            self._over = True
            self._loaded.put(message.run_number)

    def _work(self) -> None:
        run_number = self._loaded.get()
        try:
            for number in (run_number + 1, run_number) if self._detour else (run_number,):
                self._play.call(on.UAV_LOAD, LIMIT_S, run_number=number, **ANOTHER_LOAD)
        except AuroraError as err:
            self._answers.put(err)
        else:
            self._answers.put(None)


def was_flown(graph: RunningGraph, result: Any) -> bool:
    """Return whether the clock of a run went on from t = 0."""
    folder = graph.runs / result.run_id
    assert folder.is_dir(), 'the run is looked for where it is'
    return any(run_and_tick(cdr)[1] > 0 for cdr in recorded(folder, on.GROUND_STATE))


def run_beside_who_is_there(graph: RunningGraph) -> Any:
    """Return the result of a run that begins beside somebody whom the graph knows.

    Where discovery takes longer than all that comes before the first tick, the first run names
    him while it flies (and, where he took its goal too, goes on for a moment after its result);
    the graph knows him from then on, and the next run must not fly.
    """
    assert run(graph).status == 'error', graph.logs()
    return run(graph)


def clock_ns(run_folder: Path) -> list[int]:
    """Return what the recording of a run has of the clock (ns)."""
    times = [time_ns(cdr) for cdr in recorded(run_folder, on.CLOCK)]
    assert len(times) > 1
    return times


def run_beside_a_passer_by(graph: RunningGraph, kind: str) -> Any:
    """Return the result of the run into which somebody wrote who went again."""
    with intruder(graph, kind, '--passing') as passing:
        result = run(graph)
        for _ in range(4):  # where discovery is slow, a run is over before it could write
            if result.status != 'verified' or passing.has_ended:
                break
            result = run(graph)
    return result


@pytest.mark.parametrize('kind', sorted(set(KINDS) - {'clock'}))
def test_who_comes_writes_and_goes_is_noticed(graph: RunningGraph, kind: str) -> None:
    result = run_beside_a_passer_by(graph, kind)
    report = json.loads(result.report_json)
    assert result.status == 'error', (report, graph.logs())
    assert report['error']['component'] == 'network', (report['error'], graph.logs())
    assert f'second writer on {TOPICS[kind].full_name}' in report['error']['message']
    assert_next_is_verified(graph)


def test_who_passes_by_on_the_clock_is_noticed_or_was_not_heard(graph: RunningGraph) -> None:
    # Nothing is acknowledged there, so the run may be over before any node knows of the writer.
    result = run_beside_a_passer_by(graph, 'clock')
    if result.status == 'verified':
        assert not [at_ns for at_ns in clock_ns(graph.runs / result.run_id) if at_ns % 1000]
        return
    report = json.loads(result.report_json)
    assert f'second writer on {on.CLOCK.full_name}' in report['error']['message'], report['error']


def test_a_run_does_not_begin_beside_another_writer(graph: RunningGraph) -> None:
    with intruder(graph, 'command', '--early'):
        result = run_beside_who_is_there(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error'
    assert f'node /{NAME}' in report['error']['message'], report['error']
    assert not was_flown(graph, result), graph.logs()
    assert_next_is_verified(graph)


@pytest.mark.parametrize('call', sorted(set(CALLS) - {on.RUN.name}))
def test_a_run_does_not_begin_beside_a_second_server(graph: RunningGraph, call: str) -> None:
    with intruder(graph, call, kind='second_server'):
        result = run_beside_who_is_there(graph)
    report = json.loads(result.report_json)
    assert result.status == 'error'
    assert report['error']['component'] == 'network', (report['error'], graph.logs())
    expected = f'second server of /aurora/{call}: node /{SERVER}'
    assert expected in report['error']['message'], (report['error'], graph.logs())
    assert not was_flown(graph, result), graph.logs()


@pytest.mark.parametrize('call', [on.VERIFY.name, on.RECORDER_STOP.name, on.EXECUTE.name])
def test_who_begins_to_serve_during_a_run_is_named(graph: RunningGraph, call: str) -> None:
    # Who serves the verification is looked for behind the last tick.
    prompt = FLOWN if call == on.VERIFY.name else PROMPT
    with intruder(graph, call, '--late', kind='second_server'):
        result = run(graph, prompt)
    report = json.loads(result.report_json)
    assert result.status == 'error', graph.logs()
    expected = f'second server of /aurora/{call}: node /{SERVER}'
    assert expected in report['error']['message'], (report['error'], graph.logs())
    assert_next_is_verified(graph)


@pytest.mark.parametrize('detour', [False, True])
def test_who_loads_a_bridge_otherwise_changes_no_run(graph: RunningGraph, detour: bool) -> None:
    answers: queue.Queue[AuroraError | None] = queue.Queue()
    intervention = Intervention(graph.play, answers, detour=detour)
    result = run(graph, SHORT)
    for _ in range(AGAIN):  # a bridge that is loaded for less than a heartbeat is not heard
        if not intervention.begun:
            result = run(graph, SHORT)
    refused = answers.get(timeout=LIMIT_S)
    intervention.end()
    report = json.loads(result.report_json)
    if not detour:
        assert 'loaded already: uav/load' in str(refused)
        assert_verified(result, graph)
        return
    # Loaded for another run in between, the bridge takes what comes for this one.
    assert result.status == 'error', (report, graph.logs())
    assert report['error']['component'] in ('network', 'uav_bridge'), report['error']
    assert_next_is_verified(graph)


def test_a_second_orchestrator_is_not_believed(graph: RunningGraph) -> None:
    with (
        intruder(graph, on.RUN.name, kind='second_server'),
        pytest.raises(ExecutionError, match=f'second server of /aurora/run: node /{SERVER}'),
    ):
        run(graph)
