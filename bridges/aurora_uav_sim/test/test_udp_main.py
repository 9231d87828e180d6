# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The executable as a process."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim import udp_main
from aurora_uav_sim.protocol import mavlink_port


@contextmanager
def simulator(*arguments: str, ready: Path | None = None) -> Iterator[subprocess.Popen[str]]:
    environment = dict(os.environ)
    if ready is not None:
        environment['AURORA_READY_FILE'] = str(ready)
    process = subprocess.Popen(
        [sys.executable, '-m', 'aurora_uav_sim.udp_main', *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate(timeout=10.0)


def port_of(process: subprocess.Popen[str]) -> int:
    assert process.stdout is not None
    line = process.stdout.readline()
    assert '127.0.0.1' in line
    return int(line.rsplit(':', 1)[1])


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_serves_and_stops_cleanly(tmp_path: Path, number: signal.Signals) -> None:
    ready = tmp_path / 'ready'
    with simulator('--port', '0', '--count', '2', '--ros-args', '-r', 'x:=y', ready=ready) as sim:
        port = port_of(sim)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
            sock.connect(('127.0.0.1', port))
            sock.settimeout(10.0)
            station = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
            station.robust_parsing = True
            sock.send(mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(station))
            systems: set[int] = set()
            while systems != {1, 2}:
                for message in station.parse_buffer(sock.recv(65536)) or []:
                    if message.get_type() == 'HEARTBEAT':
                        systems.add(message.get_srcSystem())
        assert ready.read_text(encoding='ascii') == f'{port}\n'
        sim.send_signal(number)
        _, errors = sim.communicate(timeout=10.0)
        assert sim.returncode == 0
        assert errors == ''


def test_a_port_in_use_is_one_clear_line() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(('127.0.0.1', 0))
        port = taken.getsockname()[1]
        with simulator('--port', str(port)) as sim:
            _, errors = sim.communicate(timeout=10.0)
            assert sim.returncode == 1
            assert errors.count('\n') == 1
            assert f'127.0.0.1:{port} is in use' in errors


def test_the_port_comes_from_the_domain(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('ROS_DOMAIN_ID', '42')
    assert udp_main._arguments([]).port == mavlink_port(42)
    assert udp_main._arguments(['--port', '5']).port == 5
    monkeypatch.delenv('ROS_DOMAIN_ID')
    assert udp_main._arguments(['--system-id', '3']).port == mavlink_port(0, 3)


@pytest.mark.parametrize(
    'arguments',
    [
        ['--count', '0'],
        ['--count', '21'],
        ['--system-id', '0'],
        ['--system-id', '64', '--count', '2'],
        ['--port', '65536'],
        ['--gcs', 'nowhere'],
        ['--gcs', 'host:0'],
        ['--what'],
        ['--owner-silence', '0'],
        ['--owner-silence', 'nan'],
    ],
)
def test_bad_arguments_are_refused(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stopped:
        udp_main._arguments(arguments)
    assert stopped.value.code == 2
    assert 'uav_sim: error' in capsys.readouterr().err


def test_a_bad_domain_is_refused(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for bad in ('999', 'abc'):
        monkeypatch.setenv('ROS_DOMAIN_ID', bad)
        with pytest.raises(SystemExit):
            udp_main._arguments([])
        assert 'ROS_DOMAIN_ID' in capsys.readouterr().err
