# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
from pathlib import Path

import pytest

from aurora_bench.latency.cold import Spent, timed
from aurora_bench.latency.summary import CHECK, IMPORTS, RUN, Measured, goals, tables
from aurora_bench.latency.warm import LOOP, Marks, WarmProcess, WarmRun
from aurora_bench.results import ResultsError


def spent(cpu_s: float, wall_s: float | None = None) -> Spent:
    return Spent(wall_s=cpu_s if wall_s is None else wall_s, cpu_s=cpu_s)


def measured(check: Spent, loop_s: float = 1.0, hashes: str = 'aa') -> Measured:
    stages = dict.fromkeys(('parse', 'check', 'ground', 'execute', 'verify', 'report'), spent(0.1))
    runs = tuple(
        WarmRun(
            status='verified',
            motion_sha256=sha256,
            total=spent(2.0),
            page=spent(1.0),
            stages={**stages, LOOP: spent(loop_s)},
            ticks=10,
        )
        for sha256 in hashes
    )
    return Measured(
        cold={IMPORTS: [spent(0.5)] * 2, CHECK: [check] * 2, RUN: [spent(4.0)] * 2},
        processes=[WarmProcess(start=spent(1.0), runs=runs)],
        busy=[0.0],
    )


def met(found: Measured) -> list[bool | None]:
    return [goal.met for goal in goals(found)]


def test_goals_are_multiples_of_the_import_and_of_the_tick_loop() -> None:
    assert met(measured(spent(2.4))) == [True, True, True, True]
    assert met(measured(spent(2.6))) == [False, True, True, True]
    assert met(measured(spent(2.4), loop_s=0.6)) == [True, True, False, True]
    assert met(measured(spent(2.4), hashes='ab'))[-1] is False


def test_wall_time_counts_on_a_quiet_machine_only() -> None:
    slow = measured(spent(2.4, wall_s=9.0))
    assert met(slow)[0] is False
    slow.busy = [0.5]
    assert met(slow)[0] is True


def test_tables_tell_the_loop_apart_from_the_rest_of_the_execution() -> None:
    first = tables(measured(spent(2.4)))[1]
    assert [row[0] for row in first.rows][:6] == [
        'start and imports',
        'parse',
        'check',
        'ground',
        LOOP,
        'execute without the loop',
    ]


def test_the_loop_is_from_the_first_tick_to_the_last() -> None:
    marks = Marks()
    for name in ('parse', 'check', 'ground', 'execute', 'execute', 'execute', 'verify', 'report'):
        marks.mark(name, 0.0, 0.0)
    marks.mark('done', 1.0, 0.0)
    stages = marks.stages()
    begin, end = marks.ticks
    assert stages[LOOP].wall_s == end[0] - begin[0]
    around = marks.begun['verify'][0] - marks.begun['execute'][0]
    assert stages['execute'].wall_s + stages[LOOP].wall_s == pytest.approx(around)


def test_a_command_is_timed_with_its_children_and_a_broken_one_is_told(tmp_path: Path) -> None:
    busy = 'import subprocess, sys; subprocess.run([sys.executable, "-c", "sum(range(10**7))"])'
    took = timed((sys.executable, '-c', busy), tmp_path)
    assert 0.0 < took.cpu_s <= took.wall_s * 2.0
    with pytest.raises(ResultsError, match='ended with 3: told'):
        timed((sys.executable, '-c', 'import sys; print("told"); sys.exit(3)'), tmp_path)
