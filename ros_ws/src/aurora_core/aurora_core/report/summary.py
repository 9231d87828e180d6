# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Why a run has its status, in one or two honest sentences."""

from __future__ import annotations

from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import AttemptOutcome
from aurora_core.outcomes.verdict import Reason
from aurora_core.report.run_report import ConditionReport, RepairReport, RunReport
from aurora_core.report.status import Status
from aurora_core.trace.trace import Integrity

_SHOWN = 3
_WHY_NONE = {
    Reason.PREMISE_NEVER: 'what it waits for never happened',
    Reason.EMPTY_PHASE: 'that phase never began',
    Reason.TARGET_GONE: 'the body was gone',
    Reason.SAMPLES_MISSING: 'samples missing',
    Reason.TRACE_SHORT: 'the record ends before',
}


def summary_of(report: RunReport, grounding: GroundingOutcome | None) -> str:
    """Return the summary of a report whose other fields are filled in."""
    metrics = report.metrics
    held = f'{metrics.satisfied} of {metrics.conditions} conditions hold'
    if report.status is Status.VERIFIED:
        return (
            f'Every condition holds at its original threshold ({held}) and every clause of the '
            f'prompt is encoded.{_repaired(report)}'
        )
    if report.status is Status.VERIFIED_AS_EDITED:
        return (
            f'As asked {held}; violated: {_violated(report.conditions)}. The same run holds with '
            f'{_changes(report)}: another request than the one that was asked.'
        )
    if report.status is Status.INCOMPLETE:
        return f'What was encoded holds ({held}), but not all was encoded: {_lost(report)}.'
    if report.status is Status.VIOLATED:
        why = f'Violated: {_violated(report.conditions)}.{_not_repaired(report)}'
        return f'{held}. {why}{_unread(report)}{_doubted(report)}'
    if report.status is Status.INCONCLUSIVE:
        return _inconclusive(report, grounding) + _unread(report)
    if report.status is Status.INFEASIBLE:
        return 'Refused before execution. ' + ' '.join(
            certificate.sentence
            for certificate in (report.feasibility.certificates if report.feasibility else ())
        )
    if report.status is Status.NOT_UNDERSTOOD:
        return report.question or 'No valid specification could be read from the prompt.'
    if report.status is Status.ERROR and report.error is not None:
        return f'{report.error.component} failed: {report.error.message}'
    return 'Cancelled by the user; nothing is claimed about the prompt.'


def _changes(report: RunReport) -> str:
    changes = report.relaxed.changes if report.relaxed is not None else ()
    return ', '.join(
        f'{c.relaxed:g} {c.unit} instead of {c.stated:g} {c.unit} ({c.condition})' for c in changes
    )


def _doubted(report: RunReport) -> str:
    """Return that a request was run although it may be impossible: that was not proven."""
    notes = report.feasibility.notes if report.feasibility is not None else ()
    if not notes:
        return ''
    return f' That it cannot be was suspected beforehand, and not proven: {notes[0]}'


def _repaired(report: RunReport) -> str:
    """Return how many realisations it took, where the first one did not hold."""
    tried = len(_tried(report))
    told = _placed(report)
    if not tried:
        return told
    return f'{told} It took {tried + 1} realisations; the request is unchanged.{_again(report)}'


def _tried(report: RunReport) -> list[RepairReport]:
    """Return the other realisations; one that only confirms an earlier one is none."""
    return [r for r in report.repairs if r.bag is not None and r.confirms is None]


def _again(report: RunReport) -> str:
    """Return what the engine of the run gave of a candidate that another one executed."""
    told = [r.reason for r in report.repairs if r.confirms is not None]
    return ''.join(f' {reason[:1].upper()}{reason[1:]}.' for reason in told)


def _placed(report: RunReport) -> str:
    """Return with which values a request was placed that has no place with the usual ones."""
    fits = next((r for r in report.repairs if r.outcome == AttemptOutcome.PLACED), None)
    if fits is None:
        return ''
    values = ', '.join(f'{edit.path} {edit.new:g}' for edit in fits.edits)
    return f' With the usual values it has no place; it was placed with {values}.'


