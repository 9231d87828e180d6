# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from types import SimpleNamespace

import pytest

from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.verdict import Reason
from aurora_core.report.build import build_report
from aurora_core.report.summary import margin_value


@pytest.mark.parametrize(
    ('margin', 'unit', 'reason', 'text'),
    [
        (0.0, 's', None, '+0 s'),
        (-0.0717, '1', None, '-0.0717'),
        (1452.25, 'm', None, '+1452 m'),
        (None, 'm', Reason.TRACE_SHORT, 'the record ends before'),
        (None, 'm', None, 'no margin'),
    ],
)
def test_margins_have_a_sign_and_a_unit(
    margin: float | None, unit: str, reason: Reason | None, text: str
) -> None:
    assert margin_value(margin, unit, reason) == text


def test_the_worst_three_of_many_violations_are_told(make: SimpleNamespace) -> None:
    rows = [make.result(f'c{k}', margin=-0.1 * (k + 1)) for k in range(5)]
    rows.append(make.result('gone', margin=None))
    graph = make.graph(*(make.condition(row.id) for row in rows))
    facts = make.facts(verdict=make.verdict(*rows), grounding=GroundingOutcome(agsg=graph))
    summary = build_report(facts).summary
    told = [name for name in ('gone', 'c4', 'c3', 'c2', 'c1', 'c0') if name in summary]
    assert told == ['gone', 'c4', 'c3']
    assert summary.endswith('and 3 more.')
