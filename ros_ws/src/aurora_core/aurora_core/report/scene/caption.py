# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the picture says in words: prompt, verdict, what failed and where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from aurora_core.outcomes.verdict import ConditionResult, Verdict, VerdictStatus
from aurora_core.report.run_report import ConditionReport, RunReport
from aurora_core.report.status import Status
from aurora_core.report.summary import margin_value

Point3 = tuple[float, float, float]

# What the trace alone can say, in the words of a run's status.
_OF_VERDICT = {
    VerdictStatus.VERIFIED: Status.VERIFIED,
    VerdictStatus.VIOLATED: Status.VIOLATED,
    VerdictStatus.INCONCLUSIVE: Status.INCONCLUSIVE,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """A condition that does not hold.

    Attributes:
        time_s: Simulated time of the deciding sample, None when there is none.
        place_m: Where the body concerned was, ENU metres.
    """

    sentence: str
    time_s: float | None
    place_m: Point3 | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Tight:
    """A condition and how far it is from its edge.

    Attributes:
        margin: With sign and unit, as text.
    """

    sentence: str
    margin: str
    satisfied: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class Caption:
    """Words around the picture.

    Attributes:
        status: None when nothing has been judged.
        held: How many conditions hold, as text.
        tightest: All conditions by normalised margin, the least first.
    """

    prompt: str
    status: Status | None = None
    held: str = ''
    failures: tuple[Failure, ...] = ()
    tightest: tuple[Tight, ...] = ()

    @classmethod
    def of_verdict(cls, prompt: str, verdict: Verdict) -> Self:
        """Return the caption of a bag that was judged by itself."""
        return cls(
            prompt=prompt,
            status=_OF_VERDICT[verdict.status],
            held=_held(sum(r.satisfied for r in verdict.results), len(verdict.results)),
            failures=_failures(verdict.results),
            tightest=_tightest(verdict.results),
        )

    @classmethod
    def of_report(cls, report: RunReport) -> Self:
        """Return the caption of a run."""
        return cls(
            prompt=report.prompt,
            status=report.status,
            held=_held(report.metrics.satisfied, report.metrics.conditions),
            failures=_failures(report.conditions),
            tightest=_tightest(report.conditions),
        )


def _failures(rows: Sequence[ConditionResult | ConditionReport]) -> tuple[Failure, ...]:
    return tuple(
        Failure(sentence=row.sentence, time_s=row.worst_time_s, place_m=row.worst_place_m)
        for row in rows
        if not row.satisfied
    )


def _tightest(rows: Sequence[ConditionResult | ConditionReport]) -> tuple[Tight, ...]:
    ordered = sorted(
        rows,
        key=lambda row: (float('-inf') if row.normalised is None else row.normalised, row.id),
    )
    return tuple(
        Tight(
            sentence=row.sentence,
            margin=margin_value(row.margin, row.unit, row.reason),
            satisfied=row.satisfied,
        )
        for row in ordered
    )


def _held(satisfied: int, total: int) -> str:
    return f'{satisfied} of {total} conditions hold' if total else ''
