# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from types import SimpleNamespace

from aurora_core.report.clauses import clause_reports
from aurora_core.report.judged import condition_reports
from aurora_core.spec.parameter import Span


def test_spans_are_quoted_from_the_prompt_in_their_order(make: SimpleNamespace) -> None:
    spans = (Span(start=29, end=41), Span(start=0, end=7))
    verdict = make.verdict(make.result(source_spans=spans))
    rows = condition_reports(make.prompt, clause_reports(make.facts()), verdict)
    assert rows[0].source == ('A drone', 'at 40 meters')


def test_a_condition_of_every_run_quotes_nothing(make: SimpleNamespace) -> None:
    verdict = make.verdict(make.result('safety.collision', spec_ids=()))
    assert condition_reports(make.prompt, clause_reports(make.facts()), verdict)[0].source == ()


def test_every_number_of_the_monitor_is_kept(make: SimpleNamespace) -> None:
    result = make.result(margin=0.1 + 0.2, worst_time_s=1.0 / 3.0)
    row = condition_reports(make.prompt, (), make.verdict(result))[0]
    assert (row.margin, row.worst_time_s) == (0.1 + 0.2, 1.0 / 3.0)
    assert (row.explanation, row.worst_place_m) == (result.explanation, result.worst_place_m)
