# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign's own judgement; the campaign itself is run by `make bench-stl`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from aurora_bench.results import Goal, markdown_table
from aurora_bench.stl.agreement import Comparison
from aurora_bench.stl.cells import LENGTHS, Cell, Kind, all_cells
from aurora_bench.stl.goals import exponent, goal_cell, goals, shape
from aurora_bench.stl.report import document, tables
from aurora_bench.stl.rivals import _entries
from aurora_bench.stl.speed import Measured, Speed, run_limited
from aurora_bench.stl.tools import OURS, TOOLS
from aurora_bench.stl.verdict import same_values
from aurora_bench.stl.worker import measure, trace

NOWHERE = Path('/nowhere')


def measured(tool: str, cell: Cell, ms: float, **more: Any) -> Measured:
    return Measured(tool=tool, cell=cell, seconds=(ms / 1e3,), agrees=True, values='v', **more)


def test_cells_reach_the_lengths_and_windows() -> None:
    cells = all_cells(LENGTHS[-1])
    assert len(set(cells)) == len(cells)
    assert {cell.samples for cell in cells} == set(LENGTHS)
    assert {cell.window for cell in cells} == {0, 10, 100, 1_000, 10_000, 100_000}
    assert all(goal_cell(kind) in cells for kind in Kind)
    assert all(cell.reach < cell.samples for cell in cells)
    assert max(cell.samples for cell in all_cells(10_000)) == 10_000


def test_the_numbers_of_a_formula() -> None:
    cell = goal_cell(Kind.UNTIL)
    assert shape(cell) == 'x U[20,200] y'
    assert cell.text() == '(x >= 0) U[20,200] (y >= 0)'
    assert shape(goal_cell(Kind.NESTED)) == 'F[0,200] G[0,100] x'


@pytest.mark.parametrize('kind', list(Kind))
def test_ours_and_rtamt_are_measured_and_agree(kind: Kind) -> None:
    cell = Cell(kind=kind, samples=60, window=0 if 'end' in kind else 5)
    own, values = measure(OURS, cell)
    assert len(own['seconds']) >= 5
    for tool in ('RTAMT', 'RTAMT online'):
        if tool == 'RTAMT online' and 'end' in kind:
            continue
        _, theirs = measure(tool, cell)
        assert same_values(cell, values, theirs) == (True, f'{len(values)} values equal')


def test_another_until_is_recognised_and_errors_are_counted() -> None:
    cell = Cell(kind=Kind.UNTIL, samples=400, window=10)
    _, ours = measure(OURS, cell)
    x, y = trace(cell.samples)
    closed = np.array(
        [
            max(min(y[j], x[i : j + 1].min()) for j in range(i + 2, i + 21))
            for i in range(len(ours))
        ]
    )
    assert not np.array_equal(closed, ours)
    words = f'{len(ours)} values equal to ours for "x U (x and y)"'
    assert same_values(cell, ours, closed) == (False, words)
    wrong = ours.copy()
    wrong[[3, 7]] += 1.0
    words = f'2 of {len(ours)} values differ, first at sample 3'
    assert same_values(cell, ours, wrong) == (False, words)
    assert same_values(cell, ours, ours[:1]) == (True, 'first value equal')


def test_a_process_that_hangs_or_crashes_is_contained() -> None:
    sleep = [sys.executable, '-c', 'import time; time.sleep(60)']
    assert run_limited(sleep, {}, 0.2) == (None, '', '')
    crash = [sys.executable, '-c', 'import os, signal; os.kill(os.getpid(), signal.SIGSEGV)']
    assert run_limited(crash, {}, 20.0)[0] == -11


