# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""R12: a model server may misbehave in any way; what asks it ends in time all the same."""

from __future__ import annotations

import json
import random
import time
from collections.abc import Callable
from pathlib import Path

from aurora_bench.trust.part import Counter, Found
from aurora_bench.trust.revision import OPEN_FIELD, problem_of, revise, scene
from aurora_cli.installed import installed
from aurora_core.pipeline.stages import RunRequest
from aurora_core.repair.helps import ANCHOR
from aurora_llm.model_parse import client_of
from aurora_llm.parse import read_prompt
from aurora_llm.settings import ModelSettings, load_model_settings
from aurora_llm.testing.model_server import ModelServer, Turn

_PROMPT = 'A drone hovers over City Hall at 50 m for 20 seconds.'
_TIMEOUT_S, _ATTEMPTS = 0.5, 2
# Beyond what the calls may take: building the question, and reading what came.
_SLACK_S = 1.0
_SECRET = 'sk-trust-0123456789abcdef'


def _turns(number: int) -> tuple[str, Turn]:
    rng = random.Random(number)
    deep = '[' * rng.randrange(1_000, 100_000)
    kinds = (
        ('hang', Turn(hang=True)),
        ('slow drip', Turn(text='x' * 1000, drip=True)),
        ('500', Turn(status=500, text=f'oops {_SECRET}')),
        ('429', Turn(status=429, text='slow down', headers={'Retry-After': '100000'})),
        ('connection reset', Turn(text='x' * rng.randrange(10, 5000), cut=True)),
        ('truncated JSON', Turn(text='{"spec": {"agents": [', finish='length')),
        ('wrong schema', Turn(text='{"agents": 7, "verdict": "verified"}')),
        ('extra field', Turn(text='{"spec": {}, "clauses": [], "run": "rm -rf /"}')),
        ('10 MB', Turn(text='{}', flood=10 << 20)),
        ('compressed', Turn(text='{}', packed=True)),
        ('bad UTF-8', Turn(raw='{"choices": [{"message": {"content": "\ud800"}}]}'.encode(
            'utf-8', 'surrogatepass').decode('latin-1'))),
        ('empty', Turn(text='')),
        ('refusal', Turn(text='I cannot help with that.')),
        ('redirect', Turn(status=307, headers={'Location': 'http://127.0.0.1:9/v1'})),
        ('deep JSON', Turn(text=deep)),
        ('not HTTP JSON', Turn(raw='<html>' * 50)),
        ('no choices', Turn(raw='{"choices": []}')),
        ('numbers beyond all', Turn(text='{"spec": {"duration_s": 1e999}}')),
    )  # fmt: skip
    return kinds[number % len(kinds)]


def _settings() -> ModelSettings:
    usual = load_model_settings()
    return usual.model_copy(
        update={'attempts': _ATTEMPTS, 'timeout_s': _TIMEOUT_S, 'most_wait_s': 0.1}
    )


def model_servers(first: int, count: int, _: Path) -> Found:
    """Read a prompt with a hostile server.

    A case holds when it ends within its deadline, with at most so many calls as are allowed, with
    no specification, with the prompt sent nowhere else and no key in what is recorded.
    """

    def ask(request: RunRequest, settings: ModelSettings) -> tuple[str, str]:
        outcome = read_prompt(installed(), request, settings)
        problem = '' if outcome.spec is None else 'a specification came of it'
        return problem, outcome.model_dump_json()

    return _asked(first, count, _turns, ask)


def revisions(first: int, count: int, _: Path) -> Found:
    """Revise a realisation with a hostile server, as repair does.

    A case holds when it ends within its deadline, with at most so many calls as are allowed,
    nothing moves but what is open, and no key is in what is recorded.
    """
    scene()

    def ask(request: RunRequest, settings: ModelSettings) -> tuple[str, str]:
        client = client_of(request.model, settings, request)
        proposal = revise(client, settings.attempts)
        return problem_of(proposal), proposal.model_dump_json()

    return _asked(first, count, _revising_turns, ask)


def _revising_turns(number: int) -> tuple[str, Turn]:
    """Return an answer as for a prompt, or one that has the form of a revision."""
    wrong = (
        ('outside', [{'field': OPEN_FIELD, 'value': 1e6}]),
        ('not finite', [{'field': OPEN_FIELD, 'value': float('nan')}]),
        ('what is stated', [{'field': 'events/e1/trigger/value_m', 'value': 90.0}]),
        ('too many', [{'field': f'missions/m1/x{k}', 'value': 1.0} for k in range(7)]),
        ('twice', [{'field': OPEN_FIELD, 'value': 50.0}] * 2),
        ('the place with a value', [{'field': ANCHOR, 'value': 3.0}]),
    )
    if number % 2:
        return _turns(number // 2)
    kind, fields = wrong[number // 2 % len(wrong)]
    return kind, Turn(text=json.dumps({'fields': fields, 'because': 'it is so'}))


def _asked(
    first: int,
    count: int,
    turns: Callable[[int], tuple[str, Turn]],
    ask: Callable[[RunRequest, ModelSettings], tuple[str, str]],
) -> Found:
    """Ask hostile servers; `ask` returns what is wrong and what would be recorded."""
    counter = Counter()
    settings = _settings()
    _warm(settings)
    limit_s = _ATTEMPTS * _TIMEOUT_S + _SLACK_S
    for number in range(first, first + count):
        kind, turn = turns(number)
        with ModelServer([turn]) as server:
            request = RunRequest(prompt=_PROMPT, model=f'openai/local@{server.url}')
            begun_s = time.monotonic()
            try:
                problem, recorded = ask(request, settings)
                if _SECRET in recorded and kind != '500':
                    problem = 'the answer has a key'
            except Exception as err:  # noqa: BLE001  (whatever it is, it is what is looked for)
                problem = f'{type(err).__name__}: {err}'
            took_s = time.monotonic() - begun_s
            if took_s > limit_s:
                problem = problem or f'it took {took_s:.1f} s'
            if len(server.requests) > _ATTEMPTS:
                problem = problem or f'{len(server.requests)} calls'
        counter.figure('slowest [s]', round(took_s, 2))
        counter.add(f'{kind}: {problem}' if problem else '')
    return counter.found()


def _warm(settings: ModelSettings) -> None:
    """Import what takes seconds."""
    with ModelServer([Turn(text='{}')]) as server:
        request = RunRequest(prompt=_PROMPT, model=f'openai/local@{server.url}')
        patient = settings.model_copy(update={'timeout_s': 60.0})
        read_prompt(installed(), request, patient)
