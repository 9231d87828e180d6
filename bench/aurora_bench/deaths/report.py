# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of the campaign."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from aurora_bench.deaths.stages import DeathResult, Stage
from aurora_bench.deaths.whole import LOST_LIMIT_S, WholeKill
from aurora_bench.machine import Machine
from aurora_bench.results import Goal, Table, write_results


def write_report(
    folder: Path, results: Sequence[DeathResult], kills: Sequence[WholeKill], machine: Machine
) -> bool:
    """Write `deaths.json` and `deaths.md`; return whether everything that was tried held."""
    held, kept = sum(r.held for r in results), sum(k.held for k in kills)
    slowest = max((r.seconds for r in results if r.status == 'error'), default=0.0)
    lost = max((k.lost_s for k in kills), default=0.0)
    goals = [
        Goal(
            name='a node dies: named in an error, or the run ends as ever; the next one is equal',
            target='all',
            figure=f'{held} of {len(results)}, slowest error {slowest:g} s',
            met=held == len(results) if results else None,
        ),
        Goal(
            name='the whole graph dies: finished stages are whole, the bag is recovered to within '
            f'{LOST_LIMIT_S:g} s, the next run is equal',
            target='all',
            figure=f'{kept} of {len(kills)}, most lost {lost:.2f} s',
            met=kept == len(kills) if kills else None,
        ),
    ]
    write_results(
        folder,
        'deaths',
        {
            'cells': [{**r.model_dump(mode='json'), 'held': r.held} for r in results],
            'whole': [{**k.model_dump(mode='json'), 'held': k.held} for k in kills],
        },
        title='Nodes that die from start to repair, and whole graphs',
        goals=goals,
        tables=[_by_stage(results), _kills(kills), _not_held(results, kills)],
        notes=(
            'What a tick and its judge need is struck in the middle of runs by `make '
            'bench-faults`. A dead node that has no part in the run any more is no error.',
        ),
        machine=machine,
    )
    return held == len(results) and kept == len(kills)


def _by_stage(results: Sequence[DeathResult]) -> Table:
    rows = []
    for stage in Stage:
        these = [r for r in results if r.death.stage is stage]
        if these:
            named = sum(r.is_told and not r.as_undisturbed for r in these)
            rows.append(
                (
                    stage, len(these), named, sum(r.as_undisturbed for r in these),
                    max(r.seconds for r in these), sum(r.held for r in these),
                )
            )  # fmt: skip
    headings = ('stage', 'deaths', 'named', 'as ever', 'longest [s]', 'held')
    return Table(headings=headings, rows=rows, caption='Deaths by stage')


def _kills(kills: Sequence[WholeKill]) -> Table:
    rows = [(k.planned, k.hit_at, k.lost_s, k.told_s, 'yes' if k.held else 'NO') for k in kills]
    headings = ('killed in', 'stage', 'lost [s]', 'told after [s]', 'held')
    return Table(headings=headings, rows=rows, caption='Graphs killed whole, simulated time lost')


def _not_held(results: Sequence[DeathResult], kills: Sequence[WholeKill]) -> Table:
    rows = [
        (r.death.name, r.hit_at, f'{r.status} {r.named} {", ".join(r.left)} {r.note}'[:300])
        for r in results
        if not r.held
    ]
    rows += [(f'whole {k.number}', k.hit_at, '; '.join(k.problems)) for k in kills if not k.held]
    return Table(headings=('case', 'hit at', 'what'), rows=rows, caption='What did not hold')
