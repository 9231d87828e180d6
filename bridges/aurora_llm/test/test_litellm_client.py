# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The adapter over real HTTP: one request a call, every kind of failure told apart."""

from __future__ import annotations

from dataclasses import replace

import httpx
import pytest

from aurora_core.ports.language_model import (
    FailureKind,
    Message,
    ModelFailure,
    ModelReply,
    ModelRequest,
)
from aurora_llm.litellm_client import MOST_ANSWER_BYTES, LitellmClient
from aurora_llm.settings import ModelEntry, ModelSettings, RetrievalSettings
from aurora_llm.testing.model_server import ModelServer, Turn

REQUEST = ModelRequest(
    messages=(Message(role='user', content='a prompt'),),
    schema_text='{"type": "object", "properties": {}}',
)
CANARY = 'sk-canary-0123456789'


def client(url: str, *, timeout_s: float = 20.0, schema: bool = True) -> LitellmClient:
    settings = ModelSettings(
        fallback=(),
        attempts=3,
        timeout_s=timeout_s,
        most_wait_s=0.0,
        max_tokens=100,
        temperature=0.0,
        retrieval=RetrievalSettings(
            embedding=False, fusion_k=60.0, assets=1, spawns=1, episodes=1
        ),
        models={},
    )
    entry = ModelEntry.model_validate({'model': 'openai/local', 'api_base': url, 'schema': schema})
    return LitellmClient('local', entry, settings)


def test_answer_with_its_tokens_and_no_price_for_a_model_without_one() -> None:
    with ModelServer([Turn(text='{"a": 1}')]) as server:
        reply = client(server.url).complete(REQUEST)
        assert reply == ModelReply(text='{"a": 1}', tokens_in=100, tokens_out=10, cost_usd=None)
        sent = server.requests[0]
    assert sent['messages'] == [{'role': 'user', 'content': 'a prompt'}]
    assert sent['response_format']['json_schema']['schema'] == REQUEST.schema_object


def test_server_that_takes_no_schema_is_sent_none() -> None:
    with ModelServer([Turn(text='x')]) as server:
        client(server.url, schema=False).complete(REQUEST)
        assert 'response_format' not in server.requests[0]


@pytest.mark.parametrize(
    ('turn', 'kind'),
    [
        (Turn(status=429, text='slow down', headers={'Retry-After': '7'}), 'rate_limited'),
        (Turn(status=500, text='oops'), 'unavailable'),
        (Turn(status=503, text='loading'), 'unavailable'),
        (Turn(status=401, text='no'), 'refused'),
        (Turn(status=404, text='no such model'), 'refused'),
        (Turn(status=400, text='no json_schema here'), 'refused'),
        (Turn(text='x' * 500, cut=True), 'unavailable'),
        (Turn(raw='not even json'), 'unavailable'),
        (Turn(raw='{"choices": []}'), 'unavailable'),
        (Turn(text='{"a"', finish='length'), 'truncated'),
    ],
    ids=lambda value: value if isinstance(value, str) else '',
)
def test_one_request_and_the_kind_of_failure(turn: Turn, kind: str) -> None:
    with ModelServer([turn]) as server:
        failure = client(server.url).complete(REQUEST)
        assert isinstance(failure, ModelFailure)
        assert failure.kind is FailureKind(kind), failure.message
        assert failure.retry_after_s == (7.0 if turn.headers else None)
        assert len(server.requests) == 1


@pytest.mark.parametrize('turn', [Turn(hang=True), Turn(text='x' * 10_000, drip=True)])
def test_server_that_does_not_end_is_cut_off_in_time(turn: Turn) -> None:
    with ModelServer([Turn(text='warm'), turn]) as server:
        client(server.url).complete(REQUEST)  # the import of litellm takes seconds
        failure = client(server.url, timeout_s=0.5).complete(REQUEST)  # it would hang for ever
    assert isinstance(failure, ModelFailure)
    assert failure.kind is FailureKind.TIMEOUT


def test_nobody_there() -> None:
    failure = client('http://127.0.0.1:9/v1').complete(REQUEST)
    assert isinstance(failure, ModelFailure)
    assert failure.kind is FailureKind.UNAVAILABLE


def test_keys_go_to_the_server_and_never_into_the_record(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv('OPENAI_API_KEY', CANARY)
    turns = [Turn(status=401, text=f'Incorrect API key: {CANARY}'), Turn(text=f'{CANARY}!')]
    with ModelServer(turns) as server:
        failure = client(server.url).complete(REQUEST)
        reply = client(server.url).complete(REQUEST)
        assert server.authorizations == [f'Bearer {CANARY}'] * 2
    assert isinstance(failure, ModelFailure)
    assert CANARY not in failure.message
    assert reply == ModelReply(text='[key]!', tokens_in=100, tokens_out=10)


def test_a_redirect_is_not_followed_with_the_prompt() -> None:
    with ModelServer([Turn(text='{"a": 1}')]) as elsewhere:
        away = Turn(status=307, headers={'Location': f'{elsewhere.url}/chat/completions'})
        with ModelServer([away]) as server:
            failure = client(server.url).complete(REQUEST)
        assert elsewhere.requests == []
    assert isinstance(failure, ModelFailure)
    assert failure.kind is FailureKind.REFUSED
    assert 'elsewhere' in failure.message


def test_an_answer_without_end_is_cut_off_and_the_next_request_works() -> None:
    flood = Turn(text='{"a": 1}', flood=1 << 30)
    with ModelServer([flood, Turn(text='{"a": 1}')]) as server:
        asked = client(server.url)
        failure = asked.complete(REQUEST)
        assert isinstance(failure, ModelFailure)
        assert failure.kind is FailureKind.TRUNCATED
        assert f'{MOST_ANSWER_BYTES} bytes' in failure.message
        assert server.sent_bytes < 64 << 20  # what the sockets hold
        assert isinstance(asked.complete(REQUEST), ModelReply)


def test_an_answer_that_unpacks_to_more_is_not_unpacked() -> None:
    with ModelServer([Turn(text='x' * (1 << 26), packed=True)]) as server:
        failure = client(server.url).complete(REQUEST)
    assert isinstance(failure, ModelFailure)
    assert 'compresses' in failure.message


def test_other_http_of_the_process_is_left_alone() -> None:
    with ModelServer([Turn(text='x', packed=True)]) as server:
        client(server.url).complete(REQUEST)
        assert httpx.post(server.url, json={}).status_code == 200


@pytest.mark.parametrize(
    'turn', [Turn(text='{user} {word} {key}', status=400), Turn(raw='{word}')]
)
def test_a_password_in_an_address_is_in_no_failure(turn: Turn) -> None:
    secrets = {'user': 'somebody', 'word': 'pass%40word', 'key': 'query-key'}
    turn = replace(
        turn, text=turn.text.format(**secrets), raw=turn.raw and turn.raw.format(**secrets)
    )
    with ModelServer([turn]) as server:
        address = server.url.replace('://', '://somebody:pass%40word@') + '?key=query-key'
        told = client(address).complete(REQUEST).model_dump_json()
    for secret in (*secrets.values(), 'pass@word'):
        assert secret not in told


def test_a_server_that_is_not_there_tells_no_password() -> None:
    failure = client('http://somebody:password@127.0.0.1:1/v1').complete(REQUEST)
    assert isinstance(failure, ModelFailure)
    assert 'password' not in failure.message
