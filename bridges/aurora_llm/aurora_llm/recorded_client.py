# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`RecordedClient`: answers out of a `transcript.jsonl`, without a network."""

from __future__ import annotations

from collections import defaultdict, deque
from pathlib import Path

from pydantic import ValidationError

from aurora_core.errors import ConfigError
from aurora_core.files import TRANSCRIPT_BYTES, read_text
from aurora_core.ports.language_model import (
    FailureKind,
    ModelCall,
    ModelFailure,
    ModelReply,
    ModelRequest,
)

_HINT = 'give the transcript.jsonl of a run that a language model read'


class RecordedClient:
    """Answers requests as they were answered when the transcript was made.

    Args:
        name: Name for the record.
        path: The transcript.

    Raises:
        ConfigError: The file cannot be read, or a line of it is no recorded call.
    """

    def __init__(self, name: str, path: Path) -> None:
        self._name = name
        self._path = path
        # The same request may have been made again (after a time-out): answered in order.
        self._calls: defaultdict[str, deque[ModelCall]] = defaultdict(deque)
        for number, line in enumerate(_lines(path), start=1):
            if not line.strip():
                continue
            try:
                call = ModelCall.model_validate_json(line)
            except ValidationError:
                raise _no_transcript(path, f' (line {number})') from None
            self._calls[call.request_sha256].append(call)

    @property
    def name(self) -> str:
        """Name for the record."""
        return self._name

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        """Answer from the record; a request that is not in it is not answered."""
        calls = self._calls.get(request.sha256)
        if not calls:
            return ModelFailure(
                kind=FailureKind.NOT_RECORDED,
                message=f'{self._path.name} holds no answer to this request: another prompt, map '
                'or version of AURORA',
            )
        return replayed(calls.popleft())


def _lines(path: Path) -> list[str]:
    try:
        return read_text(path, TRANSCRIPT_BYTES).splitlines()
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err.strerror or err}', hint=_HINT) from err
    except UnicodeDecodeError:
        raise _no_transcript(path) from None


def _no_transcript(path: Path, where: str = '') -> ConfigError:
    """Return an error that quotes nothing: a request can name any file."""
    return ConfigError(f'{path} is no transcript of recorded replies{where}', hint=_HINT)


def replayed(call: ModelCall) -> ModelReply | ModelFailure:
    """Return what a recorded call gave; nobody has to be left alone when it is replayed."""
    if call.failure is not None:
        return ModelFailure(kind=call.failure.kind, message=call.failure.message)
    return ModelReply(
        text=call.reply or '',
        tokens_in=call.tokens_in,
        tokens_out=call.tokens_out,
        cost_usd=call.cost_usd,
    )
