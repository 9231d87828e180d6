# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read the prompt of a request with the model that it names: what every engine calls."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.pipeline.functions import parse_stage
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.language_model import LanguageModel
from aurora_core.ports.model_name import OFFLINE

if TYPE_CHECKING:
    from aurora_llm.settings import ModelSettings

# Models and what they are shown are imported when one is named: most prompts are read without.


def read_prompt(
    known: Knowledge,
    request: RunRequest,
    settings: ModelSettings | None = None,
    wrap: Callable[[LanguageModel], LanguageModel] = lambda model: model,
) -> ParseOutcome:
    """Read a prompt: with the offline parser, or with language models in order.

    The offline parser takes over from models only where the order names it.

    Args:
        known: Maps and limits that the prompt is read against and completed by.
        request: Prompt, map, models, history, transcripts.
        settings: None: those of `config/models.yaml`.
        wrap: Put around every model before it is asked.

    Raises:
        PromptError: The text cannot be a prompt.
        ConfigError: The models cannot be used as they are named.
    """
    if request.model == OFFLINE:
        return parse_stage(known, request.prompt, request.map_name, request.seed)
    from aurora_llm.model_parse import read_with_models

    return read_with_models(known, request, settings, wrap)


def check_model_name(model: str) -> None:
    """Check what can be checked without a call.

    Raises:
        ConfigError: The models cannot be used as they are named.
    """
    if model != OFFLINE:
        from aurora_llm.model_parse import check_models

        check_models(model)
