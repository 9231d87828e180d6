# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The benchmark itself, small: the command with the local engine, and the graph."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from aurora_bench.lockstep import campaign
from aurora_bench.lockstep.__main__ import main
from aurora_bench.lockstep.bare_start import measure_bare_start
from aurora_bench.lockstep.barrier import measure_barrier
from aurora_bench.lockstep.figures import RECORDER
from aurora_bench.lockstep.graph import graph_without_recorder, running_graph
from aurora_bench.lockstep.local_runs import measure_local
from aurora_bench.lockstep.processes import cpu_s
from aurora_bench.lockstep.ros_runs import client_of
from aurora_bench.lockstep.scenarios import Configuration, grounded
from aurora_bench.results import ResultsError
from aurora_ros.processes import process_state
from aurora_ros.testing.domains import own_domain

SMALL = Configuration(agents=3, uavs=1, seconds=12)
TICKS = 241


def test_the_command_measures_the_local_engine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(campaign, 'busy_share', lambda: 0.0)
    options = '--quick --engines local --agents 3 --uavs 1 2 --seconds 12'
    assert main([*options.split(), '--results', str(tmp_path)]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        f'lockstep.{kind}' for kind in ('json', 'md', 'png', 'svg')
    ]
    written = json.loads((tmp_path / 'lockstep.json').read_text(encoding='utf-8'))
    one, two = written['configurations']
    assert (one['agents'], one['uavs'], two['uavs']) == (3, 1, 2)
    assert [run['ticks'] for run in one['runs']] == [TICKS, TICKS]
    assert len(one['hashes']) == 1
    assert one['hashes'] != two['hashes']
    assert set(one['shares']) == {'sumo', 'air', 'executor', 'recorder'}
    assert min(one['shares'].values()) > 0.0
    said = capsys.readouterr()
    assert '| local  |      3 |    2 |' in said.out
    assert '[5/5]' in said.err


@pytest.mark.parametrize(
    'options', ['--agents 1', '--seconds 2', '--repetitions 0', '--engines x']
)
def test_options_out_of_range(options: str, capsys: pytest.CaptureFixture[str]) -> None:
    try:
        code = main(options.split())
    except SystemExit as end:  # argparse
        code = int(end.code or 0)
    assert code in (2, 64)
    assert 'expected' in capsys.readouterr().err.replace('invalid choice', 'expected')


def test_cpu_time_of_a_process(tmp_path: Path) -> None:
    folder = tmp_path / '7'
    folder.mkdir()
    fields = ['S', *(['0'] * 10), '150', '50', '0']
    (folder / 'stat').write_text(f'7 (a) name) {" ".join(fields)}\n', encoding='ascii')
    assert cpu_s(7, tmp_path) == 200 / os.sysconf('SC_CLK_TCK')
    with pytest.raises(ResultsError, match='process 8 has ended'):
        cpu_s(8, tmp_path)


@pytest.mark.ros
def test_the_graph_gives_the_hash_of_the_local_engine(tmp_path: Path) -> None:
    graph = grounded(SMALL)
    with running_graph(tmp_path / 'run') as running, client_of(running) as client:
        found = client.run(graph, tmp_path / 'ros' / 'bag')
        verify_s = client.verify_s(graph, tmp_path / 'ros' / 'bag')
        services = client.load_services_s(graph)
    assert found.ticks == TICKS
    assert found.sha256 == measure_local(graph, tmp_path / 'local' / 'bag').sha256
    assert found.loop_s > 0.0
    assert found.cpu_s > 0.0
    assert {'sync', 'sumo_bridge', 'uav_bridge', 'uav_sim', 'executor', 'orchestrator'} <= set(
        found.parts_s
    )
    assert verify_s > 0.0
    assert set(services) == {'sync', 'ground', 'uav'}
    for pid in running.pids.values():
        assert process_state(pid) is None


@pytest.mark.ros
def test_a_graph_without_a_recorder_runs_to_the_end_twice(tmp_path: Path) -> None:
    graph = grounded(SMALL)
    with graph_without_recorder(tmp_path / 'run') as running, client_of(running) as client:
        runs = [client.run(graph, tmp_path / name / 'bag', records=False) for name in 'ab']
    assert [run.ticks for run in runs] == [TICKS, TICKS]
    assert [run.sha256 for run in runs] == ['', '']
    assert RECORDER in runs[0].parts_s
    assert not (tmp_path / 'a').exists()


@pytest.mark.ros
def test_bare_nodes_start_and_none_is_left(tmp_path: Path) -> None:
    assert 0.01 < measure_bare_start(2, tmp_path) < 60.0
    pids = [int(file.read_text()) for file in tmp_path.glob('*/*.ready')]
    assert len(pids) == 2
    assert [process_state(pid) for pid in pids] == [None, None]


@pytest.mark.ros
def test_the_bare_barrier_ticks() -> None:
    with own_domain() as domain:
        assert 10.0 < measure_barrier(50, domain) < 1e6
