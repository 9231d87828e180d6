# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ask models in order until one reads the prompt in a way that the prompt supports."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.extract import MAX_REPLY_CHARACTERS
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.llm.request import first_request, with_feedback
from aurora_core.parsing.text import check_prompt_text
from aurora_core.ports.language_model import (
    FailureKind,
    LanguageModel,
    ModelCall,
    ModelFailure,
    ModelReply,
    ModelRequest,
)
from aurora_core.retrieval.background import Background

# Asking the same model again changes nothing.
_FINAL = (FailureKind.REFUSED, FailureKind.NOT_RECORDED)


def parse_with_models(
    prompt: str,
    context: ParseContext,
    models: Sequence[LanguageModel],
    *,
    attempts: int,
    wait: Callable[[float], None],
    background: Background | None = None,
    short: Collection[str] = (),
) -> ParseOutcome:
    """Read a prompt with language models.

    A reply that fails a check goes back with what is wrong, a call that fails is made again; when
    the attempts of a model are spent, the next one begins anew.

    Args:
        prompt: The request.
        context: Map name and landmarks.
        models: In the order in which they are asked.
        attempts: Most calls to one model.
        wait: Called with the seconds that a server asks to be left alone.
        background: What the models are shown beside the prompt; its scores go into the outcome.
        short: Names of the models that are asked in the short form.

    Returns:
        The first outcome that passes every check, else a question that says why there is none;
        `model_calls` holds every call either way.

    Raises:
        PromptError: The text cannot be a prompt.
    """
    check_prompt_text(prompt)
    facts = PromptFacts(prompt, context)
    calls: list[ModelCall] = []
    for model in models:
        request = first_request(facts, background, short=model.name in short)
        for attempt in range(1, attempts + 1):
            answer = _limited(model.complete(request))
            if isinstance(answer, ModelFailure):
                calls.append(_failed(model.name, attempt, request, answer))
                if answer.kind in _FINAL:
                    break
                if answer.retry_after_s and attempt < attempts:
                    wait(answer.retry_after_s)
                continue
            judgement = judge(answer.text, facts)
            calls.append(_answered(model.name, attempt, request, answer, judgement.complaints))
            if judgement.outcome is not None:
                return _with_calls(judgement.outcome, calls, background)
            request = with_feedback(request, answer.text, judgement.complaints)
    return _with_calls(ParseOutcome(question=_why_not(calls)), calls, background)


def _limited(answer: ModelReply | ModelFailure) -> ModelReply | ModelFailure:
    """Return an answer, or the failure that one without measure is: nobody reads or keeps it."""
    if isinstance(answer, ModelFailure) or len(answer.text) <= MAX_REPLY_CHARACTERS:
        return answer
    return ModelFailure(
        kind=FailureKind.TRUNCATED,
        message=f'the answer has more than {MAX_REPLY_CHARACTERS} characters',
    )


def _with_calls(
    outcome: ParseOutcome, calls: Sequence[ModelCall], background: Background | None
) -> ParseOutcome:
    fields = {name: getattr(outcome, name) for name in ParseOutcome.model_fields}
    retrieval = background.retrieval if background is not None else None
    return ParseOutcome(**{**fields, 'model_calls': tuple(calls), 'retrieval': retrieval})


def _failed(model: str, attempt: int, request: ModelRequest, failure: ModelFailure) -> ModelCall:
    return ModelCall(
        model=model,
        attempt=attempt,
        request_sha256=request.sha256,
        request=request,
        failure=failure,
    )


def _answered(
    model: str, attempt: int, request: ModelRequest, reply: ModelReply, complaints: Sequence[str]
) -> ModelCall:
    return ModelCall(
        model=model,
        attempt=attempt,
        request_sha256=request.sha256,
        request=request,
        reply=reply.text,
        complaints=tuple(complaints),
        tokens_in=reply.tokens_in,
        tokens_out=reply.tokens_out,
        cost_usd=reply.cost_usd,
    )


def _why_not(calls: Sequence[ModelCall]) -> str:
    """Say what the last call of every model lacked."""
    last = {call.model: call for call in calls}
    reasons = []
    for model, call in last.items():
        if call.failure is not None:
            reason = f'{call.failure.kind.value}: {call.failure.message}'
        else:
            reason = f'the answer was not taken: {"; ".join(call.complaints[:3])}'
        reasons.append(f'{model}: {reason}')
    told = ' | '.join(reasons) or 'no model was named'
    return (
        f'No language model read this in a way that its words support ({told}). '
        'Can you say it in other words, or with --model offline?'
    )
