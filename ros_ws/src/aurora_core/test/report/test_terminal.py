# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
from pathlib import Path
from types import SimpleNamespace

import pytest
from rich.console import Console

from aurora_core.execution.faults import Fault
from aurora_core.outcomes.grounding import GroundingOutcome
from aurora_core.outcomes.repair import Implicated
from aurora_core.outcomes.verdict import Finding
from aurora_core.report.build import build_report
from aurora_core.report.check_report import build_check
from aurora_core.report.comparison import compare
from aurora_core.report.run_report import RepairReport
from aurora_core.report.terminal import print_check, print_report, print_verify
from aurora_core.report.verify_report import verify_report
from aurora_core.spec.vocabulary import ClauseStatus


def _plain() -> Console:
    return Console(file=io.StringIO(), width=60)


def _terminal() -> Console:
    return Console(file=io.StringIO(), width=120, force_terminal=True, color_system='standard')


def _text(console: Console) -> str:
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def test_plain_text_has_one_row_per_line_without_boxes(make: SimpleNamespace) -> None:
    console = _plain()
    fault = Fault(kind='link_loss', subject='*', value=1.0)
    report = build_report(make.facts(faults=(fault,)))
    print_report(report, console, Path('/runs/x'))
    text = _text(console)
    assert text.startswith('VERIFIED  ')
    assert '\x1b' not in text
    assert '│' not in text
    row = next(line for line in text.splitlines() if 'uav1 keeps m1.visible' in line)
    assert row.split()[-3:] == ['+0.2', '12.50', 's']
    assert 'a' * 64 in text
    assert '/runs/x' in text
    assert 'injected fault: link_loss' in text


def test_the_verdict_stands_first_and_last_and_alone_when_asked(make: SimpleNamespace) -> None:
    report = build_report(make.facts(verdict=make.verdict(make.result(margin=-1.0))))
    console = _plain()
    print_report(report, console, Path('/runs/x'))
    first, *_, again, why, step = _text(console).splitlines()
    assert first == again
    assert why == 'why      seen in 90 % of the samples'
    assert first.startswith('VIOLATED  ')
    assert step.split()[:4] == ['next', 'aurora', 'open', '/runs/x']

    console = _plain()
    print_report(report, console, Path('/runs/x'), brief=True)
    assert [row.split()[0] for row in _text(console).splitlines()] == [
        'VIOLATED',
        'folder',
        'why',
        'next',
    ]


def test_the_last_lines_tell_what_may_be_the_reason(make: SimpleNamespace) -> None:
    """In the last ten lines, however much stands above: what repair found, or a fault."""
    found = [
        Implicated(field=f'm1/{k}', score=3.0 - k, direction=1, conditions=(), reason=f'cause {k}')
        for k in range(3)
    ]
    attempts = [
        RepairReport(iteration=1, kind='one_parameter', bag='bag.1', implicated=tuple(found)),
        RepairReport(iteration=2, kind='grounding', reason='nothing is left to try'),
    ]
    report = build_report(make.facts(verdict=make.verdict(make.result(margin=-1.0))))
    report = report.model_copy(update={'repairs': tuple(attempts)})
    console = _plain()
    print_report(report, console, Path('/runs/x'))
    last = _text(console).splitlines()[-10:]
    assert [row for row in last if row.startswith('suspect')] == [
        'suspect  cause 0 (m1/0)',
        'suspect  cause 1 (m1/1)',
    ]
    fault = Fault(kind='link_loss', subject='*', value=1.0, at_s=3.0)
    console = _plain()
    print_report(report.model_copy(update={'faults': (fault,)}), console, Path('/runs/x'))
    last = _text(console).splitlines()[-10:]
    assert [row for row in last if row.startswith('suspect')] == [
        'suspect  injected fault link_loss on * from 3 s'
    ]


def test_a_terminal_gets_a_table_and_no_color_is_heeded(
    make: SimpleNamespace, monkeypatch: pytest.MonkeyPatch
) -> None:
    report = build_report(make.facts(verdict=make.verdict(make.result(margin=-1.0))))
    coloured = _terminal()
    print_report(report, coloured)
    assert '\x1b[1;31mVIOLATED' in _text(coloured)
    monkeypatch.setenv('NO_COLOR', '1')
    grey = _terminal()
    print_report(report, grey)
    assert '\x1b[1;31m' not in _text(grey)
    assert 'VIOLATED' in _text(grey)


def test_markup_in_a_prompt_is_just_text(make: SimpleNamespace) -> None:
    console = _terminal()
    grounding = GroundingOutcome(agsg=make.graph(), unsupported=('[red]x: [/red][bold]',))
    print_report(build_report(make.facts(prompt='[red]a[/nope]', grounding=grounding)), console)
    assert '[red]a[/nope]' in _text(console)


def test_a_failed_condition_is_marked_without_colour_too(make: SimpleNamespace) -> None:
    console = _plain()
    print_report(build_report(make.facts(verdict=make.verdict(make.result(margin=-1.0)))), console)
    assert any(line.split()[:2] == ['NO', 'uav1'] for line in _text(console).splitlines())


def test_a_check_rounds_what_nobody_reads(make: SimpleNamespace) -> None:
    check = build_check(make.facts(execution=None, verdict=None))
    long = check.conditions[0].model_copy(
        update={'formula': 'always (x(uav1) >= -3.0300000000000002 m), [31.242886006438244, 2.5]'}
    )
    console = _plain()
    print_check(check.model_copy(update={'conditions': (long,)}), console)
    assert 'always (x(uav1) >= -3.03 m), [31.2429, 2.5]' in _text(console)


def test_a_check_says_how_a_run_would_be_judged(make: SimpleNamespace) -> None:
    console = _plain()
    print_check(build_check(make.facts(execution=None, verdict=None)), console)
    assert 'A run would be judged by:' in _text(console)


def test_verify_says_whether_the_record_is_the_same(make: SimpleNamespace) -> None:
    verdict = make.verdict(
        cross_check=(Finding(kind='sight', subject='u', tick=1, time_s=0.05, text='not seen'),),
        notes=('a note',),
    )
    other = make.verdict(make.result(margin=0.25))
    texts = []
    for recorded in (None, verdict, other):
        console = _plain()
        beside = compare(recorded, verdict, 'v') if recorded is not None else None
        report = verify_report('b', make.judged(verdict), recorded=beside)
        print_verify(report, console)
        texts.append(_text(console))
    assert 'verified by itself' in texts[0]
    assert 'the same to the last bit' in texts[1]
    assert 'DIFFERS' in texts[2]
    assert 'recorded 0.25, recomputed 0.2' in texts[2]
    assert 'not seen' in texts[0]
    assert 'a note' in texts[0]


def test_verify_begins_with_what_it_claims_and_quotes_what_is_not_encoded(
    make: SimpleNamespace,
) -> None:
    console = _plain()
    read = make.judged(make.verdict()).clauses[0]
    lost = read.model_copy(update={'status': ClauseStatus.NOT_ENCODED, 'note': 'cannot turn'})
    print_verify(verify_report('b', make.judged(make.verdict(), read, lost)), console)
    first, *rest = _text(console).splitlines()
    assert first.startswith('MARGINS HOLD  ')
    assert '“at 40 meters”' in first
    assert any('not encoded' in row and '(cannot turn)' in row for row in rest)
    assert f'prompt   {make.prompt}' in rest
