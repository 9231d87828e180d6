# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The real parser as a process: it answers others while a language model is silent."""

from __future__ import annotations

import contextlib
import json
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import AuroraError
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.ports.language_model import ModelCall
from aurora_llm.testing.model_server import ModelServer, Turn
from aurora_ros import interfaces as on
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.partner import Partner, partner
from aurora_ros.testing.processes import NodeProcess, nodes

pytestmark = pytest.mark.ros

LIMIT_S = 90.0  # the first call imports litellm, which takes seconds
PROMPT = 'A drone hovers over the ego car at 40 m.'
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
                'altitude_m': {'value': 40, 'unit': 'm', 'quote': '40 m'},
                'quote': PROMPT[:-1],
            }
        ],
        'clauses': [{'quote': PROMPT[:-1], 'status': 'encoded', 'ids': ['m', 'e']}],
    }
)


def options(model: str) -> str:
    return json.dumps({'model': model})


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[tuple[NodeProcess, Partner]]:
    with own_domain() as domain, partner(domain) as play:
        process = ForkedNode('aurora_nodes.parser', domain, tmp_path)
        with nodes(process):
            yield process, play


def test_model_reads_the_prompt_and_its_transcript_comes_along(
    graph: tuple[NodeProcess, Partner],
) -> None:
    _, play = graph
    with ModelServer([Turn(text='what?'), Turn(text=ANSWER)]) as server:
        model = f'openai/local@{server.url}'
        response = play.call(on.PARSE, LIMIT_S, prompt=PROMPT, options_json=options(model))
    assert response.error_code == 0, response.error_msg
    assert response.understood
    by_model = ParseOutcome.model_validate_json(response.outcome_json).spec
    offline = play.call(on.PARSE, prompt=PROMPT)
    reference = ParseOutcome.model_validate_json(offline.outcome_json).spec
    assert by_model is not None
    assert reference is not None
    assert by_model.missions == reference.missions
    calls = [ModelCall.model_validate_json(x) for x in response.transcript_jsonl.splitlines()]
    assert [call.reply for call in calls] == ['what?', ANSWER]
    assert offline.transcript_jsonl == ''


def test_it_answers_and_ends_while_a_model_is_silent(graph: tuple[NodeProcess, Partner]) -> None:
    process, play = graph
    with ModelServer([Turn(hang=True)]) as server:
        model = f'openai/local@{server.url}'

        def ask() -> None:
            with contextlib.suppress(AuroraError):  # the node ends before it can answer
                play.call(on.PARSE, LIMIT_S, prompt=PROMPT, options_json=options(model))

        asking = threading.Thread(target=ask, daemon=True)
        asking.start()
        while not server.requests:
            time.sleep(0.01)
        assert play.call(on.PARSE, prompt=PROMPT).understood
        assert play.call(on.roll_call('parser')).error_code == 0
        assert asking.is_alive(), 'nobody waited for the model'
        assert process.end() == 0
