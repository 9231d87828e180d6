# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_cli.main import run_command_line
from aurora_core.report.status import ExitCode


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _check(prompt: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, object]]:
    code = run_command_line(['check', prompt, '--json'])
    return code, json.loads(capsys.readouterr().out)


def test_a_prompt_that_can_be_is_feasible_and_nothing_is_left_behind(
    empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, report = _check('A drone hovers at 30 meters over the ego car.', capsys)
    assert (code, report['result']) == (0, 'feasible')
    assert report['conditions']
    assert list(empty.iterdir()) == []


def test_a_broken_limit_is_infeasible(empty: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, report = _check('A drone hovers at 2 meters altitude over the ego car.', capsys)
    assert (code, report['result']) == (5, 'infeasible')


def test_a_prompt_that_cannot_be_read_is_not_understood(
    empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, report = _check('  ', capsys)
    assert (code, report['result']) == (3, 'not_understood')
    assert report['question']


def test_a_file_may_hold_the_prompt(empty: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (empty / 'prompt').write_bytes(b'A drone hovers at 30 meters over the ego car.\r\n')
    assert run_command_line(['check', '--prompt-file', 'prompt', '--json']) == 0
    assert json.loads(capsys.readouterr().out)['prompt'].endswith('car.')


def test_people_get_a_table(empty: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_command_line(['check', 'A drone hovers at 30 meters over the ego car.']) == 0
    assert capsys.readouterr().out.startswith('FEASIBLE')


def test_people_are_told_when_things_can_be(
    empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    prompt = 'A drone hovers over City Hall at 50 m for 20 s. At 30 s the bus brakes.'
    assert run_command_line(['check', prompt]) == 0
    table = capsys.readouterr().out.partition('When it can be')[2]
    rows = {tuple(line.split()) for line in table.splitlines()}
    assert ('e1', '29.4', 's', '30.6', 's') in rows
    assert any(row[:5] == ('the', 'beginning', 'of', 'm1', '9.6') for row in rows)


def test_times_that_exclude_each_other_where_it_was_placed_are_told(
    empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    prompt = 'The scenario lasts 15 s. A drone hovers at 60 m over City Hall.'
    assert run_command_line(['check', prompt]) == ExitCode.UNKNOWN
    shown = capsys.readouterr().out
    assert 'When it can be' not in shown
    assert 'exclude each other where it was placed: the scenario lasts 15 s; the landing' in shown


@pytest.mark.parametrize('command', [['check'], ['run'], ['graph', '-o', 'graph.json']])
@pytest.mark.parametrize('seed', ['-1', '2147483648', '1' * 400, '1.5', 'one'])
def test_a_seed_that_no_run_can_have_is_a_usage_error(
    empty: Path, capsys: pytest.CaptureFixture[str], command: list[str], seed: str
) -> None:
    assert run_command_line([*command, 'A drone hovers at 30 m.', f'--seed={seed}']) == 64
    assert 'seed' in capsys.readouterr().err
    assert list(empty.iterdir()) == []


def test_the_greatest_seed_is_one(empty: Path, capsys: pytest.CaptureFixture[str]) -> None:
    prompt = 'A drone hovers at 30 meters over the ego car.'
    assert run_command_line(['check', prompt, '--seed', '2147483647']) == 0


def test_a_picture_shows_where_it_would_happen(
    empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    prompt = (
        'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
        'ego when the van comes within 20 meters.'
    )
    assert run_command_line(['check', prompt, '--picture', 'where.svg']) == ExitCode.OK
    drawn = (empty / 'where.svg').read_text('utf-8')
    assert drawn.startswith('<?xml')
    assert 'wrote where.svg' in capsys.readouterr().err
    assert run_command_line(['check', prompt, '--picture', 'where.gif']) == ExitCode.USAGE


def test_what_is_refused_has_no_picture(empty: Path, capsys: pytest.CaptureFixture[str]) -> None:
    high = 'A drone hovers at 500 m.'
    assert run_command_line(['check', high, '--picture', 'where.png']) == ExitCode.INFEASIBLE
    assert 'no place to draw' in capsys.readouterr().err
    assert list(empty.iterdir()) == []
