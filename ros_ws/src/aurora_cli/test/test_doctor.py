# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora doctor` on machines with planted problems, and on this one."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from planted_machine import CHECKOUT, NOW_S, RUN_ID, Planted, only

from aurora_cli.commands.doctor import doctor_command
from aurora_cli.doctor import data, graph, leftovers, network, resources, versions
from aurora_cli.doctor.machine import Finding, Machine, Probe, run_python
from aurora_cli.doctor.run import CHECKS, as_lines, check, fix
from aurora_core.knowledge.config_files import config_path
from aurora_core.report.process import this_process
from aurora_core.report.run_folder import MANIFEST


@pytest.fixture
def planted(tmp_path: Path) -> Planted:
    return Planted(tmp_path)


def test_a_machine_without_a_problem_is_clean(planted: Planted) -> None:
    planted.graph()
    machine = planted.machine()
    for name, function in CHECKS:
        if name not in ('memory', 'maps', 'records'):  # these look at the real machine too
            assert check(name, function, machine).findings == (), name


def test_python(planted: Planted) -> None:
    assert '3.10' in only(versions.python_version(planted.machine(python=(3, 10)))).found


def test_environment_and_packages(planted: Planted) -> None:
    top = planted.folder / 'checkout'
    install = top / 'ros_ws' / 'install'
    (top / 'requirements').mkdir(parents=True)
    (top / 'requirements' / 'run-py3.11.txt').write_text(
        'numpy==2.0 \\\n    --hash=sha256:00\nscipy==1.0\n'
    )
    machine = planted.machine(checkout=top)
    assert 'make -C' in only(versions.environment(machine)).fix
    install.mkdir(parents=True)
    (install / 'aurora_env.bash').touch()
    finding = only(versions.environment(machine))
    assert (finding.found, finding.fix) == ('none', f'source {top}/ros_ws/setup.bash')
    sourced = {**planted.environment, 'AMENT_PREFIX_PATH': f'{install}:/x'}
    machine = planted.machine(checkout=top, environment=sourced)
    assert versions.environment(machine) == []
    found = only(versions.packages(machine)).found
    assert found == 'numpy missing instead of 2.0, scipy missing instead of 1.0'
    there = {'numpy': '2.0', 'scipy': '1.0'}
    machine = planted.machine(checkout=top, environment=sourced, installed=there.get)
    assert versions.packages(machine) == []


def test_variables_that_ros_needs(planted: Planted) -> None:
    planted.environment['AMENT_PREFIX_PATH'] += ':/nowhere'
    assert '/nowhere, which does not exist' in only(versions.variables(planted.machine())).found
    for name in ('ROS_DISTRO', 'AMENT_PREFIX_PATH', 'RMW_IMPLEMENTATION'):
        planted.environment[name] = ''
    findings = versions.variables(planted.machine())
    assert [finding.found.split()[0] for finding in findings] == [
        'ROS_DISTRO', 'AMENT_PREFIX_PATH', 'RMW_IMPLEMENTATION',
    ]  # fmt: skip


def test_a_machine_that_cannot_talk_to_itself(
    planted: Planted, monkeypatch: pytest.MonkeyPatch
) -> None:
    def down(*_arguments: object) -> None:
        raise OSError(101, 'Network is unreachable')

    monkeypatch.setattr('aurora_cli.doctor.network.socket.socket', down)
    assert 'Network is unreachable' in only(network.loopback(planted.machine())).found


def test_what_cannot_be_imported_is_named_with_its_reason(planted: Planted) -> None:
    broken = Probe(code=1, err="Traceback\nModuleNotFoundError: No module named 'rclpy'\n")
    machine = planted.machine(probe=lambda _script, _limit_s: broken)
    findings = versions.imports(machine)
    assert len(findings) == 3
    assert {finding.found for finding in findings} == {broken.last_words}
    assert "No module named 'rclpy'" in only(network.foreign_nodes(machine)).found
    hanging = planted.machine(probe=lambda _script, _limit_s: Probe(code=None))
    assert 'did not end in time' in versions.imports(hanging)[0].found


