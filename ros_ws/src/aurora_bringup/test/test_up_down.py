# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`up` and `down` with small fake nodes behind a fake `ros2 run`."""

from __future__ import annotations

import os
import signal
import stat
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from aurora_cli.isolation import refusal

SCRIPTS = Path(__file__).resolve().parents[1] / 'scripts'
NODES = (
    'uav_sim', 'sync', 'sumo_bridge', 'uav_bridge', 'recorder',
    'monitor', 'executor', 'grounding', 'parser', 'repair', 'orchestrator',
)  # fmt: skip
DEADLINE_S = 20.0

# Serves until a signal comes, then notes its own name.
GOOD = """
trap 'echo "$NAME" >> "$ORDER"; exit 0' INT TERM
touch "$AURORA_READY_FILE"
while :; do sleep 0.02; done
"""
STUBBORN = 'trap "" INT\n' + GOOD.replace(' INT TERM', ' TERM')
BROKEN = 'echo "no map here" >&2; exit 3\n'
SILENT = 'while :; do sleep 0.02; done\n'
# Serves until a file appears, then ends by itself.
MORTAL = 'touch "$AURORA_READY_FILE"\nwhile [ ! -e "$ORDER.die" ]; do sleep 0.02; done\nexit 5\n'
# Locks the file of a run that is going on, as the orchestrator does, until told to let go.
HOLDER = """
import fcntl, sys
lock = open(sys.argv[1], 'a')
fcntl.flock(lock, fcntl.LOCK_SH)
print('held', flush=True)
input()
"""


