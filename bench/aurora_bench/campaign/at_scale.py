# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a campaign costs: a line through its own runs, and larger ones played through with them."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from statistics import fmean
from typing import NamedTuple

import numpy as np
from scipy.optimize import nnls

from aurora_bench.campaign.metrics import groups
from aurora_bench.campaign.record import CampaignRun
from aurora_bench.results import Cell, Table
from aurora_core.ports.random_streams import stream

Runs = Sequence[CampaignRun]
# Between two answers of 400 empty tasks that a local Dask cluster of two workers was given on two
# busy cores, in the median: scheduler and runner together.
DISPATCH_S = 0.0115
PROMPTS, SEEDS, WORKERS = 10_000, 20, (1, 2, 10, 100, 1000)
# A line through fewer runs says nothing.
_LEAST_RUNS = 10
_TICKS_PER_S = 20.0


class CostLine(NamedTuple):
    """Processor seconds of a run: so many each, and so many per tick of all its simulations.

    Attributes:
        run_s: Of each run.
        tick_s: Of each tick.
        explained: Share of the variance that the line explains (R squared).
        mean_s: Of the runs themselves.
    """

    run_s: float
    tick_s: float
    explained: float
    mean_s: float


def cost_line(runs: Runs) -> CostLine | None:
    """Fit the line by least squares, neither part negative; None of too few runs."""
    timed = [r for r in runs if 'processor' in r.seconds]
    if len(timed) < _LEAST_RUNS:
        return None
    ticks = np.array([_TICKS_PER_S * (r.simulated_s or 0.0) * r.simulations for r in timed])
    spent = np.array([r.seconds['processor'] for r in timed])
    (run_s, tick_s), _ = nnls(np.column_stack((np.ones_like(ticks), ticks)), spent)
    left = float(((spent - run_s - tick_s * ticks) ** 2).sum())
    whole = float(((spent - spent.mean()) ** 2).sum())
    return CostLine(
        run_s=float(run_s),
        tick_s=float(tick_s),
        explained=1.0 - left / whole if whole > 0.0 else 1.0,
        mean_s=float(spent.mean()),
    )


def cost_line_table(runs: Runs) -> Table:
    """Return the fitted lines, and what a prompt costs with each further seed."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        line = cost_line(part)
        if line is not None:
            rows.append(
                (
                    reader, configuration.value, len(part), line.run_s, 1e3 * line.tick_s,
                    line.explained, line.mean_s,
                )
            )  # fmt: skip
    return Table(
        headings=(
            'reader', 'configuration', 'runs', 'per run [s]', 'per tick [ms]', 'R²',
            'per prompt and seed [s]',
        ),
        rows=rows,
        caption='Cost model: processor seconds of a run by the ticks of all its co-simulations '
        '(those of the one it is judged by, times their number). A seed costs what a prompt does',
    )  # fmt: skip


def makespan_s(
    seconds: Sequence[float], workers: int, dispatch_s: float = DISPATCH_S
) -> tuple[float, float]:
    """Play tasks through: one scheduler gives them away one by one, whoever is free takes one.

    Args:
        seconds: Of each task, in their order.
        workers: How many, each on a core of its own.
        dispatch_s: For which the scheduler is busy with each task.

    Returns:
        Seconds to the end of the last task, and the share of the workers' time that was used.
    """
    free = [0.0] * workers
    scheduler_s = end_s = 0.0
    for spent in seconds:
        # A worker waits for its next task until its answer is taken, as the runner does it.
        begin_s = scheduler_s = max(heapq.heappop(free), scheduler_s) + dispatch_s
        heapq.heappush(free, begin_s + spent)
        end_s = max(end_s, begin_s + spent)
    return end_s, sum(seconds) / (workers * end_s) if end_s > 0.0 else 0.0


def scale_table(runs: Runs) -> Table:
    """Return what many prompts and seeds take, played through with the times of these runs."""
    rows: list[Sequence[Cell]] = []
    for (reader, configuration), part in groups(runs).items():
        spent = np.array([r.seconds['processor'] for r in part if 'processor' in r.seconds])
        if len(spent) < _LEAST_RUNS:
            continue
        draws = stream(1, f'scale:{reader}:{configuration.value}')
        tasks = draws.choice(spent, PROMPTS * SEEDS).tolist()
        limit = fmean(tasks) / DISPATCH_S
        for workers in WORKERS:
            took_s, used = makespan_s(tasks, workers)
            rows.append(
                (
                    reader, configuration.value, workers, took_s / 3600.0, used,
                    sum(tasks) / 3600.0, limit,
                )
            )  # fmt: skip
    return Table(
        headings=(
            'reader',
            'configuration',
            'workers',
            'hours',
            'used',
            'core hours',
            'workers that one scheduler feeds',
        ),
        rows=rows,
        caption=f'{PROMPTS:,} prompts with {SEEDS} seeds, played through with times drawn from '
        'these runs: one core per worker, a scheduler that gives tasks away one by one and needs '
        f'{1e3 * DISPATCH_S:g} ms for each',
    )
