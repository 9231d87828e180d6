# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The monitor's verdict as rows of the report."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.report.run_report import ClauseReport, ConditionReport
from aurora_core.spec.parameter import Span
from aurora_core.trace.trace import Integrity


def condition_reports(
    prompt: str, clauses: tuple[ClauseReport, ...], verdict: Verdict
) -> tuple[ConditionReport, ...]:
    """Return one row per judged condition, in the order of the verdict.

    Args:
        prompt: As typed.
        clauses: Clauses of the prompt.
        verdict: Margins.
    """
    return tuple(_row(prompt, clauses, result) for result in verdict.results)


def is_undecided(verdict: Verdict) -> bool:
    """Tell whether the verdict is not enough to claim anything.

    The monitor says so itself; the report asks again, since a status must never claim more than
    the trace shows.
    """
    return (
        verdict.status is VerdictStatus.INCONCLUSIVE
        or verdict.integrity is not Integrity.INTACT
        or bool(verdict.cross_check)
        or any(r.reason is not None and r.reason.undecided for r in verdict.results)
    )


def _row(
    prompt: str, clauses: tuple[ClauseReport, ...], result: ConditionResult
) -> ConditionReport:
    return ConditionReport(
        id=result.id,
        sentence=result.sentence,
        formula=result.formula,
        source=_source(prompt, clauses, result),
        spec_ids=result.spec_ids,
        implied=result.implied,
        provenance=result.provenance,
        op=result.op,
        threshold=result.threshold,
        tolerance=result.tolerance,
        unit=result.unit,
        margin=result.margin,
        normalised=result.normalised,
        satisfied=result.satisfied,
        exercised=result.exercised,
        reason=result.reason,
        worst_time_s=result.worst_time_s,
        worst_place_m=result.worst_place_m,
        explanation=result.explanation,
        evidence=result.evidence,
    )


def _source(
    prompt: str, clauses: tuple[ClauseReport, ...], result: ConditionResult
) -> tuple[str, ...]:
    """Quote the prompt: the spans of the condition, else the clauses of its elements."""
    quoted = [prompt[span.start : span.end] for span in _sorted(result.source_spans)]
    if not quoted and result.spec_ids:
        wanted = set(result.spec_ids)
        quoted = [clause.text for clause in clauses if wanted & set(clause.ids)]
    return tuple(dict.fromkeys(text for text in quoted if text))


def _sorted(spans: Iterable[Span]) -> list[Span]:
    return sorted(spans, key=lambda span: (span.start, span.end))
