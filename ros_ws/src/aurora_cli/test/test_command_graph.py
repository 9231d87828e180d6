# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_cli.main import run_command_line
from aurora_core.agsg.document import agsg_from_json
from aurora_core.agsg.export import spec_from_graphml
from aurora_core.outcomes.agsg import Agsg

PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the '
    'ego when the van comes within 20 meters.'
)


@pytest.fixture(scope='module')
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The graph of the prompt as a run folder holds it, grounded once."""
    file = tmp_path_factory.mktemp('run') / 'agsg.0.json'
    assert run_command_line(['graph', PROMPT, '-o', str(file)]) == 0
    return file


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ('name', 'begins'),
    [
        ('x.png', b'\x89PNG'),
        ('x.SVG', b'<?xml'),
        ('x.json', b'{'),
        ('x.graphml', b'<graphml'),
        ('x.dot', b'digraph'),
        ('x.mmd', b'flowchart'),
    ],
)
def test_the_ending_of_the_file_chooses_the_form(
    name: str, begins: bytes, here: Path, stored: Path
) -> None:
    assert run_command_line(['graph', str(stored), '-o', name]) == 0
    assert (here / name).read_bytes().startswith(begins)
    assert [path.name for path in here.iterdir()] == [name]


def test_a_prompt_is_grounded_and_its_request_comes_back(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command_line(['graph', PROMPT, '-o', 'x.graphml', '--json']) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told['stage'], told['graph'], told['influences']) == ('grounded', 'x.graphml', [])
    assert spec_from_graphml((here / 'x.graphml').read_text('utf-8')).prompt == PROMPT


def test_a_run_folder_gives_the_graph_that_it_holds(
    here: Path, stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / 'agsg.0.json').write_bytes(stored.read_bytes())
    whole = agsg_from_json(stored.read_bytes())
    later = Agsg.model_validate({**dict(whole), 'iteration': 1})
    (here / 'agsg.1.json').write_text(later.model_dump_json(), 'utf-8')
    for options, iteration in ((['--iteration', '0'], 0), ([], 1)):
        assert run_command_line(['graph', '.', '-o', 'y.json', *options]) == 0
        found = agsg_from_json((here / 'y.json').read_bytes())
        assert found == (whole, later)[iteration]
    assert run_command_line(['graph', 'agsg.1.json', '-o', 'y.json']) == 0
    assert agsg_from_json((here / 'y.json').read_bytes()) == later
    assert run_command_line(['graph', '.', '-o', 'y.json', '--iteration', '7']) == 64
    (here / 'empty').mkdir()
    assert run_command_line(['graph', 'empty', '-o', 'y.json']) == 64
    (here / 'agsg.1.json').write_text('{}', 'utf-8')
    capsys.readouterr()
    assert run_command_line(['graph', '.', '-o', 'y.json']) == 4
    assert 'holds no graph' in capsys.readouterr().err


def test_what_affects_what(stored: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_command_line(['graph', str(stored), '--why', 'e1.delivered', '--json']) == 0
    influences = json.loads(capsys.readouterr().out)['influences']
    assert influences[0]['parameter'].startswith('links/link1/')
    assert [i['distance'] for i in influences] == sorted(i['distance'] for i in influences)
    assert run_command_line(['graph', str(stored), '--why', 'links/link1/loss']) == 0
    assert 'e1.delivered' in capsys.readouterr().out
    assert run_command_line(['graph', str(stored), '--why', 'nothing']) == 4
    assert 'no condition' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('prompt', 'code', 'status'),
    [
        ('  ', 3, 'not_understood'),
        ('Make it nice.', 3, 'not_understood'),
        ('A drone tracks a dinosaur.', 5, 'infeasible'),
    ],
)
def test_without_a_specification_there_is_no_graph(
    prompt: str, code: int, status: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_command_line(['graph', prompt, '-o', 'x.svg', '--json']) == code
    assert json.loads(capsys.readouterr().out)['status'] == status
    assert list(here.iterdir()) == []


def test_what_cannot_be_grounded_is_shown_as_parsed(capsys: pytest.CaptureFixture[str]) -> None:
    prompt = 'A drone hovers at 2 meters altitude over the ego car.'
    assert run_command_line(['graph', prompt, '-o', 'x.json', '--json']) == 0
    captured = capsys.readouterr()
    assert json.loads(captured.out)['stage'] == 'parsed'
    assert 'not grounded' in captured.err


def test_a_file_that_cannot_be_written(stored: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_command_line(['graph', str(stored), '-o', 'no/such/folder/x.dot']) == 4
    assert 'cannot be written' in capsys.readouterr().err
