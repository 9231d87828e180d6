# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A grounded scene, and verdicts in which chosen conditions fail."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.verdict import ConditionResult, Reason, Verdict, VerdictStatus
from aurora_core.pipeline.functions import ground_stage, parse_stage
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.trace.trace import Integrity

_KNOWN = installed_knowledge()
PROMPT = (
    'A van tailgates the ego car closely, closing from 45 meters; a tracking drone alerts the ego '
    'when the van comes within 20 meters.'
)
Failing = Callable[..., Verdict]


@pytest.fixture(scope='module')
def agsg() -> Agsg:
    parsed = parse_stage(_KNOWN, PROMPT, 'downtown', 1).agsg
    assert parsed is not None
    grounded = ground_stage(_KNOWN, parsed, 1).agsg
    assert grounded is not None
    return grounded


@pytest.fixture
def failing(agsg: Agsg) -> Failing:
    """Return a verdict in which conditions have margins below 0, or none (None)."""

    def verdict(**margins: float | None) -> Verdict:
        told = {name.replace('__', '.'): value for name, value in margins.items()}
        rows = []
        for condition in agsg.conditions:
            margin = told.pop(condition.id, 1.0)
            rows.append(
                ConditionResult(
                    id=condition.id,
                    sentence=condition.sentence,
                    explanation='',
                    formula=condition.formula,
                    spec_ids=condition.spec_ids,
                    op=condition.op,
                    threshold=condition.threshold,
                    margin=margin,
                    reason=Reason.PREMISE_NEVER if margin is None else None,
                    unit=condition.unit,
                    normalised=margin,
                    satisfied=margin is not None and margin >= 0.0,
                    exercised=margin is not None,
                    worst_time_s=12.0,
                    provenance=condition.provenance,
                )
            )
        assert not told, f'no such conditions: {told}'
        return Verdict(
            status=VerdictStatus.VIOLATED, results=tuple(rows), integrity=Integrity.INTACT
        )

    return verdict
