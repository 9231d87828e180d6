# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The checks let an honest model pass: over all prompts of the offline parser's table."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from honest_reader import honest_reading
from yaml_rows import rows_of

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import ScenarioSpec

HERE = Path(__file__).parent
CONTEXT = ParseContext(
    landmark_names=('central_park', 'clock_tower', 'city_hospital', 'north_plaza')
)
# Where our own reading differs, and may: the domain of an inferred value in the middle of a stated
# range, and the order of actors and links that are named in one breath.
FREE = 5


def _scenario(spec: ScenarioSpec) -> Any:
    def without_spans(value: Any) -> Any:
        if isinstance(value, dict):
            return {k: without_spans(v) for k, v in value.items() if not k.endswith('span')}
        return [without_spans(one) for one in value] if isinstance(value, list) else value

    return without_spans(spec.model_dump(mode='json', exclude={'clauses'}))


@pytest.fixture(scope='module')
def references() -> list[ScenarioSpec]:
    """The specifications that can be told in a reading: every event has a cause and an effect."""
    rows = rows_of(HERE.parent / 'prompts.yaml')
    specs = [parse_offline(row['prompt'], CONTEXT).spec for row in rows]
    return [
        spec
        for spec in specs
        if spec is not None
        and all(e.trigger is not None and e.action is not None for e in spec.events)
        # Its UAV tracks what the prompt wants footage of: inferred, and no clause cites it.
        and 'aerial footage' not in spec.prompt
    ]


def test_honest_readings_are_taken_and_give_the_reference(references: list[ScenarioSpec]) -> None:
    assert len(references) > 200
    refused: dict[str, tuple[str, ...]] = {}
    different = []
    for reference in references:
        text = json.dumps(honest_reading(reference))
        judgement = judge(text, PromptFacts(reference.prompt, CONTEXT))
        outcome = judgement.outcome
        if outcome is None or outcome.spec is None:
            refused[reference.prompt] = judgement.complaints
        elif _scenario(outcome.spec) != _scenario(reference):
            different.append(reference.prompt)
    assert refused == {}
    assert len(different) <= FREE, different
