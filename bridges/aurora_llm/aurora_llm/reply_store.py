# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded replies in a folder, one file per request and model: campaigns without a network.

The key of a file is a digest of model name, messages and schema. Calls of one request stand in the
order in which they were made (a time-out, then an answer).
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

from pydantic import ValidationError

from aurora_core.errors import ConfigError
from aurora_core.files import TRANSCRIPT_BYTES, read_text
from aurora_core.ports.language_model import (
    FailureKind,
    LanguageModel,
    ModelCall,
    ModelFailure,
    ModelReply,
    ModelRequest,
)
from aurora_llm.recorded_client import replayed


class ReplyStore:
    """The folder.

    Args:
        folder: Made when the first reply comes.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def path(self, model: str, request: ModelRequest) -> Path:
        """Return the file for a request to a model."""
        key = hashlib.sha256(f'{model}\0{request.sha256}'.encode()).hexdigest()
        return self.folder / f'{key}.jsonl'

    def calls(self, model: str, request: ModelRequest) -> tuple[ModelCall, ...]:
        """Return what a model answered to a request, () when that is not recorded.

        Raises:
            ConfigError: The file cannot be read, or holds something else.
        """
        path = self.path(model, request)
        try:
            lines = read_text(path, TRANSCRIPT_BYTES).split('\n')
            found = tuple(ModelCall.model_validate_json(line) for line in lines if line.strip())
        except FileNotFoundError:
            return ()
        except (OSError, UnicodeDecodeError, ValidationError) as err:
            raise ConfigError(f'{path} holds no replies: {err}', hint='record them again') from err
        if any((c.model, c.request_sha256) != (model, request.sha256) for c in found):
            raise ConfigError(f'{path} holds replies to another request', hint='record them again')
        return found

    def write(self, model: str, request: ModelRequest, calls: tuple[ModelCall, ...]) -> None:
        """Write all calls of a request, whole.

        Raises:
            ConfigError: The folder cannot be written.
        """
        path = self.path(model, request)
        temporary = path.with_name(f'.writing-{os.getpid()}-{path.name}')
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            text = ''.join(call.model_dump_json() + '\n' for call in calls)
            temporary.write_text(text, encoding='utf-8')
            temporary.replace(path)
        except OSError as err:
            raise ConfigError(
                f'{path} cannot be written: {err}', hint='name a folder that you may write'
            ) from err


class StoredClient:
    """Answers from a store and never asks anybody.

    Args:
        name: Model whose replies are wanted.
        store: Where they are.
        must: Whether nothing goes on without the reply that is asked for.
    """

    def __init__(self, name: str, store: ReplyStore, *, must: bool = True) -> None:
        self._name = name
        self._store = store
        self._must = must
        self._next: dict[str, int] = {}

    @property
    def name(self) -> str:
        """Name for the record."""
        return self._name

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        """Answer as it was answered when it was recorded.

        Raises:
            ConfigError: It was not recorded, and must be: a campaign reads no prompt without it.
        """
        calls = self._store.calls(self._name, request)
        at = self._next.get(request.sha256, 0)
        if at >= len(calls) and not self._must:
            return ModelFailure(kind=FailureKind.NOT_RECORDED, message='no reply is recorded')
        if at >= len(calls):
            found = f'{len(calls)} of them' if calls else 'none'
            raise ConfigError(
                f'expected a recorded reply of {self._name} in {self._store.folder}, found '
                f'{found} for this request ({self._store.path(self._name, request).stem[:12]}…)',
                hint='record it with: aurora bench record; another prompt, map, history, limit or '
                'version of AURORA is another request',
            )
        self._next[request.sha256] = at + 1
        return replayed(calls[at])


class RecordingClient:
    """Asks a model what is not in a store yet, and keeps every answer and failure.

    Args:
        model: Who is asked.
        store: Where calls go; a request whose last call is an answer is not made again.
    """

    def __init__(self, model: LanguageModel, store: ReplyStore) -> None:
        self._model = model
        self._store = store
        self._stored = StoredClient(model.name, store)
        self._made: dict[str, tuple[ModelCall, ...]] = {}

    @property
    def asked(self) -> int:
        """Calls that were really made."""
        return sum(map(len, self._made.values()))

    @property
    def name(self) -> str:
        """Name for the record."""
        return self._model.name

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        """Answer from the store, else ask and keep.

        Raises:
            ConfigError: The store cannot be read or written.
        """
        key = request.sha256
        stored = self._store.calls(self.name, request)
        # What ended in failures is made again, from the beginning.
        if key not in self._made and stored and stored[-1].failure is None:
            return self._stored.complete(request)
        before = self._made.get(key, ())
        answer = self._model.complete(request)
        call = ModelCall(
            model=self.name,
            attempt=len(before) + 1,
            request_sha256=key,
            request=request,
            reply=answer.text if isinstance(answer, ModelReply) else None,
            failure=answer if isinstance(answer, ModelFailure) else None,
            tokens_in=answer.tokens_in if isinstance(answer, ModelReply) else 0,
            tokens_out=answer.tokens_out if isinstance(answer, ModelReply) else 0,
            cost_usd=answer.cost_usd if isinstance(answer, ModelReply) else None,
        )
        self._made[key] = (*before, call)
        self._store.write(self.name, request, self._made[key])
        return answer
