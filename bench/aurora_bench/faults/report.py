# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of the campaign."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.faults.matrix import LIMITS_S, Blow, CellResult
from aurora_bench.faults.prompts import PromptRounds
from aurora_bench.faults.updown import Round
from aurora_bench.results import Cell, Goal, Table, write_results


def write_report(
    folder: Path,
    results: Sequence[CellResult],
    rounds: Sequence[Round],
    prompts: PromptRounds | None,
) -> bool:
    """Write `faults.json` and `faults.md`; return whether everything that was tried held."""
    goals = _goals(results, rounds, prompts)
    tables = [_matrix_table(results)] if results else []
    tables += [_updown_table(rounds)] if rounds else []
    tables += [_use_table(prompts)] if prompts is not None else []
    write_results(
        folder,
        'faults',
        {
            'cells': [{**r.model_dump(mode='json'), 'held': r.held} for r in results],
            'updown': [{**r.model_dump(mode='json'), 'held': r.held} for r in rounds],
            'prompts': prompts.model_dump(mode='json') if prompts is not None else None,
        },
        title='Dead nodes, starting and stopping, many prompts',
        tables=tables,
        goals=goals,
    )
    return all(goal.met is not False for goal in goals)


def _goals(
    results: Sequence[CellResult], rounds: Sequence[Round], prompts: PromptRounds | None
) -> list[Goal]:
    goals = []
    for blow in Blow:
        tried = [result for result in results if result.cell.blow is blow]
        held = sum(result.held for result in tried)
        slowest = max((r.seconds for r in tried if r.seconds is not None), default=0.0)
        goals.append(
            Goal(
                name=f'{blow}: error, component named, nothing left, next prompt equal',
                target=f'all, within {LIMITS_S[blow]:g} s',
                figure=f'{held} of {len(tried)}, slowest {slowest:g} s'
                if tried
                else 'not measured',
                met=held == len(tried) if tried else None,
            )
        )
    clean = sum(one.held for one in rounds)
    goals.append(
        Goal(
            name='up and down without anything left',
            target='all',
            figure=f'{clean} of {len(rounds)}' if rounds else 'not measured',
            met=clean == len(rounds) if rounds else None,
        )
    )
    goals.append(
        Goal(
            name='different prompts in one graph; the first one again leaves an equal trace; no '
            'descriptor left',
            target='all',
            figure=f'{len(prompts.rounds) - 1} prompts' if prompts else 'not measured',
            met=prompts.held if prompts else None,
        )
    )
    return goals


def _matrix_table(results: Sequence[CellResult]) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (
            r.cell.component,
            r.cell.blow,
            r.cell.phase,
            r.noticed_s,
            r.seconds,
            r.status or r.note,
            r.named,
            ', '.join(r.left) or 'nothing',
            f'{r.next_status}{", equal" if r.next_equal else ""}',
            r.next_s,
            'yes' if r.held else 'NO',
        )
        for r in results
    ]
    return Table(
        headings=(
            'component', 'signal', 'phase', 'noticed [s]', 'answer [s]', 'status', 'named', 'left',
            'next prompt', 'took [s]', 'held',
        ),
        rows=rows,
        caption='A component dies during a run:',
    )  # fmt: skip


def _updown_table(rounds: Sequence[Round]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for ending in sorted({one.ending for one in rounds}):
        these = [one for one in rounds if one.ending is ending]
        rows.append(
            (
                ending,
                len(these),
                statistics.median(one.up_s for one in these),
                statistics.median(one.down_s for one in these),
                sum(one.held for one in these),
                sum(one.shared_memory for one in these),
                sum(len(one.forced) for one in these),
            )
        )
    return Table(
        headings=(
            'ended by', 'rounds', 'up, median [s]', 'end, median [s]', 'clean',
            'shared-memory files used', 'nodes that needed a second signal',
        ),
        rows=rows,
        caption='Starting and stopping:',
    )  # fmt: skip


def _use_table(prompts: PromptRounds) -> Table:
    rows: list[tuple[Cell, ...]] = [
        (name, round(rss0 / 1024, 1), round(rss1 / 1024, 1), fd0, fd1)
        for name, rss0, rss1, fd0, fd1 in prompts.use
    ]
    return Table(
        headings=('node', 'memory warm [MiB]', 'memory at the end [MiB]', 'descriptors warm',
                  'descriptors at the end'),
        rows=rows,
        caption=f'Use of the nodes over {len(prompts.rounds)} prompts:',
    )  # fmt: skip