def _not_repaired(report: RunReport) -> str:
    """Return what repair tried in vain, and why it ended."""
    made = [r for r in report.repairs if r.iteration > 0 and r.confirms is None]
    told = _placed(report)
    if not made:
        return told
    tried = len(_tried(report))
    last = made[-1]
    why = f': {last.reason}' if last.bag is None else ''
    if not tried:
        return f'{told} Repair had nothing to try{why}.'
    always = f' (in none of them: {", ".join(ids)})' if (ids := _never(report)) else ''
    plural = 's' * (tried > 1)
    held = f'{told} {tried} other realisation{plural} did not hold either{always}{why}.'
    return held + _again(report)


def _never(report: RunReport) -> list[str]:
    """Return the conditions that held in no realisation: no place or value that was tried helps.

    What follows from something that never happened is left out where something has a margin.
    """
    made = _tried(report)
    margins = [{row.condition: row.realised for row in repair.margins} for repair in made]
    failed = [row for row in report.conditions if not row.satisfied]
    failed = [row for row in failed if row.margin is not None] or failed
    never = [
        row.id
        for row in failed
        if all((margin := found.get(row.id)) is None or margin < 0.0 for found in margins)
    ]
    return never[:_SHOWN]


def _lost(report: RunReport) -> str:
    lost = [c for c in report.clauses if c.status.is_open]
    if not lost:
        return 'the prompt was not divided into clauses'
    return '; '.join(f'“{c.text}”' + (f' ({c.note})' if c.note else '') for c in lost)


def _unread(report: RunReport) -> str:
    """Return what no run of this request could have shown, so that no headline hides it."""
    lost = any(c.status.is_open for c in report.clauses)
    return f' Not read or not judged: {_lost(report)}.' if lost else ''


def worst_first(rows: tuple[ConditionReport, ...]) -> list[ConditionReport]:
    """Return the conditions that do not hold, those without a margin before all others."""
    failed = [row for row in rows if not row.satisfied]
    failed.sort(key=lambda row: (row.normalised is not None, row.normalised or 0.0, row.id))
    return failed


def _violated(rows: tuple[ConditionReport, ...]) -> str:
    failed = worst_first(rows)
    texts = [f'{row.sentence.rstrip(".")} ({margin_text(row)})' for row in failed[:_SHOWN]]
    rest = len(failed) - _SHOWN
    return '; '.join(texts) + (f'; and {rest} more' if rest > 0 else '')


def margin_text(row: ConditionReport) -> str:
    """Return the margin with its unit and time, or why there is none."""
    value = margin_value(row.margin, row.unit, row.reason)
    if row.margin is None:
        return value
    when = '' if row.worst_time_s is None else f' at {row.worst_time_s:.2f} s'
    return f'margin {value}{when}'


def margin_value(margin: float | None, unit: str, reason: Reason | None) -> str:
    """Return a margin with sign and unit, or why there is none."""
    if margin is None:
        return _WHY_NONE[reason] if reason is not None else 'no margin'
    return f'{margin:+.4g}' + ('' if unit in ('', '1') else f' {unit}')


def _inconclusive(report: RunReport, grounding: GroundingOutcome | None) -> str:
    failure = grounding.failure if grounding is not None else None
    if failure is not None:
        return (
            f'Nothing was executed: no place on the map was found for the scenario '
            f'({failure.told}). That none exists is not proven.'
        )
    if report.trace is not None and report.trace.integrity is not Integrity.INTACT:
        notes = '; '.join(report.trace.notes).rstrip('.')
        return f'The recording is {report.trace.integrity.value}: {notes or "see the bag"}.'
    if report.trace is not None and report.trace.cross_check:
        found = report.trace.cross_check[0]
        return f'Record and recomputation disagree at {found.time_s:.2f} s: {found.text}'
    if not report.conditions:
        return 'There is no verdict over the conditions, so nothing is claimed.'
    poor = [row.id for row in report.conditions if row.reason is not None and row.reason.undecided]
    return f'The trace lacks what is needed to decide: {", ".join(poor)}.'
