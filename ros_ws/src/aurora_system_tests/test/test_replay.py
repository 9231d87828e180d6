# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Live, from the bag and replayed: the same margins to the last bit; and what spoils a replay."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from rosgraph_msgs.msg import Clock

from aurora_core.trace import messages
from aurora_core.trace.bag_reader import StoredBag, read_stored
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.layout import UavColumn
from aurora_msgs.msg import Margins, SyncStatus, Verdict
from aurora_ros import cdr as wire
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.matching import wait_until
from aurora_system_tests.graph import RunningGraph, running_graph

pytestmark = pytest.mark.ros

PROMPT = 'A scenario of 90 seconds. A drone hovers at 20 meters for 5 seconds.'
LIMIT_S = 120.0
LIVE, BAG = Verdict.LIVE, Verdict.BAG


@dataclass(frozen=True, kw_only=True)
class Scene:
    """A graph that has run the prompt once."""

    graph: RunningGraph
    run: Path
    report: dict[str, Any]
    verdicts: list[Verdict]
    margins: list[Margins]
    statuses: list[SyncStatus]
    clocks: list[Clock]


@pytest.fixture(scope='module')
def scene(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Scene]:
    folder = tmp_path_factory.mktemp('graph')
    often = ['--ros-args', '-p', 'margins_period_s:=0.1']  # of a run that takes two seconds
    with running_graph(folder, more_arguments=lambda _domain: {'monitor': often}) as graph:
        # Each one in turn: what is taken late would be lost behind the next one.
        verdicts, statuses = (
            replace(topic, qos=qos.LATCHED_HISTORY) for topic in (on.VERDICT, on.SYNC_STATUS)
        )
        heard = [graph.play.collect(topic) for topic in (verdicts, on.MARGINS, statuses, on.CLOCK)]
        response = graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=PROMPT, wait=True)
        assert response.status == 'verified', (response.error_msg, graph.logs())
        yield Scene(
            graph=graph,
            run=Path(response.run_dir),
            report=json.loads(response.report_json),
            verdicts=heard[0],
            margins=heard[1],
            statuses=heard[2],
            clocks=heard[3],
        )
        codes = {name: node.end() for name, node in graph.nodes.items()}
        assert set(codes.values()) == {0}, codes
        assert 'Traceback' not in graph.logs()


