# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`aurora export`: what it writes is read by those that the formats are for."""

from __future__ import annotations

import json
import subprocess
import sysconfig
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from xml.etree.ElementTree import parse

import duckdb
import pytest

from aurora_core.pipeline.verification import load_bag

Call = Callable[..., SimpleNamespace]


def test_duckdb_reads_the_tables_and_finds_the_same_numbers(
    finished: SimpleNamespace, here: Path, call: Call
) -> None:
    for form in ('csv', 'parquet'):
        assert call('export', str(finished.folder), '--to', form, '-o', form).code == 0
    content, _ = load_bag(finished.folder / 'bag.0')
    trace = content.trace
    with duckdb.connect() as base:
        for form in ('csv', 'parquet'):
            table = f"'{form}/states.{form}'"
            asked = f'SELECT "uav1.z_m", "ego.x_m" FROM {table} ORDER BY time_s'
            rows = base.sql(asked).fetchall()
            assert len(rows) == trace.ticks
            for tick in (0, 100, trace.ticks - 1):
                row = trace.roster.agent_index('ego')
                assert rows[tick] == (trace.uav[tick, 0, 2], trace.ground[tick, row, 0])
            margins = f"FROM '{form}/conditions.{form}' WHERE margin IS NOT NULL"
            judged = base.sql(f'SELECT DISTINCT condition {margins}').fetchall()
            told = {row['id'] for row in finished.report['conditions']}
            assert {name for (name,) in judged} <= told
            assert len(judged) > 5


def test_sumo_runs_the_folder_from_the_same_places(
    finished: SimpleNamespace, here: Path, call: Call
) -> None:
    assert call('export', str(finished.folder), '--to', 'sumo', '-o', 'sumo').code == 0
    program = Path(sysconfig.get_path('scripts')) / 'sumo'
    done = subprocess.run(
        [program, '-c', 'sumo/scenario.sumocfg', '--fcd-output', 'fcd.xml', '--end', '3'],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    seen = [parse(path).getroot()[0] for path in ('fcd.xml', 'sumo/recorded.fcd.xml')]
    driven, recorded = (
        {str(e.get('id')): (float(e.get('x', 'nan')), float(e.get('y', 'nan'))) for e in step}
        for step in seen
    )
    assert driven.keys() == recorded.keys()
    for name, place in recorded.items():
        assert driven[name] == pytest.approx(place, abs=0.5), name


def test_open_scenario_names_roads_that_are_there(
    finished: SimpleNamespace, here: Path, call: Call
) -> None:
    done = call('export', str(finished.folder), '--to', 'openscenario', '-o', 'osc', '--json')
    assert done.code == 0
    assert json.loads(done.out)['files'] == ['downtown.xodr', 'scenario.xosc']
    root = parse('osc/scenario.xosc').getroot()
    named = {e.get('name') for e in root.iter('ScenarioObject')}
    assert named >= {'ego', 'uav1'}
    road = next(root.iter('LogicFile')).get('filepath')
    assert parse(f'osc/{road}').getroot().tag == 'OpenDRIVE'


def test_a_plan_is_written_for_who_flies(
    finished: SimpleNamespace, here: Path, call: Call
) -> None:
    assert call('export', str(finished.folder), '--to', 'plan', '-o', 'plans').code == 0
    plan = json.loads(Path('plans/uav1.plan').read_text())
    commands = [item['command'] for item in plan['mission']['items']]
    assert (commands[0], commands[-1]) == (22, 21)
    heights = [i['params'][6] for i in plan['mission']['items'] if i['command'] == 16]
    assert max(heights) == pytest.approx(20.0, abs=1.5)


def test_an_export_leaves_the_run_as_it_was(
    finished: SimpleNamespace, here: Path, call: Call
) -> None:
    done = call('export', str(finished.folder), '--to', 'dwg')
    assert done.code == 64
    assert 'one of csv, parquet, plan' in done.err
    assert call('export', str(finished.folder), '--to', 'csv', '-o', 'twice').code == 0
    assert call('export', str(finished.folder), '--to', 'csv', '-o', 'twice').code == 64
    assert call('verify', str(finished.folder)).code == 0