def test_the_probe_is_a_process_with_a_limit() -> None:
    assert run_python('print(6 * 7)', 30.0) == Probe(code=0, out='42\n')
    assert run_python('import os; os.abort()', 30.0).code == -signal.SIGABRT
    assert run_python('while True: pass', 0.3).code is None


def test_sources_that_changed_since_the_build(planted: Planted) -> None:
    assert CHECKOUT is not None
    top = planted.folder / 'checkout'
    package = top / 'ros_ws' / 'src' / 'aurora_msgs'
    (package / 'msg').mkdir(parents=True)
    (package / 'CMakeLists.txt').touch()
    (package / 'package.xml').write_text('<package><name>aurora_msgs</name></package>')
    (package / 'msg' / 'Tick.msg').write_text('uint64 tick\n')
    tools = top / 'tools' / 'aurora_setup'
    tools.mkdir(parents=True)
    shutil.copy(CHECKOUT / 'tools' / 'aurora_setup' / 'stamps.py', tools)
    (top / 'ros_ws' / 'install').mkdir()
    machine = planted.machine(checkout=top)
    stamps = versions._load(tools / 'stamps.py')
    stamp = {'aurora_msgs': stamps.digest_package(package) + 'of the hook'}
    (top / 'ros_ws' / 'install' / 'workspace.json').write_text(json.dumps(stamp))
    assert versions.build(machine) == []
    (package / 'msg' / 'Tick.msg').write_text('uint32 tick\n')
    assert only(versions.build(machine)).found == 'changed since: aurora_msgs'


@pytest.mark.parametrize('domain', ['232', '-1', 'x', '7²', '101', '150'])
def test_a_domain_that_is_none_or_not_safe(planted: Planted, domain: str) -> None:
    planted.environment['ROS_DOMAIN_ID'] = domain
    assert 'export ROS_DOMAIN_ID=87' in only(network.domain(planted.machine())).fix
    planted.environment['ROS_DOMAIN_ID'] = '100'
    assert network.domain(planted.machine()) == []


