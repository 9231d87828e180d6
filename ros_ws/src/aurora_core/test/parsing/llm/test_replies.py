# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Replies in several styles give the specification that the offline parser gives."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from yaml_rows import rows_of

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.llm.request import Example, examples
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('central_park', 'clock_tower'))
_ROWS = rows_of(Path(__file__).with_name('replies.yaml'))


def scenario(spec: ScenarioSpec) -> Any:
    """Return all of a specification but where it stands in the prompt and how that is cut."""

    def without_spans(value: Any) -> Any:
        if isinstance(value, dict):
            return {k: without_spans(v) for k, v in value.items() if not k.endswith('span')}
        return [without_spans(one) for one in value] if isinstance(value, list) else value

    return without_spans(spec.model_dump(mode='json', exclude={'clauses'}))


def number_spans(spec: ScenarioSpec) -> list[str]:
    """Return the words of every explicit number."""
    found: list[str] = []

    def collect(value: Any) -> None:
        if isinstance(value, dict):
            if value.get('provenance') == 'explicit':
                found.append(spec.prompt[value['span']['start'] : value['span']['end']])
            for inner in value.values():
                collect(inner)
        elif isinstance(value, list):
            for inner in value:
                collect(inner)

    collect(spec.model_dump(mode='json'))
    return sorted(found)


@pytest.mark.parametrize('style', ['terse', 'chatty'])
@pytest.mark.parametrize('row', _ROWS, ids=lambda row: row['prompt'][:40])
def test_same_specification_as_the_reference(row: dict[str, str], style: str) -> None:
    reference = parse_offline(row['prompt'], CONTEXT).spec
    judgement = judge(row[style], PromptFacts(row['prompt'], CONTEXT))
    assert judgement.complaints == ()
    assert judgement.outcome is not None
    spec = judgement.outcome.spec
    assert spec is not None
    assert reference is not None
    assert scenario(spec) == scenario(reference)
    assert number_spans(spec) == number_spans(reference)
    assert {c.status for c in spec.clauses} == {ClauseStatus.ENCODED}


@pytest.mark.parametrize('example', examples(), ids=lambda e: e.prompt[:30])
def test_worked_examples_are_right(example: Example) -> None:
    text = example.answer.model_dump_json(exclude_defaults=True)
    judgement = judge(text, PromptFacts(example.prompt, CONTEXT))
    reference = parse_offline(example.prompt, CONTEXT).spec
    assert judgement.complaints == ()
    assert judgement.outcome is not None
    assert judgement.outcome.spec is not None
    assert reference is not None
    assert scenario(judgement.outcome.spec) == scenario(reference)
