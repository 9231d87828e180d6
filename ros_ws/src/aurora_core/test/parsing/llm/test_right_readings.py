# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Right readings are taken at the first answer, with nothing forced out of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from yaml_rows import rows_of

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.llm.check import judge
from aurora_core.parsing.llm.facts import PromptFacts
from aurora_core.spec.scenario import ScenarioSpec

_ROWS = rows_of(Path(__file__).with_name('right_readings.yaml'))
CONTEXT = ParseContext(landmark_names=('City Hall', 'Meadow Park', 'Harbor Market'))


def _taken(row: dict[str, Any]) -> ScenarioSpec:
    judgement = judge(json.dumps(row['answer']), PromptFacts(row['prompt'], CONTEXT))
    assert judgement.complaints == ()
    assert judgement.outcome is not None
    assert judgement.outcome.spec is not None, judgement.outcome
    return judgement.outcome.spec


@pytest.mark.parametrize('row', _ROWS, ids=lambda row: row['about'])
def test_right_reading_is_taken(row: dict[str, Any]) -> None:
    spec = _taken(row)
    told = [(c['quote'], c['status']) for c in row['answer']['clauses']]
    assert [(' '.join(c.text.split()), c.status.value) for c in spec.clauses] == told
    for kind in ('agents', 'uavs', 'events', 'orders', 'conditions'):
        assert len(getattr(spec, kind)) == len(row['answer'].get(kind, ()))
    assert len(spec.prohibitions) == len(row['answer'].get('forbidden', ()))
