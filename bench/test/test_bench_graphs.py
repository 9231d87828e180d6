# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The isolation campaign's own judgement; the campaign itself is run by `make bench-graphs`."""

from __future__ import annotations

import os
import socket
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip('rclpy')

from aurora_bench.graphs.__main__ import goals_of, table_of
from aurora_bench.graphs.campaign import PROMPTS, Outcome, RunRow, task
from aurora_bench.graphs.one_graph import OneGraph
from aurora_cli.doctor.processes import NODES, look
from aurora_cli.doctor.sockets import Socket
from aurora_uav_sim.protocol import mavlink_port

DOMAIN = 71


def row(number: int, **changes: Any) -> RunRow:
    good = RunRow(
        round=number, domain=DOMAIN, prompt='p', seed=1, run_id=f'r{number}', status='verified',
        expected_status='verified', sha256=str(number), expected_sha256=str(number),
    )  # fmt: skip
    return replace(good, **changes)


def outcome(*rows: RunRow, problems: tuple[str, ...] = ()) -> Outcome:
    return Outcome(
        rows=list(rows), problems=list(problems), sockets={str(DOMAIN): {'sync': 4}},
        ports={str(DOMAIN): [25151, 25160]},
    )  # fmt: skip


def met(found: Outcome, runs: int = 2) -> list[bool | None]:
    return [goal.met for goal in goals_of(found, runs)]


def test_two_graphs_never_run_the_same_at_a_time() -> None:
    for number in range(10):
        tasks = [task(graph, number) for graph in range(4)]
        assert len({prompt for prompt, _ in tasks}) == 4
    assert {task(0, number)[0] for number in range(5)} == set(PROMPTS)


def test_all_is_well() -> None:
    found = outcome(row(0), row(1))
    assert met(found) == [True, True, True]
    assert table_of(found).rows[0][:6] == (str(DOMAIN), 1, 4, '25151 to 25160', 2, 2)


@pytest.mark.parametrize(
    ('found', 'expected'),
    [
        (outcome(row(0), row(1, sha256='other')), [False, True, True]),
        (outcome(row(0), row(1, status='violated')), [False, True, True]),
        (outcome(row(0), row(1, problem='feedback of other runs')), [False, True, True]),
        (outcome(row(0), row(1, run_id='r0')), [True, False, True]),
        (outcome(row(0)), [False, False, True]),
        (outcome(row(0), row(1), problems=('sync listens on 0.0.0.0',)), [True, True, False]),
    ],
)
def test_each_failure_is_noticed(found: Outcome, expected: list[bool]) -> None:
    assert met(found) == expected


def sockets_of_all() -> dict[str, list[Socket]]:
    found: dict[str, list[Socket]] = {name: [] for name in NODES}
    found['uav_sim'] = [Socket('udp', '127.0.0.1', mavlink_port(DOMAIN), 1)]
    return found


def test_what_is_wrong_with_a_running_graph(tmp_path: Path) -> None:
    graph = OneGraph(domain=DOMAIN, folder=tmp_path)
    assert graph.problems_while_up(sockets_of_all()) == []
    bad = sockets_of_all()
    del bad['parser']
    bad['sync'] = [Socket('udp', '0.0.0.0', 7400, 2)]
    bad['uav_sim'] = [Socket('udp', '127.0.0.1', mavlink_port(DOMAIN + 1), 3)]
    problems = ' | '.join(graph.problems_while_up(bad))
    assert 'parser does not run' in problems
    assert 'sync listens on udp 0.0.0.0:7400' in problems
    assert f'expected UDP port {mavlink_port(DOMAIN)}' in problems


def test_what_is_left_after_down(tmp_path: Path) -> None:
    graph = OneGraph(domain=DOMAIN, folder=tmp_path)
    graph.run_dir.mkdir(parents=True)
    (graph.run_dir / 'sync.pid').write_text(
        f'{os.getpid()} {look(os.getpid(), Path("/proc"))[1]}\n'
    )
    assert set(graph.look()) == {'sync'}
    problems = graph.problems_after_down()
    assert any(f'sync (process {os.getpid()}) still lives' in text for text in problems)
    assert any('sync.pid is left' in text for text in problems)
    (graph.run_dir / 'sync.pid').unlink()
    graph.pids = {'sync': [2**22 + 1]}
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as held:
        held.bind(('127.0.0.1', mavlink_port(DOMAIN)))
        (problem,) = graph.problems_after_down()
        assert 'MAVLink port: Address already in use' in problem
    assert graph.problems_after_down() == []
