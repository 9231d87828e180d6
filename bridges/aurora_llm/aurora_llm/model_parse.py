# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read the prompt of a request with language models, and the offline parser behind them."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.parsing.llm.dialogue import parse_with_models
from aurora_core.pipeline.background import background
from aurora_core.pipeline.functions import parse_context, parse_stage, understood
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.language_model import LanguageModel
from aurora_core.ports.model_name import OFFLINE, RECORDED
from aurora_core.retrieval.background import Background
from aurora_llm.embedding import rankers
from aurora_llm.litellm_client import LitellmClient
from aurora_llm.recorded_client import RecordedClient
from aurora_llm.reply_store import ReplyStore, StoredClient
from aurora_llm.settings import ModelSettings, load_model_settings


def read_with_models(
    known: Knowledge,
    request: RunRequest,
    settings: ModelSettings | None,
    wrap: Callable[[LanguageModel], LanguageModel],
) -> ParseOutcome:
    """Read a prompt with language models in order; see `aurora_llm.parse.read_prompt`.

    Raises:
        PromptError: The text cannot be a prompt.
        ConfigError: The models cannot be used as they are named.
    """
    models = settings if settings is not None else load_model_settings()
    order = models.order(request.model)
    outcome = parse_with_models(
        request.prompt,
        parse_context(known, request.map_name, request.seed),
        [wrap(client_of(name, models, request)) for name in order if name != OFFLINE],
        attempts=models.attempts,
        wait=lambda seconds: time.sleep(min(seconds, models.most_wait_s)),
        background=background_of(known, request, models),
        short=[name for name, entry in models.models.items() if entry.short],
    )
    if order[-1] != OFFLINE or not _is_spent(outcome):
        return understood(known, outcome)
    offline = parse_stage(known, request.prompt, request.map_name, request.seed)
    fields = {name: getattr(offline, name) for name in ParseOutcome.model_fields}
    return ParseOutcome(
        **{**fields, 'retrieval': outcome.retrieval, 'model_calls': outcome.model_calls}
    )


def check_models(model: str) -> None:
    """Check names of models without a call.

    Raises:
        ConfigError: The models cannot be used as they are named.
    """
    settings = load_model_settings()
    for name in settings.order(model):
        if name != OFFLINE:
            client_of(name, settings)


def _is_spent(outcome: ParseOutcome) -> bool:
    """Return whether no answer was taken: a question of a model's own is an answer."""
    last = outcome.model_calls[-1] if outcome.model_calls else None
    return last is None or last.failure is not None or bool(last.complaints)


def background_of(known: Knowledge, request: RunRequest, settings: ModelSettings) -> Background:
    """Return what a model is shown with the prompt of a request.

    Raises:
        ConfigError: The history cannot be read.
    """
    wanted = settings.retrieval
    return background(known, request, rankers(embedding=wanted.embedding), wanted)


def client_of(
    name: str, settings: ModelSettings, request: RunRequest | None = None
) -> LanguageModel:
    """Return who answers for a model of the order.

    Args:
        name: Of the order; not the offline parser.
        settings: Of all models.
        request: May name recorded replies; None: only whether the model can be used is asked.

    Raises:
        ConfigError: It cannot be used as it is named.
    """
    if name.startswith(RECORDED):
        return RecordedClient(name, Path(name.removeprefix(RECORDED)))
    if request is not None and request.transcripts is not None:
        return StoredClient(name, ReplyStore(request.transcripts))
    return LitellmClient(name, settings.entry(name), settings)