def replay_process(scene: Scene, *arguments: str | Path) -> subprocess.Popen[str]:
    domain = scene.graph.play.node.context.get_domain_id()
    code = 'import sys\nfrom aurora_nodes.replay import main\nsys.exit(main())'
    return subprocess.Popen(
        [sys.executable, '-c', code, *map(str, arguments)],
        env={**os.environ, 'ROS_DOMAIN_ID': str(domain)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def replay(scene: Scene, *arguments: str | Path) -> tuple[int, str, str]:
    process = replay_process(scene, *arguments)
    try:
        output, errors = process.communicate(timeout=LIMIT_S)
    finally:
        process.kill()
    assert 'Traceback' not in errors
    return process.returncode, output, errors


def copied(scene: Scene, folder: Path) -> Path:
    return Path(shutil.copytree(scene.run / 'bag.0', folder / 'bag.0'))


def rewritten(scene: Scene, folder: Path, change: Callable[[str, Any], None]) -> Path:
    """Write the bag anew, properly closed, with messages changed in place."""
    definitions = message_definitions()
    with BagWriter(folder / 'bag.0', definitions) as writer:
        for stored in stored_bag(scene).messages:
            change(stored.topic, stored.value)
            name = messages.TOPICS[stored.topic]
            cdr = definitions.encode(name, stored.value)
            writer.write(stored.topic, name, cdr, wire.time_ns(cdr))
    return folder / 'bag.0'


def stored_bag(scene: Scene) -> StoredBag:
    return read_stored(scene.run / 'bag.0', message_definitions())


def numbers(margins: Margins) -> dict[str, bytes | None]:
    """Every bit of each margin."""
    return {
        row.id: float(row.margin).hex().encode() if row.has_margin else None
        for row in margins.conditions
    }


def test_live_bag_and_replay_have_the_same_margins(scene: Scene) -> None:
    # The run's answer may come before the last of its messages.
    assert wait_until(lambda: len(scene.verdicts) > 1, 10.0)
    live, bag = scene.verdicts[0], scene.verdicts[1]
    assert [live.source, bag.source] == [LIVE, BAG]
    assert live.verdict_json == bag.verdict_json
    assert live.trace_sha256 == bag.trace_sha256 == scene.report['trace']['sha256']
    first = numbers(scene.margins[-1])
    assert first == {
        row['id']: None if row['margin'] is None else float(row['margin']).hex().encode()
        for row in scene.report['conditions']
    }
    previews = scene.margins[:-1]
    assert previews, 'nothing was said while the run went on'
    final = {row.id: row.margin for row in scene.margins[-1].conditions}
    for row in (row for preview in previews for row in preview.conditions):
        assert row.low <= final[row.id] <= row.high, row
    code, output, errors = replay(scene, scene.run, '--json')
    assert code == 0, (output, errors)
    document = json.loads(output)
    assert document['recorded'] == {'file': 'live monitor', 'equal': True, 'differences': []}
    assert document['trace_sha256'] == live.trace_sha256
    assert scene.verdicts[-1].source == LIVE
    assert scene.verdicts[-1].verdict_json == live.verdict_json
    assert numbers(scene.margins[-1]) == first
    assert scene.clocks[-1].clock.sec * 20 == scene.report['trace']['ticks'] - 1


def test_original_bytes_for_whoever_listens_without_a_monitor(
    scene: Scene, tmp_path: Path
) -> None:
    heard: list[bytes] = []
    node = scene.graph.play.node
    topic = on.UAV_STATE
    node.create_subscription(topic.type, topic.name, heard.append, topic.qos, raw=True)
    before = len(scene.verdicts)
    arguments = ('--no-monitor', '--rate', '100')
    sent = [m.cdr for m in stored_bag(scene).messages if m.topic == topic.full_name]
    for _ in range(4):  # where discovery is slow, the first messages have nobody to go to
        heard.clear()
        code, output, errors = replay(scene, scene.run / 'bag.0', *arguments)
        assert (code, output) == (0, ''), errors
        if wait_until(lambda: len(heard) >= len(sent), 10.0):
            break
    assert heard == sent
    # The monitor may hear it too, but is not asked to judge it.
    assert scene.graph.play.call(on.VERIFY, LIMIT_S, bag_uri=str(scene.run / 'bag.0'))
    assert [v.source for v in scene.verdicts[before:]] == [BAG]


def test_a_truncated_bag_is_replayed_as_far_as_it_goes(scene: Scene, tmp_path: Path) -> None:
    bag = copied(scene, tmp_path)
    file = next(bag.glob('*.mcap'))
    with file.open('r+b') as stream:
        stream.truncate(file.stat().st_size * 6 // 10)
    code, output, errors = replay(scene, bag, '--json')
    assert code == 4, errors
    assert 'replayed as far as it goes: ' in errors
    assert output, errors
    document = json.loads(output)
    assert 0 < document['ticks'] < scene.report['trace']['ticks']
    assert document['verdict']['status'] == 'inconclusive'
    assert document['recorded']['equal'], document['recorded']


def test_a_bag_that_is_not_what_was_heard_live_is_inconclusive(
    scene: Scene, tmp_path: Path
) -> None:
    """The bag of the last run, forged and properly closed: only the live monitor knows better."""

    def lift(topic: str, message: Any) -> None:
        if topic == messages.UAV_STATE and message.tick == 300:
            message.data = message.data.copy()
            message.data[UavColumn.Z] += 1e-9

    forged = rewritten(scene, tmp_path, lift)
    response = scene.graph.play.call(on.VERIFY, LIMIT_S, bag_uri=str(forged))
    assert response.verdict.status == 'inconclusive'
    findings = json.loads(response.verdict.verdict_json)['cross_check']
    told = [finding['text'] for finding in findings if finding['kind'] == 'live']
    live = scene.verdicts[0]
    assert any(live.trace_sha256 in text for text in told), told
    intact = scene.graph.play.call(on.VERIFY, LIMIT_S, bag_uri=str(scene.run / 'bag.0'))
    assert intact.verdict.status == 'verified'


def test_a_replay_gives_way_to_a_run_that_begins(scene: Scene) -> None:
    process = replay_process(scene, scene.run, '--rate', '1')
    try:
        assert wait_until(lambda: scene.statuses[-1].state == SyncStatus.RUNNING, 60.0)
        responses: list[Any] = []
        begun = len(scene.statuses)
        thread = threading.Thread(
            target=lambda: responses.append(
                scene.graph.play.call(on.RUN_PROMPT, LIMIT_S, prompt=PROMPT, wait=True)
            )
        )
        thread.start()
        _, errors = process.communicate(timeout=LIMIT_S)
        assert process.returncode == 4
        assert 'gave way to a run that began' in errors
        thread.join(LIMIT_S)
        # It may notice the busy nodes before the clock, and leave before the run is loaded.
        replayed = scene.statuses[begun - 1].run_number
        new = [s.state for s in scene.statuses[begun:] if s.run_number != replayed]
        assert new[0] == SyncStatus.LOADED
    finally:
        process.kill()
    report = json.loads(responses[0].report_json)
    assert report['status'] == 'verified', scene.graph.logs()
    assert report['trace']['sha256'] == scene.report['trace']['sha256']


def test_a_replay_is_refused_while_a_run_goes_on(scene: Scene) -> None:
    publisher = scene.graph.play.publisher(on.SYNC_STATUS)
    try:
        publisher.publish(SyncStatus(run_number=5, state=SyncStatus.RUNNING))
        code, output, errors = replay(scene, scene.run)
        assert (code, output) == (4, ''), errors
        # Where discovery is slow it is heard of only when the replay has begun.
        told = ('a run is going on in this ROS_DOMAIN_ID', 'gave way to a run that began')
        assert any(words in errors for words in told), errors
        publisher.publish(SyncStatus(run_number=5, state=SyncStatus.IDLE))
        assert wait_until(lambda: scene.statuses[-1].state == SyncStatus.IDLE, 10.0)
    finally:
        scene.graph.play.node.destroy_publisher(publisher)


def test_an_interrupted_replay_leaves_the_graph_ready(scene: Scene) -> None:
    process = replay_process(scene, scene.run, '--rate', '1')
    try:
        assert wait_until(lambda: scene.statuses[-1].state == SyncStatus.RUNNING, 60.0)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=20.0)
    finally:
        process.kill()
    assert process.returncode == 130
    assert 'Traceback' not in errors
    assert wait_until(lambda: scene.statuses[-1].state == SyncStatus.IDLE, 10.0)


def test_without_a_monitor_it_says_so(scene: Scene) -> None:
    monitor = scene.graph.nodes['monitor']
    process = replay_process(scene, scene.run, '--rate', '1')
    try:
        assert wait_until(lambda: scene.statuses[-1].state == SyncStatus.RUNNING, 60.0)
        monitor.kill()
        _, errors = process.communicate(timeout=LIMIT_S)
        assert process.returncode == 4
        assert 'monitor: the monitor died during the replay' in errors
        code, output, errors = replay(scene, scene.run, '--ros-args', '-p', 'monitor_limit_s:=0.5')
        assert (code, output) == (4, '')
        assert 'no monitor listens in this ROS_DOMAIN_ID (waited 0.5 s)' in errors
        assert 'ros2 run aurora_nodes monitor' in errors
    finally:
        process.kill()
        scene.graph.restart('monitor')
    code, output, errors = replay(scene, scene.run)
    assert code == 0, errors
    assert 'record   live monitor: every margin is the same to the last bit' in output
    assert scene.report['trace']['sha256'] in output
