# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Let the language models of a request revise what repair would revise by rules."""

from __future__ import annotations

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.repair import Attempt, Proposal
from aurora_core.pipeline.functions import revision_stage
from aurora_core.pipeline.knowledge import Knowledge
from aurora_core.pipeline.stages import RunRequest
from aurora_core.ports.language_model import LanguageModel
from aurora_core.ports.model_name import OFFLINE


def revised_by_models(
    known: Knowledge,
    request: RunRequest,
    agsg: Agsg,
    past: tuple[Attempt, ...],
    proposal: Proposal,
) -> Proposal:
    """Return what models propose in the place of a revision by rules, else these; see
    `pipeline.functions.revision_stage`.

    Args:
        known: What is installed here.
        request: Names the models.
        agsg: The best realisation so far.
        past: Everything that was tried, in order.
        proposal: By rules.

    Raises:
        ConfigError: The models cannot be used as they are named.
    """
    if request.model == OFFLINE:
        return proposal
    # Who needs no model does not wait for its libraries.
    from aurora_llm.model_parse import client_of
    from aurora_llm.reply_store import ReplyStore, StoredClient
    from aurora_llm.settings import load_model_settings

    settings = load_model_settings()
    names = [name for name in settings.order(request.model) if name != OFFLINE]
    models: list[LanguageModel] = [
        # What a model would have proposed is not needed to go on: the rules stand.
        client_of(name, settings, request)
        if request.transcripts is None
        else StoredClient(name, ReplyStore(request.transcripts), must=False)
        for name in names
    ]
    return revision_stage(known, agsg, past, proposal, models, settings.attempts)
