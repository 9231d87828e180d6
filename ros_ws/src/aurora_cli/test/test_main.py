# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_cli.main import run_command_line
from aurora_core.errors import MapError


@pytest.mark.parametrize(
    'arguments',
    [
        ['nonsense'],
        ['run', '--no-such-option', 'x'],
        ['run', '--seed', 'many', 'x'],
        ['run', '--seed', '-1', 'x'],
        ['run'],
        ['run', 'x', '--prompt-file', 'y'],
        ['run', '--prompt-file', 'not/there'],
        ['run', 'x', '--engine', 'gazebo'],
        ['run', 'x', '--map', 'atlantis'],
        ['run', 'x', '--model', 'some-model'],
        ['run', 'x', '--seeds', '0'],
        ['run', '', '--seeds', '3'],
        ['run', 'x', '--fault', 'not json'],
        ['run', 'x', '--fault', '{"kind": "meteor", "subject": "ego"}'],
        ['check', 'x', '--map', 'atlantis'],
        ['verify'],
        ['verify', 'not/there'],
        ['graph'],
        ['graph', 'A drone hovers.'],
        ['graph', 'A drone hovers.', '-o', 'x.gif'],
        ['graph', 'not/there', '-o', 'x.svg'],
        ['graph', '20260101T000000Z-abcdef', '-o', 'x.svg'],
        ['graph', 'A drone hovers.', '-o', 'x.svg', '--map', 'atlantis'],
        ['map', 'show', 'atlantis'],
        ['map', 'show', 'junction', '--picture', 'x.gif'],
        ['certificate', 'check'],
        ['doctor', '--no-such-option'],
        ['bench', '--anything', 'x'],
        ['map', 'import', 'file', '--name', 'x'],
        ['map', 'measure', 'atlantis'],
        ['map', 'measure'],
    ],
)
def test_usage_errors_leave_with_64_and_say_why(
    arguments: list[str],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run_command_line(arguments) == 64
    captured = capsys.readouterr()
    assert captured.err.startswith('aurora: ')
    assert captured.out == ''
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    'arguments',
    [
        [],
        ['--help'],
        ['run', '--help'],
        ['check', '-h'],
        ['verify', '--help'],
        ['map', '--help'],
        ['graph', '--help'],
    ],
)
def test_help_is_always_there(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run_command_line(arguments) == 0
    assert 'Usage: aurora' in capsys.readouterr().out


def test_help_loads_nothing_heavy() -> None:
    code = (
        'import sys; from aurora_cli.main import run_command_line as r; r(["--help"]); '
        'print([m for m in ("numpy", "pydantic", "rich", "libsumo", "rclpy", "matplotlib", '
        '"shapely") if m in sys.modules])'
    )
    done = subprocess.run(
        [sys.executable, '-c', code], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.splitlines()[-1] == '[]'


def test_maps_are_listed_and_shown(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert run_command_line(['map', 'list', '--json']) == 0
    names = [entry['name'] for entry in json.loads(capsys.readouterr().out)['maps']]
    assert names == ['downtown', 'helsinki', 'junction']
    picture = tmp_path / 'map.png'
    assert run_command_line(['map', 'show', 'junction', '--json', '--picture', str(picture)]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts['signalised'] == 1
    assert picture.read_bytes().startswith(b'\x89PNG')
    assert run_command_line(['map', 'show', 'junction']) == 0
    assert 'signalised' in capsys.readouterr().out
    # Of hundreds of names each has a line, to be looked through and searched.
    assert run_command_line(['map', 'show', 'helsinki']) == 0
    lines = capsys.readouterr().out.splitlines()
    assert '  Agronomitalo (building)' in lines
    assert max(map(len, lines)) < 200


def test_what_breaks_is_told_in_words_and_as_json(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_name: str) -> None:
        raise MapError('the file is damaged', hint='make maps')

    monkeypatch.setattr('aurora_cli.commands.maps.load_map', broken)
    assert run_command_line(['map', 'list', '--json']) == 4
    captured = capsys.readouterr()
    assert json.loads(captured.out)['error'] == {
        'code': 110,
        'component': 'map',
        'message': 'the file is damaged',
        'hint': 'make maps',
    }
    assert 'make maps' in captured.err


def test_a_defect_is_told_without_a_traceback_unless_asked(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def defect(_name: str) -> None:
        raise ZeroDivisionError('oops')

    monkeypatch.setattr('aurora_cli.commands.maps.load_map', defect)
    assert run_command_line(['map', 'list']) == 4
    said = capsys.readouterr().err
    assert 'ZeroDivisionError: oops' in said
    assert 'this is a defect of AURORA' in said
    monkeypatch.setenv('AURORA_TRACEBACK', '1')
    run_command_line(['map', 'list'])
    assert 'Traceback' in capsys.readouterr().err


def test_ctrl_c_outside_a_run_leaves_with_130(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_name: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr('aurora_cli.commands.maps.load_map', interrupted)
    assert run_command_line(['map', 'list']) == 130


def test_the_engine_ros_without_ros_says_what_to_do(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, 'rclpy', None)
    monkeypatch.delitem(sys.modules, 'aurora_cli.ros_client', raising=False)
    monkeypatch.chdir(tmp_path)
    assert run_command_line(['run', 'A drone hovers.', '--engine', 'ros']) == 4
    assert 'source ros_ws/setup.bash' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('arguments', 'wanted'),
    [
        (('bag',), 'there are recover, standard (try aurora bag --help)'),
        (('bag', 'burn'), 'there are recover, standard (try aurora bag --help)'),
        (('rnu',), "Did you mean 'run'?; there are bag, bench"),
        (('export',), "Missing argument 'RUN_OR_BAG'. (try aurora export --help)"),
    ],
)
def test_a_wrong_command_is_answered_with_the_right_ones(
    call: Callable[..., SimpleNamespace], arguments: tuple[str, ...], wanted: str
) -> None:
    done = call(*arguments)
    assert done.code == 64
    assert wanted in done.err
