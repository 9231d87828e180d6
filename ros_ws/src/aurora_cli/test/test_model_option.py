# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`--model`: a model over HTTP, what the run folder keeps of it, and the recording as a model."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_llm.testing.model_server import ModelServer, Turn

# Too high: the run ends before anything is simulated, with everything that is tested here.
PROMPT = 'A drone hovers over the ego car at 200 m.'
ANSWER = json.dumps(
    {
        'agents': [{'id': 'e', 'type': 'car', 'quote': 'the ego car'}],
        'uavs': [{'id': 'u', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm',
                'uav': 'u',
                'mode': 'hover',
                'target': 'e',
                'altitude_m': {'value': 200, 'unit': 'm', 'quote': '200 m'},
                'quote': PROMPT[:-1],
            }
        ],
        'clauses': [{'quote': PROMPT[:-1], 'status': 'encoded', 'ids': ['m', 'e']}],
    }
)
Call = Callable[..., SimpleNamespace]


def _folder(root: Path, report: dict[str, str]) -> Path:
    return root / 'runs' / report['run_id']


def test_run_folder_keeps_the_conversation_and_its_cost(here: Path, call: Call) -> None:
    turns = [Turn(text='Sorry?'), Turn(text=f'```json\n{ANSWER}\n```')]
    with ModelServer(turns) as server:
        done = call('run', PROMPT, '--model', f'openai/local@{server.url}', '--json')
    report = json.loads(done.out)
    assert (done.code, report['status']) == (5, 'infeasible'), done.err
    assert report['model'].startswith('openai/local@')
    assert report['cost'] == {'calls': 2, 'tokens_in': 200, 'tokens_out': 20, 'money_usd': None}
    folder = _folder(here, report)
    lines = (folder / 'transcript.jsonl').read_text(encoding='utf-8').splitlines()
    first, second = map(json.loads, lines)
    assert (first['reply'], bool(first['complaints'])) == ('Sorry?', True)
    assert (second['attempt'], second['complaints']) == (2, [])
    spec = json.loads((folder / 'spec.0.json').read_text(encoding='utf-8'))
    reference = parse_offline(PROMPT, ParseContext()).spec
    assert reference is not None
    assert spec['missions'] == reference.model_dump(mode='json')['missions']

    recording = f'recorded:{folder.relative_to(here)}/transcript.jsonl'
    again = json.loads(call('run', PROMPT, '--model', recording, '--json').out)
    assert again['digests']['spec'] == report['digests']['spec']
    assert again['cost'] == report['cost']

    checked = call('check', PROMPT, '--model', recording, '--json')
    assert checked.code == 5
    assert json.loads(checked.out)['spec'] == spec


def test_answers_that_the_prompt_does_not_support_end_as_a_question(
    here: Path, call: Call
) -> None:
    with ModelServer([Turn(text=ANSWER.replace('200, ', '100, '))]) as server:
        done = call('run', PROMPT, '--model', f'openai/local@{server.url}', '--json')
    report = json.loads(done.out)
    assert (done.code, report['status']) == (3, 'not_understood')
    assert "100 m is not what '200 m' says" in report['question']
    assert report['cost']['calls'] == 3
    assert not (_folder(here, report) / 'spec.0.json').exists()


def test_offline_needs_no_litellm_and_leaves_no_transcript(here: Path) -> None:
    code = (
        'import sys; from aurora_cli.main import run_command_line as r; '
        f'code = r(["run", {PROMPT!r}]); assert "litellm" not in sys.modules; sys.exit(code)'
    )
    done = subprocess.run([sys.executable, '-c', code], cwd=here, check=False, timeout=120)
    assert done.returncode == 5
    assert list(here.glob('runs/*/report.json'))
    assert not list(here.glob('runs/*/transcript.jsonl'))


def test_name_that_means_nothing_is_a_usage_error(here: Path, call: Call) -> None:
    done = call('run', PROMPT, '--model', 'some-model')
    assert done.code == 64
    assert 'expected offline, recorded:FILE, provider/model or one of local' in done.err
    assert list(here.iterdir()) == []


def test_a_secret_in_an_address_is_refused_and_told_nowhere(here: Path, call: Call) -> None:
    for name in (
        'openai/x@http://somebody:hunter2@127.0.0.1:1/v1?key=hunter3',
        'openai/x@http://127.0.0.1:1/v1?key=hunter3,offline',
        'openai/x@somebody:hunter2@127.0.0.1',
    ):
        for command in ('run', 'check'):
            done = call(command, PROMPT, '--model', name)
            assert done.code == 64
            assert 'config/models.yaml' in done.err
            assert 'hunter' not in done.out + done.err
        examined = call('doctor', '--model', name)
        assert 'hunter' not in examined.out + examined.err
    assert list(here.iterdir()) == []


def test_an_answer_without_measure_is_kept_nowhere(here: Path, call: Call) -> None:
    turns = [Turn(text='x' * (1 << 20)), Turn(text=f'```json\n{ANSWER}\n```')]
    with ModelServer(turns) as server:
        done = call('run', PROMPT, '--model', f'openai/local@{server.url}', '--json')
        first_asked, second_asked = server.requests
        assert first_asked['messages'] == second_asked['messages']  # not told what it wrote
    report = json.loads(done.out)
    assert (done.code, report['status']) == (5, 'infeasible'), done.err
    transcript = _folder(here, report) / 'transcript.jsonl'
    first, second = map(json.loads, transcript.read_text(encoding='utf-8').splitlines())
    assert (first['reply'], first['failure']['kind']) == (None, 'truncated')
    assert '262144 characters' in first['failure']['message']
    assert second['attempt'] == 2
