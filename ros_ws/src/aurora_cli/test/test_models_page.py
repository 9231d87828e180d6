# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The commands of docs/models.md do what the page says, with a server at the address it names."""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

from aurora_llm.settings import load_model_settings
from aurora_llm.testing.model_server import ModelServer, Turn

PAGE = (Path(__file__).resolve().parents[4] / 'docs' / 'models.md').read_text(encoding='utf-8')
COMMANDS = re.findall(r'```bash\naurora (.*?)\n```', PAGE)
ADDRESS = 'http://127.0.0.1:8000/v1'
INFEASIBLE = 5  # 200 m is above the limit, however it is read
ANSWER = json.dumps(
    {
        'agents': [{'id': 'ego', 'type': 'car', 'quote': 'the ego car'}],
        'uavs': [{'id': 'uav1', 'quote': 'A drone'}],
        'missions': [
            {
                'id': 'm1',
                'uav': 'uav1',
                'mode': 'hover',
                'target': 'ego',
                'altitude_m': {'value': 200, 'unit': 'm', 'quote': '200 m'},
                'quote': 'A drone hovers over the ego car',
            }
        ],
        'clauses': [
            {
                'quote': 'A drone hovers over the ego car at 200 m',
                'status': 'encoded',
                'ids': ['m1'],
            }
        ],
    }
)


def test_commands(here: Path, call: Callable[..., SimpleNamespace]) -> None:
    check, remember, replay = map(shlex.split, COMMANDS)
    with ModelServer([Turn(text=ANSWER)]) as server:
        asked = [word.replace(ADDRESS, server.url) for word in check]
        assert call(*asked).code == INFEASIBLE
        done = call('run', '--json', *asked[1:])
        shown = call(*(word.replace(ADDRESS, server.url) for word in remember))
    run_id = json.loads(done.out)['run_id']
    again = call(*(word.replace('<run_id>', run_id) for word in replay), '--json')
    assert json.loads(again.out)['cost']['calls'] == 1
    assert (done.code, shown.code, again.code) == (INFEASIBLE,) * 3
    assert not (here / 'history').exists(), 'only verified runs enter'
    assert (here / 'runs' / run_id / 'retrieval.json').is_file()


def test_settings_are_those_that_the_page_names() -> None:
    settings = load_model_settings()
    assert (settings.timeout_s, settings.attempts, settings.fallback) == (60.0, 3, ())
    assert settings.entry('local').api_base == ADDRESS
