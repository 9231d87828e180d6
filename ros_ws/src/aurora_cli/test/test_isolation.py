# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A network of its own: what is sent outside does not arrive inside, and who is let in is."""

from __future__ import annotations

import os
import socket
import subprocess
import sys

import pytest

from aurora_cli import isolation, ros_isolated
from aurora_cli.doctor import isolation as doctor
from aurora_cli.doctor.machine import Machine
from aurora_cli.ros_isolated import not_isolated
from aurora_core.pipeline.stages import RunRequest

MODULE = [sys.executable, '-m', 'aurora_cli.isolation']
# Says where it listens, then what it hears within the time.
LISTEN = """
import socket, sys
hears = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
hears.bind(('127.0.0.1', 0))
hears.settimeout(float(sys.argv[1]))
print(hears.getsockname()[1], flush=True)
try:
    print(hears.recv(16).decode(), flush=True)
except TimeoutError:
    print('nothing', flush=True)
"""
SEND = """
import socket, sys
socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b'forged', ('127.0.0.1', int(sys.argv[1])))
"""


@pytest.fixture(autouse=True)
def _given(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv('AURORA_ISOLATED', raising=False)
    monkeypatch.delenv('AURORA_ISOLATION', raising=False)


needs_it = pytest.mark.skipif(
    isolation.refusal() != '', reason='this machine gives no network of its own'
)


def listening(limit_s: float, *where: str) -> tuple[subprocess.Popen[str], int]:
    process = subprocess.Popen(
        [*where, sys.executable, '-c', LISTEN, str(limit_s)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    return process, int(process.stdout.readline())


@needs_it
def test_who_is_outside_does_not_reach_who_is_inside_and_who_enters_does() -> None:
    inside, port = listening(5.0, *MODULE, 'new')
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        for _ in range(20):
            out.sendto(b'forged', ('127.0.0.1', port))
    subprocess.run(
        [*MODULE, 'enter', str(inside.pid), sys.executable, '-c', SEND.replace('forged', 'let in'),
         str(port)], check=True,
    )  # fmt: skip
    assert inside.communicate(timeout=20)[0].split('\n')[0] == 'let in'


@needs_it
def test_the_user_and_its_files_stay_and_no_other_interface_is_there(
    tmp_path: os.PathLike[str],
) -> None:
    done = subprocess.run(
        [*MODULE, 'new', 'sh', '-c', 'id -u; echo x > file; ls /sys/class/net; cat /proc/net/dev'],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert int(done.stdout.split()[0]) == os.getuid()
    names = [line.split(':')[0].strip() for line in done.stdout.splitlines() if ':' in line]
    assert names == ['lo']
    assert os.stat(os.path.join(tmp_path, 'file')).st_uid == os.getuid()


@pytest.mark.parametrize(
    ('arguments', 'code', 'said'),
    [
        ((), 64, 'usage'),
        (('new',), 64, 'usage'),
        (('enter', 'x', 'true'), 64, 'usage'),
        (('enter', '999999999', 'true'), 77, 'cannot be entered: No such file'),
    ],
)
def test_what_cannot_be_is_said(arguments: tuple[str, ...], code: int, said: str) -> None:
    done = subprocess.run([*MODULE, *arguments], capture_output=True, text=True, check=False)
    assert (done.returncode, said in done.stderr) == (code, True), done.stderr


def test_a_graph_is_isolated_unless_it_needs_the_network_or_the_user_says_no(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(ros_isolated, 'refusal', lambda: '')
    offline = RunRequest(prompt='x', engine='ros')
    assert not_isolated(offline) == ''
    asks = RunRequest(prompt='x', engine='ros', model='openai/some-model')
    assert 'needs the network' in not_isolated(asks)
    assert not_isolated(RunRequest(prompt='x', engine='ros', model='recorded:file')) == ''
    monkeypatch.setattr(ros_isolated, 'refusal', lambda: 'Operation not permitted')
    assert not_isolated(offline) == 'Operation not permitted'
    monkeypatch.setenv('AURORA_ISOLATION', '0')
    assert not_isolated(offline) == 'AURORA_ISOLATION=0'


def test_the_doctor_says_who_reaches_a_graph(
    tmp_path: os.PathLike[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = Machine(environment={'HOME': str(tmp_path), 'AURORA_MAVLINK_KEY_FILE': ''})
    monkeypatch.setattr(doctor, 'refusal', lambda: 'Operation not permitted')
    said = doctor.who_reaches(machine)
    assert 'every process here reaches a graph' in said
    assert 'MAVLink is not signed' in said
    monkeypatch.setattr(doctor, 'refusal', lambda: '')
    assert doctor.who_reaches(Machine(environment={'HOME': str(tmp_path)})) == (
        'a graph of aurora run has a network of its own, one of up with --isolated'
    )


def test_the_doctor_finds_a_key_that_others_read(tmp_path: os.PathLike[str]) -> None:
    key = os.path.join(tmp_path, 'key')
    with open(key, 'wb') as file:
        file.write(b'x' * 32)
    environment = {'AURORA_MAVLINK_KEY_FILE': key}
    os.chmod(key, 0o644)
    (finding,) = doctor.key_file(Machine(environment=environment))
    assert 'others may read it' in finding.found
    os.chmod(key, 0o600)
    assert doctor.key_file(Machine(environment=environment)) == []