def test_after_a_failure_larger_cells_are_not_tried(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr('aurora_bench.stl.speed.run_limited', lambda *_: (-11, '', ''))
    speed = Speed(NOWHERE, tmp_path, 1.0)
    first = speed.run('sentil', Cell(kind=Kind.ALWAYS, samples=1000, window=100))
    assert (first.note, first.tried) == ('crashed (SIGSEGV)', True)
    larger = speed.run('sentil', Cell(kind=Kind.ALWAYS, samples=10_000, window=100))
    assert (larger.note, larger.tried) == ('crashed (SIGSEGV)', False)
    assert speed.run('sentil', Cell(kind=Kind.ALWAYS, samples=10_000, window=10)).tried
    assert speed.run('sentil', Cell(kind=Kind.UNTIL, samples=10_000, window=100)).tried
    assert speed.run('RTAMT', Cell(kind=Kind.ALWAYS, samples=10_000, window=100)).tried


def test_goals_judge_ratios_growth_and_confirmation() -> None:
    nested = goal_cell(Kind.NESTED)
    found = [measured(OURS, goal_cell(Kind.NESTED, n), n / 1e5) for n in LENGTHS]
    found += [measured('RTAMT', nested, 60.0), measured('sentil', nested, 0.05)]
    judged = {goal.name: goal for goal in goals(Comparison(), found)}
    ratio = judged['RTAMT / AURORA, nested, 10000 samples, F[0,200] G[0,100] x']
    assert (ratio.met, ratio.figure) == (True, '600 (60 ms, 0.1 ms)')
    assert judged['sentil / AURORA, nested, 10000 samples, F[0,200] G[0,100] x'].met is False
    assert judged['growth with the length, nested, up to 1000000 samples'].met is True
    assert judged['growth with the length, until, up to 1000000 samples'].met is None
    assert judged['cells whose values another library confirms'].met is True
    assert judged['equal to RTAMT, offline'].met is None
    assert exponent(found, Kind.NESTED) == pytest.approx(1.0)


def test_who_reads_a_formula_otherwise_confirms_and_refutes_nothing() -> None:
    name = 'cells whose values another library confirms'
    short, long = goal_cell(Kind.UNTIL, 1000), goal_cell(Kind.UNTIL, 10_000)

    def judged(*given: tuple[str, Cell, bool]) -> Goal:
        found = [
            Measured(tool=tool, cell=cell, seconds=(0.1,), agrees=agrees)
            for tool, cell, agrees in given
        ]
        return {goal.name: goal for goal in goals(Comparison(), found)}[name]

    left_out = judged(('RTAMT', short, True), ('reelay', short, False), ('reelay', long, False))
    assert left_out.met
    assert '1 more have values only of who reads it otherwise' in left_out.figure
    against = judged(('RTAMT', short, True), ('RTAMT', long, False))
    assert against.met is False
    assert 'otherwise' not in against.figure
    assert judged(('reelay', short, False)).met is False  # nobody reads it as we do
    assert judged().met is None


def test_one_unequal_pair_is_a_goal_missed() -> None:
    comparison = Comparison()
    for counts in comparison.modes.values():
        counts.pairs = 3
        counts.unequal = [1]
    assert [goal.met for goal in goals(comparison, [])[:3]] == [False, False, False]


def test_tables_name_what_failed_and_what_differs() -> None:
    cell = goal_cell(Kind.UNTIL)
    found = [
        measured(OURS, cell, 0.1),
        Measured(tool='RTAMT', cell=cell, note='above 60 s'),
        Measured(tool='stlpy', cell=cell, note='above 60 s', tried=False),
        Measured(
            tool='mstlo', cell=cell, seconds=(0.05,), agrees=False, values='9 of 10 values differ'
        ),
    ]
    text = '\n'.join(markdown_table(table) for table in tables(Comparison(), found))
    for words in ('above 60 s', 'not tried', '50 (500 x) *', '9 of 10 values differ', 'stlrom'):
        assert words in text
    assert len(document(Comparison(), found, 1, 2, 0.5)['cells']) == 4


def test_every_tool_is_in_the_lock() -> None:
    folder = Path(__file__).resolve().parents[3] / 'requirements'
    for lock in ('rivals-py3.11.txt', 'rivals-py3.12.txt'):
        text = (folder / lock).read_text(encoding='utf-8')
        for distribution, _ in TOOLS.values():
            assert distribution == 'aurora_core' or f'\n{distribution}==' in text, lock
        entry = _entries(text, ('setuptools',))
        assert entry.startswith('setuptools==')
        assert '--hash=sha256:' in entry
        assert 'numpy' not in entry
