# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What became of every clause of the prompt, with what grounding could not realise marked."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.outcomes.grounding import Unjudged
from aurora_core.outcomes.parse import ParseOutcome
from aurora_core.report.facts import RunFacts
from aurora_core.report.run_report import ClauseReport
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import Clause
from aurora_core.spec.vocabulary import ClauseStatus


def clause_reports(facts: RunFacts) -> tuple[ClauseReport, ...]:
    """Return the clauses in the order of the prompt.

    A clause whose element cannot be executed or judged yet is `not_encoded` and names the
    capability that is missing; one that states what no condition depends on is `not_judged`. An
    element that no clause claims stands as a clause of its own, so that it cannot get lost.
    """
    missing = _missing(facts)
    reports = [_report(clause, missing) for clause in _clauses(facts.parse)]
    if facts.grounding is not None:
        for one in facts.grounding.unjudged:
            # What nobody carries out is told already.
            if one.element not in missing:
                _mark(reports, one, facts.prompt)
    claimed = {name for clause in reports for name in clause.ids}
    for element, what in missing.items():
        if element not in claimed and facts.prompt:
            reports.append(
                ClauseReport(
                    text=facts.prompt,
                    span=Span(start=0, end=len(facts.prompt)),
                    status=ClauseStatus.NOT_ENCODED,
                    ids=(element,) if element else (),
                    note=what,
                )
            )
    return tuple(reports)


def status_word(clause: ClauseReport, clauses: Sequence[ClauseReport]) -> str:
    """Return what became of a clause in words; `in part` where a piece of it was lost."""
    lost = any(
        other.status.is_open
        and clause.span.start <= other.span.start
        and other.span.end <= clause.span.end
        for other in clauses
        if other is not clause
    )
    if lost and clause.status is ClauseStatus.ENCODED:
        return 'encoded in part'
    return clause.status.value.replace('_', ' ')


def _clauses(parse: ParseOutcome | None) -> tuple[Clause, ...]:
    if parse is None:
        return ()
    if parse.spec is not None and parse.spec.clauses:
        return parse.spec.clauses
    return parse.clauses


def _missing(facts: RunFacts) -> dict[str, str]:
    """Return what is missing by element, from `id: what` texts."""
    missing: dict[str, list[str]] = {}
    for text in facts.grounding.unsupported if facts.grounding is not None else ():
        element, separator, what = text.partition(': ')
        key, words = (element, what) if separator else ('', text)
        missing.setdefault(key, []).append(words)
    return {key: '; '.join(dict.fromkeys(words)) for key, words in missing.items()}


def _report(clause: Clause, missing: dict[str, str]) -> ClauseReport:
    notes = [missing[name] for name in clause.ids if name in missing]
    if clause.note:
        notes.insert(0, clause.note)
    lost = any(name in missing for name in clause.ids)
    status = ClauseStatus.NOT_ENCODED if lost else clause.status
    if status is ClauseStatus.ENCODED and not clause.ids:
        # It became nothing that a condition could be about.
        status = ClauseStatus.NOT_JUDGED
        notes.append('nothing of the scenario stands for it')
    return ClauseReport(
        text=clause.text,
        span=clause.span,
        status=status,
        ids=clause.ids,
        note='; '.join(notes),
    )


def _mark(reports: list[ClauseReport], found: Unjudged, prompt: str) -> None:
    """Mark the clause that states what no condition depends on, else add one."""
    note = f'no condition depends on {found.what}'
    hits = [k for k, r in enumerate(reports) if found.span is not None and _meet(r.span, found)]
    hits = hits or [k for k, r in enumerate(reports) if found.element in r.ids]
    if not hits and prompt:
        whole = Span(start=0, end=len(prompt))
        reports.append(
            ClauseReport(
                text=prompt,
                span=whole,
                status=ClauseStatus.NOT_JUDGED,
                ids=(found.element,),
                note=note,
            )
        )
    for k in hits:
        report = reports[k]
        lost = report.status is ClauseStatus.NOT_ENCODED
        values = {name: getattr(report, name) for name in ClauseReport.model_fields}
        values['status'] = report.status if lost else ClauseStatus.NOT_JUDGED
        values['note'] = '; '.join(part for part in (report.note, note) if part)
        reports[k] = ClauseReport(**values)


def _meet(span: Span, found: Unjudged) -> bool:
    stated = found.span
    return stated is not None and span.start < stated.end and stated.start < span.end
