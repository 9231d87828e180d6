# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The cost model finds what was put in, and plays tasks through as they would go."""

from __future__ import annotations

import pytest

from aurora_bench.campaign.at_scale import (
    PROMPTS,
    SEEDS,
    WORKERS,
    cost_line,
    cost_line_table,
    makespan_s,
    scale_table,
)
from aurora_bench.campaign.plan import Configuration
from aurora_bench.campaign.record import CampaignRun, Ending


def run(number: int, simulated_s: float, simulations: int, spent_s: float) -> CampaignRun:
    """Return a run with its times."""
    return CampaignRun(
        key=str(number), configuration=Configuration.AURORA, reader='offline', file='own.jsonl',
        id=f'hover-{number}', category='hover', feasibility='feasible', seed=1,
        status='verified', ending=Ending.COMPLETED, simulated_s=simulated_s,
        simulations=simulations, seconds={'processor': spent_s},
    )  # fmt: skip


def test_the_line_is_found_again() -> None:
    """Half a second a run and 2 ms a tick of 20 a second."""
    runs = [run(k, 10.0 * k, 1 + k % 3, 0.5 + 0.04 * 10.0 * k * (1 + k % 3)) for k in range(20)]
    line = cost_line(runs)
    assert line is not None
    assert line.run_s == pytest.approx(0.5)
    assert line.tick_s == pytest.approx(0.002)
    assert line.explained == pytest.approx(1.0)
    assert cost_line(runs[:9]) is None


def test_a_cost_is_never_negative() -> None:
    """Of runs that are the quicker the longer they simulate, ticks are free."""
    line = cost_line([run(k, 10.0 * k, 1, 30.0 - k) for k in range(20)])
    assert line is not None
    assert line.tick_s == 0.0


def test_tasks_go_to_whoever_is_free() -> None:
    # 4 s and 1 s begin together; 1 s and 1 s follow the short one.
    assert makespan_s([4.0, 1.0, 1.0, 1.0], 2, 0.0) == (4.0, 7.0 / 8.0)
    assert makespan_s([4.0, 1.0, 1.0, 1.0], 1, 0.0) == (7.0, 1.0)


def test_one_scheduler_feeds_only_so_many() -> None:
    """Tasks of 1 s, given away every 0.1 s: a hundred workers are hardly quicker than ten."""
    tasks = [1.0] * 1000
    ten, hundred = makespan_s(tasks, 10, 0.1), makespan_s(tasks, 100, 0.1)
    assert ten[0] == pytest.approx(110.0, rel=0.02)
    assert hundred[0] == pytest.approx(101.0, rel=0.02)
    assert ten[1] == pytest.approx(0.91, abs=0.02)
    assert hundred[1] < 0.11


def test_tables_play_all_sizes_through() -> None:
    runs = [run(k, 10.0, 1, 2.0) for k in range(12)]
    assert cost_line_table(runs).rows[0][6] == 2.0
    rows = scale_table(runs).rows
    assert [row[2] for row in rows] == list(WORKERS)
    alone = rows[0][3]
    assert isinstance(alone, float)
    assert alone == pytest.approx(PROMPTS * SEEDS * 2.0 / 3600.0, rel=0.01)
    assert not scale_table(runs[:5]).rows
