# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The validator as a command."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_bench.prompts.__main__ import main
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.shipped import first_files, prompt_file
from aurora_bench.prompts.statistics import style


def test_a_file_in_order_gives_tables_and_zero(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(path) for path in first_files('tune')]) == 0
    text = capsys.readouterr().out
    assert '| communication' in text
    assert '| temporal_contradiction' in text
    assert text.splitlines()[-1] == '200 prompts, 0 errors'


def test_errors_and_a_group_in_two_files_give_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = prompt_file('tune', 'bench').read_text('utf-8').splitlines()
    line = next(
        line for line in lines if AnnotatedPrompt.model_validate_json(line).paraphrase_group
    )
    group = AnnotatedPrompt.model_validate_json(line).paraphrase_group
    one, two = tmp_path / 'one.jsonl', tmp_path / 'two.jsonl'
    one.write_text(line, encoding='utf-8')
    two.write_text(line, encoding='utf-8')
    assert main(['--json', str(one), str(two)]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document['groups_in_two_files'] == [group]
    assert {f['rule'] for f in document['findings'] if f['is_error']} == {
        'duplicate-id',
        'duplicate-prompt',
    }


def test_the_figure_is_drawn_and_the_same_again(tmp_path: Path) -> None:
    path = str(prompt_file('tune', 'bench'))
    for name in ('one', 'two'):
        assert main([path, '--figure', str(tmp_path), '--name', name]) == 0
    assert (tmp_path / 'one.png').read_bytes() == (tmp_path / 'two.png').read_bytes()
    text = (tmp_path / 'one.svg').read_text('utf-8')
    assert '120 prompts by category' in text
    assert text == (tmp_path / 'two.svg').read_text('utf-8')


def test_a_figure_that_cannot_be_written_is_a_usage_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / 'taken').write_text('')
    path = str(prompt_file('tune', 'multi_uav'))
    assert main([path, '--figure', str(tmp_path / 'taken')]) == 64
    assert 'taken' in capsys.readouterr().err


def test_a_file_that_is_not_there_is_a_usage_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(tmp_path / 'none.jsonl')]) == 64
    assert 'none.jsonl' in capsys.readouterr().err


@pytest.mark.parametrize(
    ('prompt', 'look'),
    [
        ('A drone hovers over City Hall at 50 m.', 'plain'),
        ('drone hover city hall 50m alt', 'careless'),
        (
            'I would like a quadcopter to hold its position fifty metres above City Hall, and to '
            'do so for twenty seconds before it comes back down.',
            'wordy',
        ),
    ],
)
def test_style_by_look(prompt: str, look: str) -> None:
    assert style(prompt) == look
