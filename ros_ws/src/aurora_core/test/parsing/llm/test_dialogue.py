# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Attempts, feedback, fallback, and the record of it all."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from aurora_core.errors import PromptError
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.llm.dialogue import parse_with_models
from aurora_core.ports.language_model import (
    FailureKind,
    ModelFailure,
    ModelReply,
    ModelRequest,
)

PROMPT = 'A drone hovers over my car at 25 m.'
GOOD = (
    '{"agents":[{"id":"ego","type":"car","quote":"my car"}],"uavs":[{"id":"u","quote":"A drone"}],'
    '"missions":[{"id":"m","uav":"u","mode":"hover","target":"ego","altitude_m":{"value":25,'
    '"unit":"m","quote":"25 m"},"quote":"A drone hovers"}],"clauses":[{"quote":"A drone hovers '
    'over my car at 25 m","status":"encoded","ids":["m","ego"]}]}'
)
BAD = GOOD.replace('"value":25', '"value":26')


class Scripted:
    """A model that says what it is told to, the last thing again and again."""

    def __init__(self, name: str, *answers: str | ModelFailure) -> None:
        self.name = name
        self.asked: list[ModelRequest] = []
        self._answers = answers

    def complete(self, request: ModelRequest) -> ModelReply | ModelFailure:
        self.asked.append(request)
        answer = self._answers[min(len(self.asked), len(self._answers)) - 1]
        if isinstance(answer, str):
            return ModelReply(text=answer, tokens_in=10, tokens_out=2, cost_usd=0.01)
        return answer


def failure(kind: FailureKind, wait_s: float | None = None) -> ModelFailure:
    return ModelFailure(kind=kind, message='no', retry_after_s=wait_s)


def parse(models: Sequence[Scripted], waits: list[float] | None = None) -> ParseOutcome:
    kept: list[float] = [] if waits is None else waits
    return parse_with_models(
        PROMPT, ParseContext(), models, attempts=3, wait=lambda seconds: kept.append(seconds)
    )


def test_objections_go_back_with_the_answer_they_are_about() -> None:
    model = Scripted('a', 'no JSON', BAD, GOOD)
    outcome = parse([model])
    assert outcome.spec is not None
    last = model.asked[2].messages
    assert [m.role for m in last[-4:]] == ['assistant', 'user', 'assistant', 'user']
    assert last[-2].content == BAD
    assert '26 m is not what' in last[-1].content
    calls = outcome.model_calls
    assert [(c.attempt, bool(c.complaints)) for c in calls] == [(1, True), (2, True), (3, False)]
    assert [c.tokens_in for c in calls] == [10, 10, 10]


def test_attempts_of_a_model_are_bounded_and_the_next_begins_anew() -> None:
    first, second = Scripted('a', BAD), Scripted('b', GOOD)
    outcome = parse([first, second])
    assert (len(first.asked), len(second.asked)) == (3, 1)
    assert second.asked[0] == first.asked[0]
    assert outcome.spec is not None


def test_when_nobody_can_it_is_not_understood_and_says_why() -> None:
    outcome = parse([Scripted('a', BAD), Scripted('b', failure(FailureKind.TIMEOUT))])
    assert outcome.spec is None
    assert outcome.question is not None
    assert 'a: the answer was not taken: m.altitude_m: 26 m is not what' in outcome.question
    assert 'b: timeout' in outcome.question
    assert len(outcome.model_calls) == 6


def test_refusal_is_not_asked_again_and_a_limit_is_waited_for() -> None:
    refused = Scripted('a', failure(FailureKind.REFUSED))
    limited = Scripted('b', failure(FailureKind.RATE_LIMITED, 7.0), GOOD)
    waits: list[float] = []
    outcome = parse([refused, limited], waits)
    assert len(refused.asked) == 1
    assert waits == [7.0]
    assert outcome.spec is not None


def test_request_digest_has_no_model_and_no_time_in_it() -> None:
    first, second = Scripted('a', BAD), Scripted('b', BAD)
    parse([first, second])
    digests = [[r.sha256 for r in model.asked] for model in (first, second)]
    assert digests[0] == digests[1]
    assert len(set(digests[0])) == 3


def test_what_is_no_prompt_is_not_sent_anywhere() -> None:
    model = Scripted('a', GOOD)
    with pytest.raises(PromptError):
        parse_with_models(' ', ParseContext(), [model], attempts=3, wait=lambda _: None)
    assert model.asked == []
