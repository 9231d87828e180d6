# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""60 first answers of a strong model, replayed (docs/bench/strong_model.md says how they came).

Prompts and answers were written by others, without sight of code, checks or annotations.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.parsing.llm.dialogue import parse_with_models
from aurora_core.pipeline.functions import parse_context
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.ports.language_model import ModelReply, ModelRequest
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.vocabulary import ClauseStatus

_LINES = Path(__file__).with_name('strong_replies.jsonl').read_text('utf-8').splitlines()
_ROWS: dict[str, str] = {
    row['prompt']: json.dumps(row['reply']) for row in map(json.loads, _LINES)
}
# What these lack is in the schema: a place that is named, a height, an actor that nobody named.
_RIGHT_OBJECTIONS = (
    'Could you make a pedestrian step onto a crosswalk',
    'Could we perhaps have a drone deliver something',
    'A car runs out of road space behind a stopped garbage truck',
)


class _Recorded:
    """Answers a prompt as it was answered."""

    name = 'recorded'

    def complete(self, request: ModelRequest) -> ModelReply:
        """Return the answer to the last message."""
        return ModelReply(text=_ROWS[json.loads(request.messages[-1].content)['prompt']])


@pytest.fixture(scope='module')
def read() -> dict[str, ParseOutcome]:
    """What one call for each prompt gives."""
    context = parse_context(installed_knowledge(), 'downtown', 1)
    return {
        prompt: parse_with_models(prompt, context, [_Recorded()], attempts=1, wait=lambda _: None)
        for prompt in _ROWS
    }


def test_right_first_answers_are_taken(read: dict[str, ParseOutcome]) -> None:
    objected = {p: o.model_calls[0].complaints for p, o in read.items() if o.spec is None}
    assert len(read) == 60
    assert len(objected) == len(_RIGHT_OBJECTIONS), objected
    assert all(prompt.startswith(_RIGHT_OBJECTIONS) for prompt in objected)


def test_few_words_of_right_answers_are_admitted_as_lost(read: dict[str, ParseOutcome]) -> None:
    """Of what is admitted without the model's word, most is not in the specification indeed."""
    lost = {
        prompt: [c.text for c in o.spec.clauses if 'accounts for this' in c.note]
        for prompt, o in read.items()
        if o.spec is not None
    }
    assert sum(map(bool, lost.values())) <= 15, {p: t for p, t in lost.items() if t}


def test_every_number_of_an_encoded_clause_is_where_the_prompt_states_it(
    read: dict[str, ParseOutcome],
) -> None:
    for prompt, outcome in read.items():
        spec = outcome.spec
        for mission in () if spec is None else spec.missions:
            told = mission.altitude_m
            if told.provenance is Provenance.EXPLICIT:
                assert told.span is not None
                assert any(c.isdigit() for c in prompt[told.span.start : told.span.end])


def test_a_third_is_wholly_read(read: dict[str, ParseOutcome]) -> None:
    whole = [
        prompt
        for prompt, o in read.items()
        if o.spec is not None and all(not c.status.is_open for c in o.spec.clauses)
    ]
    assert len(whole) >= 20
    open_clauses = [c for o in read.values() if o.spec is not None for c in o.spec.clauses]
    admitted = [c for c in open_clauses if c.status is ClauseStatus.NOT_ENCODED]
    assert all(c.note for c in admitted), 'each says why'