def _hear_ctrl_c() -> None:
    """Undo what a shell does to its background jobs, so that the fake nodes can trap SIGINT."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@dataclass(frozen=True, slots=True, kw_only=True)
class Graph:
    """A folder with fake nodes, a fake ros2 and the environment to use them."""

    folder: Path
    environment: dict[str, str]

    @property
    def run_dir(self) -> Path:
        return self.folder / 'run' / 'domain-7'

    def set_node(self, name: str, body: str) -> None:
        script = self.folder / 'nodes' / name
        script.write_text(f'#!/usr/bin/env bash\nNAME={name}\n{body}')
        script.chmod(0o755)

    def call(self, script: str, *arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [str(SCRIPTS / script), *arguments],
            env=self.environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=DEADLINE_S,
            check=False,
            preexec_fn=_hear_ctrl_c,
        )

    def foreground(self) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [str(SCRIPTS / 'up')],
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            preexec_fn=_hear_ctrl_c,
        )
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith('all nodes are ready'):
                return process
        raise AssertionError(f'up ended with {process.wait()}')

    def order(self) -> list[str]:
        return (self.folder / 'order').read_text().split()

    def pid(self, name: str) -> int:
        """Return the process id of a node or of `up`, 0 when none is noted."""
        try:
            return int((self.run_dir / f'{name}.pid').read_text().split()[0])
        except (OSError, IndexError):
            return 0

    def alive(self) -> list[str]:
        """Return the nodes that are alive."""
        names = [path.stem for path in self.run_dir.glob('*.pid')]
        return [name for name in names if name != 'up' and _is_alive(self.pid(name))]

    def serves_again(self, name: str, pid_before: int) -> bool:
        pid = self.pid(name)
        return pid not in (0, pid_before) and (self.run_dir / f'{name}.ready').exists()

    def said(self) -> str:
        """Return what a supervising process without a terminal has said."""
        return (self.run_dir / 'log' / 'up.log').read_text()


def _is_alive(pid: int) -> bool:
    try:
        state = Path(f'/proc/{pid}/stat').read_text().rsplit(') ', 1)[1][0]
    except OSError:
        return False
    return state != 'Z'


def _until(condition: Callable[[], bool]) -> None:
    end_s = time.monotonic() + DEADLINE_S
    while not condition():
        assert time.monotonic() < end_s, 'the condition never came true'
        time.sleep(0.02)


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    (tmp_path / 'bin').mkdir()
    (tmp_path / 'nodes').mkdir()
    (tmp_path / 'order').touch()
    ros2 = tmp_path / 'bin' / 'ros2'
    ros2.write_text(f'#!/usr/bin/env bash\nexec "{tmp_path}/nodes/$3"\n')
    ros2.chmod(0o755)
    environment = {
        'PATH': f'{tmp_path}/bin:{os.environ["PATH"]}',
        'HOME': str(tmp_path),
        'AURORA_RUN_DIR': str(tmp_path / 'run'),
        'ROS_DOMAIN_ID': '7',
        'ORDER': str(tmp_path / 'order'),
    }
    made = Graph(folder=tmp_path, environment=environment)
    for name in NODES:
        made.set_node(name, GOOD)
    yield made
    made.call('down')
    assert made.alive() == []


def test_up_starts_every_node_and_down_stops_them_in_order(graph: Graph) -> None:
    up = graph.call('up', '--detach')

    assert up.returncode == 0, up.stderr
    assert [line.split()[0] for line in up.stdout.splitlines()[:-1]] == list(NODES)
    assert sorted(graph.alive()) == sorted(NODES)

    down = graph.call('down')

    assert down.returncode == 0
    order = graph.order()
    assert sorted(order) == sorted(NODES)
    assert order[0] == 'executor'
    assert set(order[1:3]) == {'sumo_bridge', 'uav_bridge'}
    assert order[3:5] == ['sync', 'recorder']
    assert sorted(down.stdout.split()[::2]) == sorted(NODES)
    assert list(graph.run_dir.glob('*.pid')) == []


TELLS_KEY = 'echo "$AURORA_MAVLINK_KEY_FILE" > "$ORDER.key"\n' + GOOD


def test_each_graph_has_a_key_of_its_own_that_only_its_user_reads(graph: Graph) -> None:
    graph.set_node('uav_sim', TELLS_KEY)
    file = graph.run_dir / 'mavlink.key'
    keys = set()
    for _ in range(2):
        assert graph.call('up', '--detach').returncode == 0
        assert (graph.folder / 'order.key').read_text().strip() == str(file)
        assert stat.S_IMODE(file.stat().st_mode) == 0o600
        keys.add(file.read_bytes())
        graph.call('down')
        assert not file.exists()
    assert {len(key) for key in keys} == {32}
    assert len(keys) == 2


def test_an_isolated_graph_is_reached_only_from_inside(graph: Graph) -> None:
    if refusal():
        pytest.skip(f'no network of its own can be had here: {refusal()}')
    graph.environment['PYTHONPATH'] = os.environ['PYTHONPATH']
    up = graph.call('up', '--detach', '--isolated')
    assert up.returncode == 0, up.stderr
    here = os.readlink('/proc/self/ns/net')
    spaces = {os.readlink(f'/proc/{graph.pid(name)}/ns/net') for name in ('up', *NODES)}
    assert len(spaces) == 1
    assert here not in spaces

    inside = graph.call('inside', 'readlink', '/proc/self/ns/net')
    assert inside.stdout.strip() in spaces, inside.stderr
    second = graph.call('up', '--detach')
    assert second.returncode == 1
    assert "it is isolated: 'ros2 run aurora_bringup inside COMMAND' reaches it" in second.stderr

    assert graph.call('down').returncode == 0
    assert graph.alive() == []
    nobody = graph.call('inside', 'true')
    assert (nobody.returncode, 'no up runs in domain 7' in nobody.stderr) == (1, True)


@pytest.mark.parametrize('named', ['', '/somewhere/key'])
def test_a_key_of_the_user_is_passed_on_and_an_empty_one_means_none(
    graph: Graph, named: str
) -> None:
    graph.set_node('uav_sim', TELLS_KEY)
    graph.environment['AURORA_MAVLINK_KEY_FILE'] = named
    assert graph.call('up', '--detach').returncode == 0
    assert (graph.folder / 'order.key').read_text().strip() == named
    assert not (graph.run_dir / 'mavlink.key').exists()


def test_down_with_nothing_running_says_so_and_succeeds(graph: Graph) -> None:
    down = graph.call('down')

    assert down.returncode == 0
    assert down.stdout == 'nothing runs in domain 7\n'


def test_a_second_up_is_refused_and_leaves_the_first_alone(graph: Graph) -> None:
    graph.call('up', '--detach')
    before = {path.name: path.read_text() for path in graph.run_dir.glob('*.pid')}

    second = graph.call('up', '--detach')

    assert second.returncode == 1
    assert 'runs already in domain 7' in second.stderr
    assert {path.name: path.read_text() for path in graph.run_dir.glob('*.pid')} == before


def test_another_domain_is_another_graph(graph: Graph) -> None:
    graph.call('up', '--detach')
    elsewhere = Graph(folder=graph.folder, environment={**graph.environment, 'ROS_DOMAIN_ID': '8'})

    assert elsewhere.call('down').stdout == 'nothing runs in domain 8\n'
    assert sorted(graph.alive()) == sorted(NODES)


def test_a_node_that_ends_at_its_start_fails_up_with_its_name_and_log(graph: Graph) -> None:
    graph.set_node('sumo_bridge', BROKEN)

    up = graph.call('up', '--detach')

    assert up.returncode == 1
    assert 'sumo_bridge ended before it was ready' in up.stderr
    assert 'no map here' in up.stderr
    assert str(graph.run_dir / 'log' / 'sumo_bridge.log') in up.stderr
    assert graph.alive() == []


def test_a_node_that_never_serves_fails_up_after_the_time_limit(graph: Graph) -> None:
    graph.set_node('parser', SILENT)

    up = graph.call('up', '--detach', '--timeout', '4')

    assert up.returncode == 1
    assert 'parser was not ready after 4 s' in up.stderr
    assert graph.alive() == []


def test_a_node_that_ignores_sigint_gets_sigterm(graph: Graph) -> None:
    graph.set_node('sync', STUBBORN)
    graph.call('up', '--detach')

    down = graph.call('down')

    assert down.returncode == 0
    assert 'sync stopped (only SIGTERM did it)' in down.stdout


def test_ctrl_c_in_the_foreground_stops_everything(graph: Graph) -> None:
    up = graph.foreground()

    up.send_signal(signal.SIGINT)

    assert up.wait(timeout=DEADLINE_S) == 130
    assert sorted(graph.order()) == sorted(NODES)


def test_down_from_another_shell_ends_a_foreground_up_quietly(graph: Graph) -> None:
    up = graph.foreground()

    assert graph.call('down').returncode == 0

    output, _ = up.communicate(timeout=DEADLINE_S)
    assert up.returncode == 0
    assert 'error' not in output


def test_down_never_signals_a_process_that_took_over_the_id(graph: Graph) -> None:
    stranger = subprocess.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)
    try:
        graph.run_dir.mkdir(parents=True)
        (graph.run_dir / 'sync.pid').write_text(f'{stranger.pid} 1\n')

        assert graph.call('down').returncode == 0

        assert stranger.poll() is None
        assert not (graph.run_dir / 'sync.pid').exists()
    finally:
        stranger.kill()
        stranger.wait()


def test_the_previous_log_is_kept_once(graph: Graph) -> None:
    log = graph.run_dir / 'log' / 'sync.log'
    for text in ('first', 'second'):
        graph.set_node('sync', f'echo {text}\n{GOOD}')
        graph.call('up', '--detach')
        graph.call('down')

    assert log.read_text() == 'second\n'
    assert log.with_name('sync.log.1').read_text() == 'first\n'


@contextmanager
def a_run(graph: Graph) -> Iterator[None]:
    """A run that is going on."""
    holder = subprocess.Popen(
        [sys.executable, '-c', HOLDER, str(graph.run_dir / 'busy')],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    assert holder.stdout is not None
    assert holder.stdout.readline() == b'held\n'
    try:
        yield
    finally:
        holder.communicate(b'\n')


@pytest.mark.parametrize('cause', ['killed', 'stopped', 'silent'])
def test_a_dead_idle_node_is_started_again(graph: Graph, cause: str) -> None:
    graph.call('up', '--detach')
    pids = {name: graph.pid(name) for name in NODES}

    if cause == 'silent':
        (graph.run_dir / 'sync.silent').touch()
    else:
        os.kill(pids['sync'], signal.SIGKILL if cause == 'killed' else signal.SIGSTOP)

    _until(lambda: graph.serves_again('sync', pids['sync']))
    _until(lambda: 'up: sync ' in graph.said())
    assert not _is_alive(pids['sync'])
    assert {name for name in NODES if graph.pid(name) != pids[name]} == {'sync'}
    assert sorted(path.name for path in graph.run_dir.glob('sync.*')) == ['sync.pid', 'sync.ready']


def test_nothing_is_started_again_during_a_run(graph: Graph) -> None:
    graph.call('up', '--detach')
    sync, executor = graph.pid('sync'), graph.pid('executor')
    with a_run(graph):
        os.kill(sync, signal.SIGKILL)
        # Dead after it, and still there when several looks have passed.
        os.kill(graph.pid('up'), 0)
        _until(lambda: not _is_alive(sync))
        time.sleep(1.0)
        assert graph.pid('sync') in (0, sync)
    _until(lambda: graph.serves_again('sync', sync))
    assert graph.pid('executor') == executor


def test_a_stopped_orchestrator_is_killed_although_it_holds_the_run(graph: Graph) -> None:
    body = f'exec 5>> "$AURORA_SUPERVISION_DIR/busy"; [ -e "$ORDER.once" ] || flock -s 5\n{GOOD}'
    graph.set_node('orchestrator', body)
    graph.call('up', '--detach')
    (graph.folder / 'order.once').touch()
    before = graph.pid('orchestrator')

    os.kill(before, signal.SIGSTOP)

    _until(lambda: graph.serves_again('orchestrator', before))


def test_a_node_that_keeps_dying_is_given_up_and_the_rest_stays(graph: Graph) -> None:
    graph.set_node('monitor', MORTAL)
    graph.call('up', '--detach')

    (graph.folder / 'order.die').touch()

    _until(lambda: 'monitor FAILED' in graph.said())
    assert (graph.run_dir / 'monitor.failed').exists()
    assert graph.said().count('up: monitor ended') == 3
    assert sorted(graph.alive()) == sorted(set(NODES) - {'monitor'})
    assert graph.call('down').returncode == 0
    assert not (graph.run_dir / 'monitor.failed').exists()


def test_up_after_the_supervisor_was_killed_begins_anew(graph: Graph) -> None:
    graph.call('up', '--detach')
    before = {name: graph.pid(name) for name in NODES}
    os.kill(graph.pid('up'), signal.SIGKILL)
    _until(lambda: not _is_alive(graph.pid('up')))

    again = graph.call('up', '--detach')

    assert again.returncode == 0, again.stderr
    assert 'left of an up that was killed' in again.stderr
    assert sorted(graph.alive()) == sorted(NODES)
    assert not [pid for pid in before.values() if _is_alive(pid)]


def test_files_of_before_a_crash_of_the_machine_mean_nothing(graph: Graph) -> None:
    stranger = subprocess.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)
    try:
        fields = Path(f'/proc/{stranger.pid}/stat').read_text().rsplit(') ', 1)[1].split()
        graph.run_dir.mkdir(parents=True)
        for name in ('up', *NODES):
            (graph.run_dir / f'{name}.pid').write_text(f'{stranger.pid} {fields[19]} other-boot\n')
        for name in NODES:
            (graph.run_dir / f'{name}.ready').touch()
            (graph.run_dir / f'{name}.failed').touch()

        assert graph.call('up', '--detach').returncode == 0

        assert stranger.poll() is None
        assert sorted(graph.alive()) == sorted(NODES)
        assert list(graph.run_dir.glob('*.failed')) == []
    finally:
        stranger.kill()
        stranger.wait()


def test_down_while_up_is_starting_leaves_nothing(graph: Graph) -> None:
    graph.set_node('parser', SILENT)
    up = subprocess.Popen(
        [str(SCRIPTS / 'up'), '--detach'],
        env=graph.environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        preexec_fn=_hear_ctrl_c,
    )
    _until(lambda: graph.pid('parser') != 0)
    pids = [graph.pid(name) for name in NODES]

    down = graph.call('down')

    assert down.returncode == 0, down.stderr
    up.communicate(timeout=DEADLINE_S)
    assert not [pid for pid in pids if pid and _is_alive(pid)]
    assert list(graph.run_dir.glob('*.pid')) == []


def test_a_stopped_supervisor_does_not_hold_up_down(graph: Graph) -> None:
    graph.call('up', '--detach')
    os.kill(graph.pid('up'), signal.SIGSTOP)

    assert graph.call('down').returncode == 0

    assert graph.alive() == []
    assert not _is_alive(graph.pid('up')) if graph.pid('up') else True


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_during_a_detached_start_stops_everything(
    graph: Graph, number: signal.Signals
) -> None:
    graph.set_node('parser', SILENT)
    up = subprocess.Popen(
        [str(SCRIPTS / 'up'), '--detach'],
        env=graph.environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        preexec_fn=_hear_ctrl_c,
    )
    _until(lambda: graph.pid('parser') != 0)

    up.send_signal(number)

    up.communicate(timeout=DEADLINE_S)
    assert up.returncode == 143
    assert graph.alive() == []
    assert list(graph.run_dir.glob('*.pid')) == []


@pytest.mark.parametrize('arguments', [('--unknown',), ('--timeout', 'soon')])
def test_wrong_arguments_start_nothing(graph: Graph, arguments: tuple[str, ...]) -> None:
    assert graph.call('up', *arguments).returncode != 0
    assert graph.alive() == []
