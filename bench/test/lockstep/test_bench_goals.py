# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Goals, tables and document from runs that are made up."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from aurora_bench.lockstep.campaign import Campaign, Plan
from aurora_bench.lockstep.figure import draw
from aurora_bench.lockstep.figures import Engine, Measured, RunFigures
from aurora_bench.lockstep.goals import goals, one_hash_each
from aurora_bench.lockstep.scenarios import Configuration
from aurora_bench.lockstep.summary import document, notes, shown_parts, tables
from aurora_bench.progress import Progress
from aurora_bench.results import markdown_table
from aurora_core.report.run_folder import json_text

PARTS: dict[Engine, dict[str, float]] = {
    'local': {'sumo': 0.1, 'air': 0.05, 'executor': 0.05, 'recorder': 0.02},
    'ros': {'sync': 0.2, 'executor': 0.4, 'recorder': 0.1, 'parser': 0.1, 'grounding': 0.2},
}


def run(engine: Engine, loop_s: float, sha256: str = 'a') -> RunFigures:
    return RunFigures(
        engine=engine,
        ticks=1201,
        dt_s=0.05,
        load_s=0.05,
        loop_s=loop_s,
        close_s=0.1,
        cpu_s=sum(PARTS[engine].values()),
        parts_s=PARTS[engine],
        sha256=sha256,
        sumo_wall_s=0.1 if engine == 'local' else 0.0,
    )


def measured(engine: Engine, agents: int, *runs: RunFigures) -> Measured:
    return Measured(engine=engine, agents=agents, uavs=1, seconds=60, runs=runs, verify_s=0.5)


@pytest.fixture
def plan() -> Plan:
    return Plan(
        engines=('local', 'ros'),
        configurations=tuple(Configuration(agents=n, uavs=1, seconds=60) for n in (10, 30)),
        repetitions=3,
    )


@pytest.fixture
def campaign(plan: Plan) -> Campaign:
    found = Campaign(plan, Progress('test', stream=io.StringIO()))
    found.busy = [0.01, 0.02]
    found.measured = [
        measured('local', 10, run('local', 0.25), run('local', 0.2), run('local', 0.3)),
        measured('ros', 10, run('ros', 1.2)),
        measured('ros', 30, run('ros', 3.0)),
    ]
    found.recorder_pairs = {
        'local': [(run('local', 0.2), run('local', 0.19, ''))],
        'ros': [(run('ros', 1.2), run('ros', 0.9, ''))],
    }
    found.barrier_us = [400.0, 500.0, 450.0]
    found.cold_start_s = [2.0]
    found.bare_start_s = [1.25, 1.0, 1.5]
    found.load_services_s = [{'sync': 0.001, 'ground': 0.02, 'uav': 0.002}]
    return found


def test_goals_are_met_or_not_with_the_figure(campaign: Campaign, plan: Plan) -> None:
    found = {goal.name: (goal.figure, goal.met) for goal in goals(campaign, plan)}
    assert found == {
        'ros: real-time factor, 10 agents, 1 UAV, 60 s': ('50.0', True),
        'ros: real-time factor, 30 agents, 1 UAV, 60 s': ('20.0', False),
        'local: real-time factor, 10 agents, 1 UAV, 60 s': ('240.0', False),
        'ros: share of the recorder in a run': ('25.0% (CPU 10.0%)', False),
        'local: share of the recorder in a run': ('5.0% (CPU 9.1%)', True),
        'ros: warm reset / cold start': ('0.025', True),
        'ros: cold start / bare start of as many processes': ('1.60', True),
        'ros: tick / bare three-process barrier': ('2.22', True),
        "local: tick / SUMO's step with its state read": ('2.20 CPU, 2.50 wall', False),
        'configurations with one trace hash over all runs of all engines': (
            '2 (5 runs; local and ros)',
            True,
        ),
    }


