# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The report in a terminal: a table where there is one, plain lines where there is none."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import Console
from rich.markup import escape as escape_markup
from rich.table import Table

from aurora_core.errors import AuroraError
from aurora_core.report.check_report import CheckReport, CheckResult
from aurora_core.report.clauses import status_word
from aurora_core.report.mends import could_be
from aurora_core.report.run_report import (
    ClauseReport,
    ConditionReport,
    RealisedReport,
    RelaxedReport,
    RepairReport,
    RunReport,
)
from aurora_core.report.said_back import ElementReport
from aurora_core.report.status import Status
from aurora_core.report.summary import margin_value
from aurora_core.report.verify_report import VerifyOutcome, VerifyReport
from aurora_core.report.visible import one_line
from aurora_core.report.why import happened_instead, suspects
from aurora_core.report.wordings import wordings
from aurora_core.temporal.words import named
from aurora_core.trace.air_clock import paced_lines

_COLOURS = {
    Status.VERIFIED: 'green',
    Status.VERIFIED_AS_EDITED: 'green',
    Status.INCOMPLETE: 'yellow',
    Status.VIOLATED: 'red',
    Status.INCONCLUSIVE: 'yellow',
    Status.INFEASIBLE: 'magenta',
    Status.NOT_UNDERSTOOD: 'cyan',
    Status.ERROR: 'red',
    Status.CANCELLED: 'cyan',
}
_CHECK_COLOURS = {
    CheckResult.FEASIBLE: 'green',
    CheckResult.UNKNOWN: 'yellow',
    CheckResult.INCOMPLETE: 'yellow',
    CheckResult.INFEASIBLE: 'magenta',
    CheckResult.NOT_UNDERSTOOD: 'cyan',
    CheckResult.ERROR: 'red',
}

_VERIFY_COLOURS = {
    VerifyOutcome.VERIFIED: 'green',
    VerifyOutcome.MARGINS_HOLD: 'yellow',
    VerifyOutcome.VIOLATED: 'red',
    VerifyOutcome.INCONCLUSIVE: 'yellow',
    VerifyOutcome.HOLDS_AS_RECORDED: 'yellow',
    VerifyOutcome.VIOLATED_AS_RECORDED: 'red',
}

# What to do after a run that ended so.
_NEXT = {
    Status.VERIFIED: 'aurora open {run}',
    Status.VERIFIED_AS_EDITED: 'aurora open {run}',
    Status.VIOLATED: 'aurora open {run} shows when and where, aurora repair {run} tries otherwise',
    Status.INCOMPLETE: 'say the quoted words otherwise; aurora examples shows what is understood',
    Status.INCONCLUSIVE: 'aurora doctor, and aurora verify {run} once more',
    Status.INFEASIBLE: 'ask for what is feasible; the proof: aurora certificate check {run}',
    Status.NOT_UNDERSTOOD: 'aurora examples shows what can be said, aurora new asks for pieces',
    Status.ERROR: 'aurora doctor',
}
# As in docs/glossary.md.
_WORDS = {
    'capture': 'the first moment at which a UAV has reached its altitude and its point or target',
}

Row = tuple[str, ...]


def print_report(
    report: RunReport, console: Console, folder: Path | None = None, *, brief: bool = False
) -> None:
    """Print a run's report: the verdict first, and last again where it has scrolled away.

    Of a violated run what happened instead, and what may be the reason, follow the verdict.

    Args:
        report: What to print.
        console: Where; colours and boxes only when it is a terminal.
        folder: Run folder, when there is one.
        brief: The verdict, why, what to do and the folder alone.
    """
    headline(console, report.status.value, _COLOURS[report.status], report.summary)
    _question_and_error(report, console)
    if not brief:
        _print_all(report, console)
    if folder is not None:
        line(console, f'folder   {folder}')
    if report.conditions and not brief:
        headline(console, report.status.value, _COLOURS[report.status], report.summary)
    for text in happened_instead(report):
        line(console, f'why      {text}')
    for text in suspects(report):
        line(console, f'suspect  {text}')
    step = _NEXT.get(report.status)
    if step and folder is not None:
        line(console, f'next     {step.format(run=shlex.quote(str(folder)))}')


def _print_all(report: RunReport, console: Console) -> None:
    print_clauses(report.clauses, console)
    print_elements(report.elements, console)
    asked = [row for row in report.conditions if row.source]
    always = [row for row in report.conditions if not row.source]
    print_conditions('Conditions of the prompt', asked, console)
    print_conditions('Conditions of every run', always, console)
    print_realised(report.requested_and_realised, console)
    print_words((row.sentence for row in report.conditions), console)
    print_repairs(report.repairs, console)
    print_relaxed(report.relaxed, console)
    for fault in report.faults:
        line(console, f'injected fault: {fault.kind} on {fault.subject} from {fault.at_s:g} s')
    if report.trace is not None:
        trace = report.trace
        line(console, f'trace    {trace.sha256} ({trace.ticks} ticks, {trace.integrity.value})')
        if trace.motion_sha256:
            line(console, f'motion   {trace.motion_sha256}')
        for text in paced_lines(trace.clocks):
            line(console, f'paced    {text}')
        for finding in trace.cross_check:
            line(console, f'disagreement at {finding.time_s:.2f} s: {finding.text}')


