# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Replies recorded from a model over HTTP, and the same prompt again without one."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aurora_cli.installed import installed
from aurora_core.errors import ConfigError
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.language_model import (
    FailureKind,
    LanguageModel,
    Message,
    ModelFailure,
    ModelRequest,
)
from aurora_llm.parse import read_prompt
from aurora_llm.reply_store import RecordingClient, ReplyStore, StoredClient
from aurora_llm.settings import ModelSettings, load_model_settings
from aurora_llm.testing.model_server import ModelServer, Turn

PROMPT = 'A drone follows a motorcycle at 40 m altitude.'
ANSWER = {
    'agents': [{'id': 'm', 'type': 'motorcycle', 'quote': 'a motorcycle'}],
    'uavs': [{'id': 'u', 'quote': 'A drone'}],
    'missions': [
        {
            'id': 'p',
            'uav': 'u',
            'mode': 'track',
            'target': 'm',
            'altitude_m': {'value': 40, 'unit': 'm', 'quote': '40 m'},
            'quote': 'A drone follows a motorcycle',
        }
    ],
    'clauses': [{'quote': PROMPT[:-1], 'status': 'encoded', 'ids': ['p', 'm']}],
}
GOOD = Turn(text=json.dumps(ANSWER))
TURNS = (Turn(status=500), Turn(text='Sorry?'), GOOD)


def settings(**changes: Any) -> ModelSettings:
    shipped = load_model_settings().model_dump(by_alias=True)
    return ModelSettings.model_validate(shipped | {'timeout_s': 20.0, **changes})


def record(model: str, folder: Path, prompt: str = PROMPT) -> tuple[ParseOutcome, int]:
    """Return what came of a recording, and how many calls it took."""
    clients: list[RecordingClient] = []

    def wrap(client: LanguageModel) -> LanguageModel:
        clients.append(RecordingClient(client, ReplyStore(folder)))
        return clients[-1]

    outcome = read_prompt(installed(), RunRequest(prompt=prompt, model=model), settings(), wrap)
    return outcome, sum(client.asked for client in clients)


def replay(model: str, folder: Path, **changes: Any) -> ParseOutcome:
    fields = {'prompt': PROMPT, 'model': model, 'transcripts': folder, **changes}
    return read_prompt(installed(), RunRequest.model_validate(fields), settings())


def test_replay_gives_the_same_calls_and_specification(tmp_path: Path) -> None:
    with ModelServer(TURNS) as server:
        model = f'openai/local@{server.url}'
        live, asked = record(model, tmp_path)
        assert asked == len(server.requests) == 3
        again, asked = record(model, tmp_path)
        assert (asked, len(server.requests)) == (0, 3), 'what is recorded is not asked again'
    assert live.spec is not None
    replayed = replay(model, tmp_path)
    assert replayed == live == again
    assert replay(model, tmp_path) == live


@pytest.mark.parametrize(
    'changes',
    [{'prompt': 'A drone hovers.'}, {'map_name': 'junction'}, {'model': 'openai/other'}],
)
def test_a_missing_reply_is_an_error_and_no_call(tmp_path: Path, changes: dict[str, str]) -> None:
    with ModelServer([GOOD]) as server:
        model = f'openai/local@{server.url}'
        record(model, tmp_path)
        with pytest.raises(ConfigError, match='expected a recorded reply') as err:
            replay(changes.pop('model', model), tmp_path, **changes)
        assert len(server.requests) == 1
    assert 'aurora bench record' in err.value.hint


def test_what_ended_in_failures_is_asked_again(tmp_path: Path) -> None:
    with ModelServer([Turn(status=500)] * 3 + [GOOD]) as server:
        model = f'openai/local@{server.url}'
        first, _ = record(model, tmp_path)
        assert first.spec is None
        assert replay(model, tmp_path) == first
        second, asked = record(model, tmp_path)
    assert asked == 1
    assert second.spec is not None
    assert replay(model, tmp_path) == second


def test_a_damaged_or_exchanged_file_is_named(tmp_path: Path) -> None:
    with ModelServer([GOOD]) as server:
        model = f'openai/local@{server.url}'
        record(model, tmp_path)
    (file,) = tmp_path.iterdir()
    text = file.read_text()
    file.write_text(text.replace(model, 'openai/x'))
    with pytest.raises(ConfigError, match='another request'):
        replay(model, tmp_path)
    file.write_text(text[: len(text) // 2])
    with pytest.raises(ConfigError, match='holds no replies'):
        replay(model, tmp_path)


def test_who_can_go_on_without_a_reply_is_told_that_none_is_recorded(tmp_path: Path) -> None:
    asked = ModelRequest(messages=(Message(role='user', content='what else?'),), schema_text='{}')
    silent = StoredClient('openai/gone', ReplyStore(tmp_path), must=False)
    answer = silent.complete(asked)
    assert isinstance(answer, ModelFailure)
    assert answer.kind is FailureKind.NOT_RECORDED
    with pytest.raises(ConfigError, match='expected a recorded reply'):
        StoredClient('openai/gone', ReplyStore(tmp_path)).complete(asked)
