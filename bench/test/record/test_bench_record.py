# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Record over HTTP, then measure fidelity without a server; through the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_cli.main import run_command_line
from aurora_llm.testing.model_server import ModelServer, Turn

PROMPT = 'A drone follows a motorcycle at 40 m altitude.'
ROW = {
    'id': 'track-001',
    'category': 'track',
    'prompt': PROMPT,
    'feasibility': 'feasible',
    'paraphrase_group': 'track',
    'end_to_end': False,
    'requirements': [
        {'id': 'r1', 'kind': 'agent', 'type': 'motorcycle', 'ref': 'm1'},
        {'id': 'r2', 'kind': 'uav', 'ref': 'uav1'},
        {
            'id': 'r3',
            'kind': 'mission',
            'uav': 'uav1',
            'mode': 'track',
            'target': 'm1',
            'altitude_m': 40,
            'ref': 'p1',
        },
    ],
}
MISSION = {
    'id': 'p',
    'uav': 'u',
    'mode': 'track',
    'target': 'm',
    'altitude_m': {'value': 40, 'unit': 'm', 'quote': '40 m'},
    'quote': 'A drone follows a motorcycle',
}
ANSWER = {
    'agents': [{'id': 'm', 'type': 'motorcycle', 'quote': 'a motorcycle'}],
    'uavs': [{'id': 'u', 'quote': 'A drone'}],
    'missions': [MISSION],
    'clauses': [{'quote': PROMPT[:-1], 'status': 'encoded', 'ids': ['p', 'm']}],
}
LAST = 'requirement fidelity 1.000 [0.439, 1.000]  field fidelity 1.000'


def test_what_is_recorded_is_scored_without_a_server(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / 'prompts.jsonl'
    file.write_text(json.dumps(ROW) + '\n', encoding='utf-8')
    store = ['--transcripts', str(tmp_path / 'replies')]
    with ModelServer([Turn(status=500), Turn(text=json.dumps(ANSWER))]) as server:
        model = ['--model', f'openai/local@{server.url}']
        assert run_command_line(['bench', 'record', str(file), *model, *store]) == 0
        assert capsys.readouterr().out == 'recorded 1 prompts, 2 calls, 1 specifications\n'
        assert run_command_line(['bench', 'record', str(file), *model, *store]) == 0
        assert ' 0 calls' in capsys.readouterr().out
    results = ['--results', str(tmp_path / 'results')]
    asked = ['bench', 'fidelity', str(file), *model]
    assert run_command_line([*asked, *store, *results]) == 0
    captured = capsys.readouterr()
    assert captured.out.splitlines()[-1] == LAST
    assert '[1/1] track-001: all met' in captured.err
    assert json.loads((tmp_path / 'results' / 'fidelity.json').read_text())['model'] == model[1]


def test_a_reply_that_is_not_recorded_ends_the_measurement(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / 'prompts.jsonl'
    file.write_text(json.dumps(ROW) + '\n', encoding='utf-8')
    asked = ['bench', 'fidelity', str(file), '--model', 'openai/x', '--transcripts', str(tmp_path)]
    assert run_command_line(asked) == 4
    captured = capsys.readouterr()
    assert 'expected a recorded reply of openai/x' in captured.err
    assert 'requirement fidelity' not in captured.out


@pytest.mark.parametrize(
    'arguments',
    [
        ['record', 'FILE', '--model', 'offline', '--transcripts', 'x'],
        ['record', 'FILE', '--model', 'gpt', '--transcripts', 'x'],
        ['record', 'absent.jsonl', '--model', 'openai/x', '--transcripts', 'x'],
        ['record', 'FILE'],
        ['fidelity', 'FILE', '--model', 'gpt'],
        ['fidelity', 'FILE', '--colour'],
    ],
)
def test_what_cannot_be_asked_leaves_with_64(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'FILE').write_text(json.dumps(ROW) + '\n', encoding='utf-8')
    assert run_command_line(['bench', *arguments]) == 64
