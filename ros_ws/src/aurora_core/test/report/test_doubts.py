# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What speaks against a bag leaves its margins and takes its verdict."""

from __future__ import annotations

from types import SimpleNamespace

from aurora_core.outcomes.verdict import VerdictStatus
from aurora_core.report.doubts import altered, doubted, trace_doubts, unknown
from aurora_core.trace.trace import Integrity


def test_a_trace_that_was_rewritten_as_a_whole_is_altered(make: SimpleNamespace) -> None:
    verdict = make.verdict()
    assert trace_doubts(verdict, 'ab' * 32, 'ab' * 32, 'report.json') == ()
    doubts = trace_doubts(verdict, 'cd' * 32, 'ab' * 32, 'report.json')
    found = doubted(verdict, doubts)
    assert (found.status, found.integrity) == (VerdictStatus.INCONCLUSIVE, Integrity.ALTERED)
    assert 'abababababab' in found.notes[-1]
    assert found.results == verdict.results


def test_a_bag_that_is_damaged_already_keeps_its_name(make: SimpleNamespace) -> None:
    cut = make.verdict(status=VerdictStatus.INCONCLUSIVE, integrity=Integrity.TRUNCATED)
    assert trace_doubts(cut, 'cd' * 32, 'ab' * 32, 'report.json') == ()
    assert doubted(cut, (unknown('no report'),)).integrity is Integrity.TRUNCATED
    assert doubted(cut, (altered('another prompt'),)).integrity is Integrity.ALTERED


def test_without_a_doubt_nothing_is_changed(make: SimpleNamespace) -> None:
    verdict = make.verdict()
    assert doubted(verdict, ()) is verdict
