# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A language model as core sees it: messages in, text or a failure out."""

from __future__ import annotations

import hashlib
import json
from enum import StrEnum
from typing import Any, Literal, Protocol

from pydantic import FiniteFloat, NonNegativeFloat, NonNegativeInt

from aurora_core.document import Document


class Message(Document):
    """One turn of the conversation."""

    role: Literal['system', 'user', 'assistant']
    content: str


class ModelRequest(Document):
    """What a model is asked.

    Attributes:
        messages: The conversation so far.
        schema_text: JSON Schema (text) that the answer is to have.
    """

    messages: tuple[Message, ...]
    schema_text: str

    @property
    def sha256(self) -> str:
        """Digest of the request, free of time, model and server: the key of a recording."""
        text = json.dumps(self.model_dump(mode='json'), sort_keys=True, ensure_ascii=False)
        return hashlib.sha256(text.encode('utf-8', 'surrogatepass')).hexdigest()

    @property
    def schema_object(self) -> dict[str, Any]:
        """The schema as JSON values."""
        loaded: dict[str, Any] = json.loads(self.schema_text)
        return loaded


class FailureKind(StrEnum):
    """Why there is no answer."""

    TIMEOUT = 'timeout'
    RATE_LIMITED = 'rate_limited'
    UNAVAILABLE = 'unavailable'  # no connection, a server error, a stream cut off
    TRUNCATED = 'truncated'  # the model stopped at its length limit
    REFUSED = 'refused'  # key, model name or request not accepted: asking again changes nothing
    NOT_RECORDED = 'not_recorded'


class ModelReply(Document):
    """An answer, not yet read by anybody.

    Attributes:
        cost_usd: None when the price of the model is not known.
    """

    text: str
    tokens_in: NonNegativeInt = 0
    tokens_out: NonNegativeInt = 0
    cost_usd: FiniteFloat | None = None


class ModelFailure(Document):
    """No answer.

    Attributes:
        message: For people; holds no key.
        retry_after_s: How long the server asks to be left alone.
    """

    kind: FailureKind
    message: str
    retry_after_s: NonNegativeFloat | None = None


class LanguageModel(Protocol):
    """One model behind one address; one call is one request, never repeated inside."""

    @property
    def name(self) -> str:
        """Name for the record."""

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        """Ask once; blocks at most as long as the adapter's own time limit."""


class ModelCall(Document):
    """One call in the record of a run (a line of `transcript.jsonl`); it holds no time.

    Attributes:
        attempt: Of this model, from 1.
        reply: Text of the answer, None with a `failure`.
        complaints: What the checks found wrong with the answer; () for the one that was taken.
    """

    model: str
    attempt: int
    request_sha256: str
    request: ModelRequest
    reply: str | None = None
    failure: ModelFailure | None = None
    complaints: tuple[str, ...] = ()
    tokens_in: int = 0
    tokens_out: int = 0
    cost_usd: FiniteFloat | None = None