def print_repairs(repairs: Sequence[RepairReport], console: Console) -> None:
    """Print every attempt of repair: what was tried, why, and what came of it."""
    print_table(
        'Repair',
        ('run', 'step', 'came of it', 'realised otherwise', 'why'),
        [
            (
                repair.bag or '-',
                repair.kind.replace('_', ' ') or '-',
                repair.outcome.replace('_', ' '),
                '; '.join(f'{e.path} {_told(e.old)} to {_told(e.new)}' for e in repair.edits),
                repair.reason,
            )
            for repair in repairs
        ],
        console,
    )


def print_relaxed(relaxed: RelaxedReport | None, console: Console) -> None:
    """Print with which stated numbers the run would hold: another request than was asked."""
    if relaxed is None:
        return
    print_table(
        f'Of another request the same run would be {relaxed.verdict.value.upper()}',
        ('number', 'stated', 'would hold with', 'condition'),
        [
            (c.path, f'{c.stated:g} {c.unit}', f'{c.relaxed:g} {c.unit}', c.sentence)
            for c in relaxed.changes
        ],
        console,
    )


def _told(value: float | str | None) -> str:
    return f'{value:g}' if isinstance(value, float) else str(value)


def print_check(report: CheckReport, console: Console, *, brief: bool = False) -> None:
    """Print the outcome of a check; `brief`: the outcome and what to do alone."""
    headline(console, report.result.value, _CHECK_COLOURS[report.result], report.summary)
    _question_and_error(report, console)
    if brief:
        return
    print_clauses(report.clauses, console)
    print_elements(report.elements, console)
    print_table(
        'A run would be judged by',
        ('condition', 'formula'),
        [(c.sentence, _rounded(c.formula)) for c in report.conditions],
        console,
    )
    print_realised(report.requested_and_realised, console)
    print_words((c.sentence for c in report.conditions), console)
    print_table(
        'When it can be',
        ('what', 'earliest', 'latest'),
        [
            (named(time.point), f'{time.earliest_s:.1f} s', f'{time.latest_s:.1f} s')
            for time in report.times
        ],
        console,
        right=(1, 2),
    )
    if report.conflict:
        line(console, f'times    exclude each other where it was placed: {report.conflict}')
    if report.horizon_s is not None:
        line(console, f'horizon  {report.horizon_s:g} s of simulated time')


def _rounded(formula: str) -> str:
    """Return a formula with numbers as people read them; documents keep every digit."""
    return re.sub(r'\d+\.\d{6,}', lambda found: f'{float(found[0]):.6g}', formula)


def _safe(text: str) -> str:
    """Return text from outside as the terminal may have it."""
    return escape_markup(one_line(text))


def headline(console: Console, word: str, colour: str, text: str) -> None:
    """Print the verdict in one line, the reason after it."""
    console.print(
        f'[bold {colour}]{_safe(word.replace("_", " ").upper())}[/]  {_safe(text)}',
        highlight=False,
        soft_wrap=not console.is_terminal,
    )


def line(console: Console, text: str) -> None:
    """Print a line of plain text that is never wrapped or coloured."""
    console.print(_safe(text), highlight=False, soft_wrap=True)


def print_conditions(title: str, rows: Sequence[ConditionReport], console: Console) -> None:
    """Print conditions with margin, unit, satisfied, time."""
    held = sum(row.satisfied for row in rows)
    print_table(
        f'{title} ({held} of {len(rows)} hold)',
        ('', 'condition', 'margin', 'at'),
        [
            (
                'yes' if row.satisfied else 'NO',
                row.sentence,
                margin_value(row.margin, row.unit, row.reason),
                '' if row.worst_time_s is None else f'{row.worst_time_s:.2f} s',
            )
            for row in rows
        ],
        console,
        right=(2, 3),
        bad=[k for k, row in enumerate(rows) if not row.satisfied],
    )


def print_clauses(clauses: Sequence[ClauseReport], console: Console) -> None:
    """Print what became of every clause."""
    print_table(
        'Clauses',
        ('', 'clause', 'became'),
        [
            (
                status_word(clause, clauses),
                clause.text,
                ', '.join(clause.ids) + (f' ({clause.note})' if clause.note else ''),
            )
            for clause in clauses
        ],
        console,
        bad=[k for k, c in enumerate(clauses) if c.status.is_open],
    )
    for one in wordings(clauses):
        line(console, f'to "{one.text}": {one.so}' + (f'; like: {one.say}' if one.say else ''))


def print_elements(elements: Sequence[ElementReport], console: Console) -> None:
    """Print the request said back."""
    print_table(
        'Understood as',
        ('', 'what', 'assumed'),
        [(one.id, one.text, f'assumed: {one.assumed}' if one.assumed else '') for one in elements],
        console,
    )


def print_words(sentences: Iterable[str], console: Console) -> None:
    """Explain the words of conditions that only AURORA uses, where they were printed."""
    text = ' '.join(sentences)
    for word, meaning in _WORDS.items():
        if word in text:
            line(console, f'{word:8} {meaning}')