@pytest.mark.parametrize(
    ('white_list', 'builtin', 'default', 'found'),
    [
        ('<address>0.0.0.0</address>', 'false', 'true', 'white list is 0.0.0.0'),
        ('', 'false', 'true', 'white list is empty'),
        ('<address>127.0.0.1</address>', 'true', 'true', 'built-in transports'),
        ('<address>127.0.0.1</address>', 'false', 'false', 'no default participant'),
        ('<address>', 'false', 'true', 'not XML'),
    ],
)
def test_a_profile_that_opens_the_network(
    planted: Planted, white_list: str, builtin: str, default: str, found: str
) -> None:
    planted.environment['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    planted.profile(white_list, builtin, default)
    assert found in only(network.middleware(planted.machine())).found


def test_middleware_settings(planted: Planted) -> None:
    planted.environment['RMW_IMPLEMENTATION'] = 'rmw_cyclonedds_cpp'
    assert only(network.middleware(planted.machine())).found == 'rmw_cyclonedds_cpp'
    planted.environment['RMW_IMPLEMENTATION'] = ''
    planted.environment['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'SUBNET'
    assert only(network.middleware(planted.machine())).found == 'SUBNET'
    planted.environment['FASTRTPS_DEFAULT_PROFILES_FILE'] = '/not/there'
    planted.environment['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    assert 'cannot be read' in only(network.middleware(planted.machine())).found


def test_a_port_that_somebody_else_has(planted: Planted) -> None:
    port = 7600 + 250 * 70
    planted.listens('udp', '0100007F', port, 555)
    assert 'another user' in only(network.ports(planted.machine())).found
    planted.process(300, sockets=(555,))
    finding = only(network.ports(planted.machine()))
    assert finding.found.startswith('process 300 (python thing)')
    assert finding.fix == 'kill 300'
    planted.node('uav_sim', 300)
    assert network.ports(planted.machine()) == []


def test_a_node_that_listens_to_the_network(planted: Planted) -> None:
    planted.process(300, sockets=(1, 2, 3, 4, 5))
    planted.node('sync', 300)
    planted.listens('udp', '0100007F', 24900, 1)
    planted.listens('udp6', '0000000000000000FFFF00000100007F', 24902, 2)
    planted.listens('udp', '0100FFEF', 24900, 3)  # the multicast group 239.255.0.1
    assert network.open_sockets(planted.machine()) == []
    planted.listens('udp', '00000000', 24901, 4)
    planted.listens('tcp', '0101A8C0', 80, 5)
    found = sorted(finding.found for finding in network.open_sockets(planted.machine()))
    assert found == ['tcp 192.168.1.1:80', 'udp 0.0.0.0:24901']


def test_real_sockets_are_read_as_they_are() -> None:
    from aurora_cli.doctor.sockets import sockets_of

    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as inside,
        socket.socket(socket.AF_INET) as outside,
        socket.socket(socket.AF_INET) as idle,
    ):
        inside.bind(('127.0.0.1', 0))
        outside.bind(('0.0.0.0', 0))
        outside.listen()
        idle.bind(('127.0.0.1', 0))
        found = {
            (s.kind, s.address, s.port): s.is_loopback
            for s in sockets_of(os.getpid(), Path('/proc'))
        }
        assert found['udp', '127.0.0.1', inside.getsockname()[1]]
        assert found['tcp', '0.0.0.0', outside.getsockname()[1]] is False
        assert ('tcp', '127.0.0.1', idle.getsockname()[1]) not in found


def test_other_nodes_in_the_domain(planted: Planted) -> None:
    names = [['sync', '/aurora'], ['sync', '/aurora'], ['turtle', '/'], ['cli_7', '/aurora']]
    probe = Probe(code=0, out=f'a line of noise\n{json.dumps(names)}\n')
    machine = planted.machine(probe=lambda _script, _limit_s: probe)
    other, twice = network.foreign_nodes(machine)
    assert other.found.startswith('/turtle (')
    assert twice.found == 'more than one node named /aurora/sync'


def test_dead_stopped_missing_and_hanging_nodes(planted: Planted) -> None:
    planted.graph()
    machine = planted.machine()
    assert graph.nodes(machine) == []
    (planted.run_dir / 'parser.ready').unlink()
    assert 'starting, or hanging' in only(graph.nodes(machine)).found
    planted.node('parser', 108)
    (planted.run_dir / 'sync.failed').touch()
    assert 'given up' in only(graph.nodes(machine)).found
    (planted.run_dir / 'sync.failed').unlink()
    shutil.rmtree(planted.proc / '101')
    planted.process(101, 'T')
    assert only(graph.nodes(machine)).fix == 'kill -CONT 101'
    # The id is used again by a younger process: the node is dead all the same.
    planted.node('sync', 101, started=5)
    dead, missing = graph.nodes(machine)
    assert dead.found == 'process 101 has ended'
    assert missing.found == 'sync not running, 10 others are'


def test_what_dead_nodes_leave_is_removed(planted: Planted) -> None:
    planted.node('sync', 4000)
    (planted.run_dir / 'monitor.ready').touch()
    (planted.run_dir / 'parser.pid').write_text('')
    machine = planted.machine()
    checked = check('graph', graph.nodes, machine)
    assert len(checked.findings) == 3
    assert fix(checked, machine).open == 0
    assert list(planted.run_dir.iterdir()) == []
    assert graph.nodes(machine) == []


def test_disk(planted: Planted, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, 'disk_usage', lambda _path: SimpleNamespace(free=5_000_000))
    monkeypatch.setattr(
        os, 'statvfs', lambda _path: SimpleNamespace(f_files=1_000_000, f_favail=12)
    )
    findings = resources.disk(planted.machine())
    assert [finding.found for finding in findings] == ['0.01 GB', 'room for 12'] * 2


def test_a_folder_that_cannot_be_written(
    planted: Planted, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(**_options: Any) -> None:
        raise OSError(30, 'Read-only file system')

    monkeypatch.setattr(tempfile, 'NamedTemporaryFile', refuse)
    found = {finding.found for finding in resources.disk(planted.machine())}
    assert found == {'Read-only file system'}


def test_memory_cores_and_descriptors(planted: Planted, monkeypatch: pytest.MonkeyPatch) -> None:
    (planted.proc / 'meminfo').write_text('MemTotal: 9 kB\nMemAvailable:  500000 kB\n')
    (planted.proc / 'self').mkdir()
    (planted.proc / 'self' / 'limits').write_text('Max open files   64   4096   files\n')
    monkeypatch.setattr(os, 'sched_getaffinity', lambda _pid: {0})
    memory, cores, files = resources.memory(planted.machine())
    assert memory.found == '0.51 GB'
    assert cores.found.startswith('1: ')
    assert files.found == '64'


def test_a_wall_clock_that_was_set_back(planted: Planted) -> None:
    (planted.runs / RUN_ID).mkdir()
    assert resources.clocks(planted.machine()) == []
    finding = only(resources.clocks(planted.machine(wall_s=lambda: 1_000_000_000.0)))
    assert finding.found == '2001-09-09 01:46:40 UTC'
    assert '2026-01-31 12:00:00 UTC' in finding.expected


def test_shared_memory_of_the_dead_and_of_the_living(planted: Planted) -> None:
    for name in (
        'fastrtps_dead',
        'sem.fastrtps_dead',
        'fastrtps_mapped',
        'fastrtps_open',
        'other',
    ):
        (planted.shm / name).write_bytes(b'x' * 1000)
        os.utime(planted.shm / name, (1e9, 1e9))
    (planted.shm / 'fastrtps_young').write_bytes(b'')
    os.utime(planted.shm / 'fastrtps_young', (NOW_S, NOW_S))
    planted.process(300)
    (planted.proc / '300' / 'maps').write_text(
        f'7f00-7f01 rw-s 0 00:01 9    {planted.shm}/fastrtps_mapped\n'
    )
    (planted.proc / '300' / 'fd' / '3').symlink_to(planted.shm / 'fastrtps_open')
    machine = planted.machine()
    checked = check('shared memory', leftovers.shared_memory, machine)
    assert checked.findings[0].found.startswith('2 (0.0 MB): fastrtps_dead, sem.fastrtps_dead')
    # Of another user: not ours to judge.
    assert leftovers.shared_memory(planted.machine(uid=os.getuid() + 1)) == []
    assert fix(checked, machine).open == 0
    assert {path.name for path in planted.shm.iterdir()} == {
        'fastrtps_mapped', 'fastrtps_open', 'fastrtps_young', 'other'
    }  # fmt: skip


def test_runs_that_nobody_will_finish(planted: Planted) -> None:
    dead = this_process().model_copy(update={'started': 'another boot/1'})
    folder = planted.run(RUN_ID, dead)
    planted.run('20260131T120000Z-0a1b2d', this_process())
    machine = planted.machine()
    checked = check('runs', leftovers.unfinished_runs, machine)
    (finding,) = checked.findings
    assert RUN_ID in finding.expected
    assert fix(checked, machine).open == 0
    assert json.loads((folder / 'report.json').read_text())['status'] == 'error'
    assert leftovers.unfinished_runs(machine) == []
    broken = planted.runs / '20260131T120000Z-0a1b2e'
    broken.mkdir()
    (broken / MANIFEST).write_text('{')
    checked = check('runs', leftovers.unfinished_runs, machine)
    assert fix(checked, machine).open == 1, 'what cannot be read is not touched'


def test_maps(planted: Planted) -> None:
    config = planted.folder / 'config'
    shutil.copytree(config_path('maps', 'junction'), config / 'maps' / 'junction')
    planted.environment['AURORA_CONFIG_DIR'] = str(config)
    assert data.maps(planted.machine()) == []
    with (config / 'maps' / 'junction' / 'zones.geojson').open('a') as file:
        file.write(' ')
    assert 'zones.geojson' in only(data.maps(planted.machine())).found
    shutil.rmtree(config / 'maps' / 'junction')
    assert only(data.maps(planted.machine())).fix == 'make maps'
    planted.environment['AURORA_CONFIG_DIR'] = '/not/there'
    (finding,) = check('maps', data.maps, planted.machine()).findings
    assert 'not a folder' in finding.found


@pytest.fixture
def server() -> Iterator[int]:
    with socket.create_server(('127.0.0.1', 0)) as listener:
        yield int(listener.getsockname()[1])


def test_a_model_is_looked_for_only_when_one_is_configured(planted: Planted, server: int) -> None:
    assert data.model(planted.machine()) == []
    machine = planted.machine(model='ollama/llama')
    assert 'OLLAMA_API_BASE' in only(data.model(machine)).expected
    planted.environment['OLLAMA_API_BASE'] = f'http://127.0.0.1:{server}'
    assert data.model(machine) == []
    with socket.socket() as closed:
        closed.bind(('127.0.0.1', 0))
        planted.environment['OLLAMA_API_BASE'] = f'http://127.0.0.1:{closed.getsockname()[1]}'
        assert 'refused' in only(data.model(machine)).found


def test_a_check_that_cannot_be_made_is_a_finding(planted: Planted) -> None:
    def broken(_machine: Machine) -> list[Finding]:
        raise ModuleNotFoundError("No module named 'shapely'")

    def unreadable(_machine: Machine) -> list[Finding]:
        raise PermissionError(13, 'Permission denied', '/proc/1/fd')

    machine = planted.machine()
    assert "No module named 'shapely'" in check('maps', broken, machine).findings[0].found
    checked = check('ports', unreadable, machine)
    assert 'Permission denied' in checked.findings[0].found
    assert as_lines(machine, checked)[0] == 'FINDING   ports'


def test_the_command_ends_with_0_or_1(
    planted: Planted, capsys: pytest.CaptureFixture[str]
) -> None:
    planted.graph()
    machine = planted.machine()
    assert doctor_command(machine, repair=False, json_wanted=False) == 0
    out = capsys.readouterr().out
    assert 'ok        graph: 11 nodes run' in out
    assert 'model: offline, which needs no key and no network' in out
    planted.node('sync', 4000, started=1)
    assert doctor_command(machine, repair=False, json_wanted=True) == 1
    captured = capsys.readouterr()
    answer = json.loads(captured.out)
    assert answer['status'] == 'findings'
    (row,) = [row for row in answer['checks'] if row['name'] == 'graph']
    assert {finding['fixed'] for finding in row['findings']} == {False}
    assert set(row['findings'][0]) == {'expected', 'found', 'fix', 'fixed'}


def test_the_command_on_this_machine(call: Callable[..., SimpleNamespace], here: Path) -> None:
    done = call('doctor', '--json')
    answer = json.loads(done.out)
    assert done.code == (0 if answer['status'] == 'clean' else 1)
    assert [row['name'] for row in answer['checks']] == [name for name, _ in CHECKS]
    wrong = {row['name']: row['findings'] for row in answer['checks'] if row['findings']}
    # What cannot depend on who else works on this machine:
    for name in ('python', 'packages', 'imports', 'maps', 'model', 'runs', 'domain'):
        assert name not in wrong, wrong[name]


def test_it_works_where_there_is_no_environment(tmp_path: Path) -> None:
    """A bare Python without one package, and no variable set."""
    assert CHECKOUT is not None
    doctor = CHECKOUT / 'ros_ws' / 'src' / 'aurora_cli' / 'aurora_cli' / 'doctor'
    base = Path(sys.base_prefix) / 'bin' / f'python{sys.version_info[0]}.{sys.version_info[1]}'
    done = subprocess.run(
        [base, '-S', doctor, '--json'], cwd=tmp_path, env={'PATH': os.defpath}, text=True,
        capture_output=True, timeout=120, check=False,
    )  # fmt: skip
    assert done.returncode == 1, done.stderr
    assert 'Traceback' not in done.stderr
    answer = json.loads(done.stdout)
    fixes = {row['name']: [f['fix'] for f in row['findings']] for row in answer['checks']}
    assert fixes['environment'] == [f'source {CHECKOUT}/ros_ws/setup.bash']
    assert len(fixes['imports']) == 3
    assert fixes['python'] == []