def test_goals_of_time_are_not_judged_on_a_busy_machine(campaign: Campaign, plan: Plan) -> None:
    campaign.busy = [0.01, 0.6]
    *timed, determinism = goals(campaign, plan)
    assert [goal.met for goal in timed] == [*([None] * 8), False]  # the last is of CPU time
    assert timed[0].figure == '50.0, busy machine'
    assert determinism.met
    assert '60%' in notes(campaign)[0]
    assert 'not judged' in notes(campaign)[0]


def test_what_was_not_measured_is_neither_met_nor_missed(campaign: Campaign, plan: Plan) -> None:
    campaign.measured = campaign.measured[:1]
    campaign.recorder_pairs = {}
    campaign.bare_start_s = []
    found = goals(campaign, plan)
    assert [goal.met for goal in found] == [
        *(None, None, False, None, None, None, None, None, False, True)
    ]
    assert found[0].figure == 'not measured'


def test_hashes_differ_between_engines(campaign: Campaign, plan: Plan) -> None:
    campaign.measured[1] = measured('ros', 10, run('ros', 1.0, 'b'))
    assert one_hash_each(campaign.measured) == (1, 2)
    assert goals(campaign, plan)[-1].met is False


def test_idle_nodes_are_shown_together(campaign: Campaign) -> None:
    parts = shown_parts(campaign.measured[1])
    assert parts['others'] == pytest.approx(0.3 / 1201 * 1e6)
    assert parts['sumo_bridge'] == 0.0
    assert sum(parts.values()) == pytest.approx(1.0 / 1201 * 1e6)


def test_tables_and_document(campaign: Campaign, plan: Plan) -> None:
    speed, local, ros, beside = (markdown_table(table) for table in tables(campaign, plan))
    first = [cell.strip() for cell in speed.splitlines()[4].split('|')]
    assert first[1:9] == ['local', '10', '1', '60', '3', '208', '183', '240']
    assert '200.0 – 300.0' in speed
    assert 'sumo 45%, air 23%, executor 23%, recorder 9%' in speed
    assert '| agents | UAVs |   s | sumo | air | executor | recorder |' in local
    assert '| sync | sumo_bridge |' in ros
    assert '| bare barrier [us/tick] ' in beside
    assert '| graph tick / bare barrier [ratio] ' in beside
    assert "| local tick / SUMO's step with its state read [ratio] " in beside
    written = document(campaign, plan)
    assert written['ratios'] == {
        'graph_tick_over_bare_barrier': pytest.approx(1.2e6 / 1201 / 450.0),
        'local_tick_over_sumo_step': pytest.approx(2.2),
        'local_tick_over_sumo_step_wall': pytest.approx(2.5),
        'cold_start_over_bare_start': pytest.approx(1.6),
    }
    assert json_text(written)
    assert written['configurations'][0]['real_time_factor']['median'] == pytest.approx(240.0)
    assert written['recorder_share']['ros']['wall'] == pytest.approx(0.25)
    assert sum(written['configurations'][1]['shares'].values()) == pytest.approx(1.0)


@pytest.mark.parametrize('engines', [('local', 'ros'), ('local',), ('ros',)])
def test_the_figure_is_drawn(
    campaign: Campaign, tmp_path: Path, engines: tuple[Engine, ...]
) -> None:
    png, svg = draw([each for each in campaign.measured if each.engine in engines], tmp_path)
    assert png.read_bytes().startswith(b'\x89PNG')
    text = svg.read_text(encoding='utf-8')
    assert 'goal 250' in text
    assert ('ROS graph, 60 s' in text) == ('ros' in engines)


def test_long_runs_are_repeated_twice_at_most(plan: Plan) -> None:
    assert plan.rounds(Configuration(agents=10, uavs=1, seconds=60)) == 3
    assert plan.rounds(Configuration(agents=10, uavs=1, seconds=300)) == 2
    assert plan.base == Configuration(agents=10, uavs=1, seconds=60)
