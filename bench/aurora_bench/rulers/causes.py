# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Why a run that had to be verified is not: from its report and what grounding said."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.rulers.trial import Cause
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.report.run_report import ConditionReport, RunReport
from aurora_core.report.status import Status
from aurora_core.spec.vocabulary import ClauseStatus

Found = tuple[Cause, tuple[str, ...]]
_SAFETY = 'safety'


def cause_of(report: RunReport, grounding: GroundingOutcome | None) -> Found:
    """Return the cause and its words.

    What is missing comes before what failed: a run without a capability often fails because of it.

    Args:
        report: Of a run that is not verified.
        grounding: None when the run did not get so far.
    """
    if report.status in (Status.ERROR, Status.CANCELLED):
        told = report.error.component if report.error is not None else report.status.value
        message = report.error.message if report.error is not None else ''
        return Cause.ERROR, (f'{told}: {_first_line(message)}' if message else told,)
    if report.status is Status.NOT_UNDERSTOOD:
        return Cause.READING, ('question',)
    if report.status is Status.INFEASIBLE:
        return Cause.GROUNDING, tuple(f'refused: {reason}' for reason in reasons(report))
    missing = tuple(dict.fromkeys(_missing(grounding)))
    if missing:
        return Cause.CAPABILITY, missing
    failure = grounding.failure if grounding is not None else None
    if failure is not None:
        return Cause.GROUNDING, (failure.reason,)
    if report.trace is not None and report.trace.cross_check:
        kinds = dict.fromkeys(f'disagreement: {f.kind}' for f in report.trace.cross_check)
        return Cause.ERROR, tuple(kinds)
    failed = tuple(dict.fromkeys(_what(row) for row in report.conditions if not row.satisfied))
    if failed:
        return Cause.CONDITION, failed
    return _unread(report)


def _unread(report: RunReport) -> Found:
    """All that was judged holds: what is left of the prompt?"""
    if any(clause.status is ClauseStatus.NOT_ENCODED for clause in report.clauses):
        return Cause.READING, ('clause not encoded',)
    if not all(row.exercised for row in report.conditions):
        return Cause.CONDITION, ('premise never',)
    return Cause.ERROR, (f'{report.status.value} without a cause',)


def reasons(report: RunReport) -> tuple[str, ...]:
    """Return for what reasons a run was refused; () when it was not."""
    if report.status is not Status.INFEASIBLE or report.feasibility is None:
        return ()
    return tuple(dict.fromkeys(c.reason for c in report.feasibility.certificates))


def _missing(grounding: GroundingOutcome | None) -> Iterator[str]:
    """Yield what cannot be run or judged, without the names that the prompt's bodies have."""
    if grounding is None:
        return
    for text in grounding.unsupported:
        element, separator, what = text.partition(': ')
        yield what if separator else element
    lost = {text.partition(': ')[0] for text in grounding.unsupported}
    for one in grounding.unjudged:
        if one.element not in lost:
            yield f'not judged: {one.what.partition(" = ")[0]}'


def _what(row: ConditionReport) -> str:
    """Return what a condition asks, e.g. `tracked` of `m1.tracked`."""
    element, _, what = row.id.partition('.')
    if element == _SAFETY:
        return f'{_SAFETY} {what.partition(".")[0]}'
    if not row.implied:
        return 'stated condition'
    return what.rstrip('0123456789') or element


def _first_line(text: str) -> str:
    return text.strip().split('\n', 1)[0]