def print_realised(values: Iterable[RealisedReport], console: Console) -> None:
    """Print requested and realised numbers."""
    print_table(
        'Requested and realised',
        ('value', 'requested', 'realised', 'from'),
        [
            (
                value.path,
                _with_unit(value.requested, value.unit),
                _with_unit(value.realised, value.unit),
                value.provenance.value,
            )
            for value in values
        ],
        console,
        right=(1, 2),
    )


def print_table(
    title: str,
    columns: Row,
    rows: Sequence[Row],
    console: Console,
    *,
    right: tuple[int, ...] = (),
    bad: Iterable[int] = (),
) -> None:
    """Print a table, nothing when it has no rows.

    Args:
        title: Above it.
        columns: Heads.
        rows: Texts, printed as they are.
        console: Where.
        right: Columns that are aligned to the right.
        bad: Rows that are shown in red.
    """
    if not rows:
        return
    if not console.is_terminal:
        _plain(title, columns, rows, console)
        return
    table = Table(title=_safe(title), title_justify='left', title_style='bold', expand=False)
    for index, name in enumerate(columns):
        table.add_column(name, justify='right' if index in right else 'left')
    marked = set(bad)
    for index, row in enumerate(rows):
        table.add_row(*(_safe(cell) for cell in row), style='red' if index in marked else None)
    console.print(table, highlight=False)


def _plain(title: str, columns: Row, rows: Sequence[Row], console: Console) -> None:
    rows = [tuple(one_line(cell) for cell in row) for row in rows]
    widths = [max(len(row[k]) for row in (columns, *rows)) for k in range(len(columns))]
    line(console, f'{title}:')
    for row in rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        line(console, f'  {"  ".join(cells)}'.rstrip())


def _with_unit(value: float, unit: str) -> str:
    return f'{value:.6g}' + ('' if unit in ('', '1') else f' {unit}')


def _question_and_error(report: RunReport | CheckReport, console: Console) -> None:
    if report.question and report.question != report.summary:
        line(console, f'question: {report.question}')
    if report.error is not None and report.error.hint:
        line(console, f'what to do: {report.error.hint}')
    if report.feasibility is not None:
        for proof in report.feasibility.certificates:
            said = proof.span
            if len(proof.clauses) > 1:
                line(console, 'these clauses exclude each other:')
                for clause in proof.clauses:
                    line(console, f'  "{clause}"')
            elif said is not None:
                line(console, f'the prompt says: "{report.prompt[said.start : said.end]}"')
            for k, mend in enumerate(proof.mends):
                words = could_be(mend, report.prompt)
                line(console, f'{"or" if k else "it could be:"} {words}')
        for note in report.feasibility.notes:
            line(console, f'note: {note}')
        for finding in report.feasibility.findings:
            line(console, f'to mend {finding.field}: {finding.mend}')


def print_unjudged(bag: Path, err: AuroraError, console: Console) -> None:
    """Print that a bag holds nothing that could be judged, and why."""
    outcome = VerifyOutcome.INCONCLUSIVE
    text = f'{bag} cannot be judged: {err.message}'
    headline(console, outcome.heading, _VERIFY_COLOURS[outcome], text)


def print_verify(report: VerifyReport, console: Console) -> None:
    """Print recomputed margins and whether they are the recorded ones."""
    verdict = report.verdict
    headline(console, report.outcome.heading, _VERIFY_COLOURS[report.outcome], report.summary)
    print_table(
        'Margins',
        ('', 'condition', 'margin', 'at'),
        [
            (
                'yes' if result.satisfied else 'NO',
                result.sentence,
                margin_value(result.margin, result.unit, result.reason),
                '' if result.worst_time_s is None else f'{result.worst_time_s:.2f} s',
            )
            for result in verdict.results
        ],
        console,
        right=(2, 3),
        bad=[k for k, result in enumerate(verdict.results) if not result.satisfied],
    )
    for note in verdict.notes:
        line(console, f'note     {note}')
    for text in paced_lines(verdict.clocks):
        line(console, f'paced    {text}')
    for finding in verdict.cross_check:
        line(console, f'disagreement at {finding.time_s:.2f} s: {finding.text}')
    for clause in report.unread:
        why = f' ({clause.note})' if clause.note else ''
        line(console, f'{clause.status.value.replace("_", " "):12} “{clause.text}”{why}')
    line(console, f'prompt   {report.prompt}')
    line(console, f'trace    {report.trace_sha256}')
    line(console, f'motion   {report.motion_sha256}')
    recorded = report.recorded
    if recorded is None:
        alone = 'the bag was verified by itself' if report.run is None else 'there is none to read'
        line(console, f'record   none: {alone}')
    elif recorded.equal:
        line(console, f'record   {recorded.file}: every margin is the same to the last bit')
    else:
        line(console, f'record   {recorded.file} DIFFERS from the recomputation')
        for item in recorded.differences:
            line(
                console,
                f'  {item.condition}: {item.what} '
                f'(recorded {item.recorded!r}, recomputed {item.recomputed!r})',
            )
