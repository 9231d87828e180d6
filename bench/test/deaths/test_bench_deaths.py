# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The campaign of deaths: every node in every stage, and what counts as held."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_bench.deaths.report import write_report
from aurora_bench.deaths.stages import Death, DeathResult, Stage, deaths
from aurora_bench.deaths.whole import WholeKill, missing, unreadable
from aurora_bench.faults.live_graph import NAMES
from aurora_bench.faults.matrix import Blow, cells
from aurora_bench.machine import machine_facts
from aurora_bench.trust.counted import COUNTED


def test_with_the_other_campaign_every_node_dies_in_every_stage() -> None:
    struck = {(one.node, one.blow, one.stage.value) for one in deaths()}
    struck |= {(c.component.value, c.blow, c.phase.value) for c in cells()}
    assert len(struck) == len(deaths()) + len(cells()) == 231
    assert struck >= {(n, b, s.value) for n in NAMES for b in Blow for s in Stage}
    assert {one.node for one in deaths(['repair-'])} == {'repair'}


def result(stage: Stage = Stage.PARSING, **changes: Any) -> DeathResult:
    death = Death(node='parser', blow=Blow.KILL, stage=stage)
    values = {'death': death, 'seconds': 1.0, 'status': 'error', 'named': 'parser'}
    return DeathResult.model_validate({**values, 'next_equal': True, **changes})


@pytest.mark.parametrize(
    ('found', 'held'),
    [
        (result(), True),
        (result(named='sync'), False),
        (result(seconds=9.0), False),
        (result(next_equal=False), False),
        (result(left=('process 7',)), False),
        (result(note='the run ended before'), False),
        # A pass of what was not the undisturbed run is never held.
        (result(status='verified', named=''), False),
        (result(status='verified', named='', as_undisturbed=True, seconds=30.0), True),
        (result(Stage.STARTING, status='up 0', named=''), True),
        (result(Stage.STARTING, status='up 1'), True),
        (result(Stage.STARTING, status='up 1', named='sync'), False),
        (result(Stage.STARTING, status='up 1', seconds=300.0), False),
    ],
)
def test_a_death_is_held_when_who_asked_was_told_the_truth(found: DeathResult, held: bool) -> None:
    assert found.held is held


def test_what_a_killed_graph_left_is_looked_at(tmp_path: Path) -> None:
    for name in ('prompt.txt', 'spec.0.json'):
        (tmp_path / name).write_text('{}')
    assert missing(tmp_path, 'ground') == []
    assert missing(tmp_path, 'verify') == ['agsg.0.json is lost', 'bag.0 is lost']
    assert unreadable(tmp_path) == []
    (tmp_path / 'verdict.0.json').write_text('{"status": "ver')
    assert unreadable(tmp_path)[0].startswith('verdict.0.json is half written')


def test_the_table_of_trust_reads_what_is_left(tmp_path: Path) -> None:
    kills = [
        WholeKill(number=0, planned='flight 3.00 s', hit_at='execute', lost_s=0.4, told_s=1.0),
        WholeKill(number=1, planned='verify', hit_at='verify', lost_s=1.4),
    ]
    assert not write_report(tmp_path, [result(), result(named='')], kills, machine_facts())
    assert len(json.loads((tmp_path / 'deaths.json').read_text())['cells']) == 2
    told = {one.name: one.found(tmp_path)[0] for one in COUNTED if one.bench == 'deaths'}
    assert [(found.tried, found.held) for found in told.values()] == [(2, 1), (2, 1)]
    assert 'What did not hold' in (tmp_path / 'deaths.md').read_text()
