# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LitellmClient`: a language model of any provider, or of a local OpenAI-compatible server.

The only module that imports litellm, and only when a model is asked: the import takes seconds.
One `complete` is one HTTP request; litellm's own retries are off, the parser has its own loop.
"""

from __future__ import annotations

import concurrent.futures
import math
import os
import threading
from types import ModuleType
from typing import Any

from aurora_core.ports.language_model import FailureKind, ModelFailure, ModelReply, ModelRequest
from aurora_llm.secrets import redacted
from aurora_llm.settings import ModelEntry, ModelSettings

_MOST_MESSAGE = 300
# Of a whole HTTP answer: several times what is read of it (`MAX_REPLY_CHARACTERS`), escaped.
MOST_ANSWER_BYTES = 4 << 20
# By name, most special first: litellm's classes come with the lazy import.
_KINDS = (
    ('Timeout', FailureKind.TIMEOUT),
    ('RateLimitError', FailureKind.RATE_LIMITED),
    ('AuthenticationError', FailureKind.REFUSED),
    ('PermissionDeniedError', FailureKind.REFUSED),
    ('NotFoundError', FailureKind.REFUSED),
    ('BadRequestError', FailureKind.REFUSED),
    ('UnprocessableEntityError', FailureKind.REFUSED),
)
# Without a word from the server, a limit on requests is given this long.
_RATE_LIMIT_WAIT_S = 2.0


class LitellmClient:
    """One model.

    Args:
        name: Name for the record, as the user gave it.
        entry: Model and address.
        settings: Limits of a call.
    """

    def __init__(self, name: str, entry: ModelEntry, settings: ModelSettings) -> None:
        self._name = name
        self._entry = entry
        self._settings = settings

    @property
    def name(self) -> str:
        """Name for the record."""
        return self._name

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        """Ask once.

        The time limit holds for the whole call: a server that sends a byte now and then is cut
        off as well.
        """
        litellm = _litellm()
        from aurora_llm.guarded_http import Guard, guarded

        ended: list[Guard] = []
        answer: concurrent.futures.Future[Any] = concurrent.futures.Future()

        def ask() -> None:
            with guarded(MOST_ANSWER_BYTES) as guard:
                try:
                    answer.set_result(litellm.completion(**self._arguments(request)))
                except Exception as err:  # noqa: BLE001 - told to the thread that waits
                    if guard.problem:
                        ended.append(guard)
                    answer.set_exception(err)

        # A daemon: a server that never ends must not keep the process from ending.
        threading.Thread(target=ask, name='language model', daemon=True).start()
        try:
            return self._reply(answer.result(timeout=self._settings.timeout_s), litellm)
        except concurrent.futures.TimeoutError:
            return ModelFailure(
                kind=FailureKind.TIMEOUT,
                message=f'no answer within {self._settings.timeout_s:g} s',
            )
        except Exception as err:  # noqa: BLE001 - providers raise what they like; it is recorded
            if ended:
                kind = FailureKind.REFUSED if ended[0].is_final else FailureKind.TRUNCATED
                return ModelFailure(kind=kind, message=ended[0].problem)
            return _failure(err, self._entry)

    def _arguments(self, request: ModelRequest) -> dict[str, Any]:
        settings, entry = self._settings, self._entry
        arguments: dict[str, Any] = {
            'model': entry.model,
            'messages': [m.model_dump(mode='json') for m in request.messages],
            'timeout': settings.timeout_s,
            'max_retries': 0,
            'num_retries': 0,
            'max_tokens': settings.max_tokens,
            'temperature': settings.temperature,
            'drop_params': True,
        }
        if entry.schema_output:
            schema = {'name': 'scenario', 'schema': request.schema_object, 'strict': False}
            arguments['response_format'] = {'type': 'json_schema', 'json_schema': schema}
        if entry.api_base is not None:
            arguments['api_base'] = entry.api_base
            if entry.model.startswith('openai/') and 'OPENAI_API_KEY' not in os.environ:
                arguments['api_key'] = 'none'  # a local server needs none, the client insists
        return arguments

    def _reply(self, answer: Any, litellm: ModuleType) -> ModelReply | ModelFailure:
        choice = answer.choices[0] if answer.choices else None
        text = choice.message.content if choice is not None else None
        if choice is not None and choice.finish_reason == 'length':
            return ModelFailure(
                kind=FailureKind.TRUNCATED,
                message=f'the answer has more than {self._settings.max_tokens} tokens',
            )
        if not isinstance(text, str):
            return ModelFailure(kind=FailureKind.UNAVAILABLE, message='an answer without text')
        usage = getattr(answer, 'usage', None)
        return ModelReply(
            text=_redacted(text, self._entry),
            tokens_in=getattr(usage, 'prompt_tokens', None) or 0,
            tokens_out=getattr(usage, 'completion_tokens', None) or 0,
            cost_usd=_cost(answer, litellm),
        )


def _litellm() -> ModuleType:
    # Read at import: else a price list is fetched from the network.
    os.environ.setdefault('LITELLM_LOCAL_MODEL_COST_MAP', 'True')
    import litellm

    litellm.telemetry = False
    litellm.suppress_debug_info = True  # it prints advice to standard output
    return litellm


def _cost(answer: Any, litellm: ModuleType) -> float | None:
    try:
        return float(litellm.completion_cost(completion_response=answer))
    except Exception:  # noqa: BLE001 - it raises for every model whose price is not listed
        return None


def _failure(err: Exception, entry: ModelEntry) -> ModelFailure:
    names = {cls.__name__ for cls in type(err).__mro__}
    kind = next((k for name, k in _KINDS if name in names), FailureKind.UNAVAILABLE)
    text = ' '.join(f'{type(err).__name__}: {err}'.split())
    wait = _retry_after(err) if kind is FailureKind.RATE_LIMITED else None
    told = _redacted(text, entry)[:_MOST_MESSAGE]
    return ModelFailure(kind=kind, message=told, retry_after_s=wait)


def _retry_after(err: Exception) -> float:
    """Return how long to wait, s; litellm keeps the headers under a name of its own."""
    headers = getattr(err, 'litellm_response_headers', None) or {}
    try:
        asked = float(headers.get('retry-after', _RATE_LIMIT_WAIT_S))
    except ValueError:  # a date: rare, and not worth a wall clock
        return _RATE_LIMIT_WAIT_S
    return max(0.0, asked) if math.isfinite(asked) else _RATE_LIMIT_WAIT_S


def _redacted(text: str, entry: ModelEntry) -> str:
    """Take out keys: what comes from a server goes into the run folder."""
    return redacted(text, (entry.api_base or '', entry.model), os.environ)
