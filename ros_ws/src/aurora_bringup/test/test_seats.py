# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which core a node of the tick path keeps to, for machines with any number of cores."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / 'scripts' / 'seats.bash'
NODES = ('sync', 'executor', 'sumo_bridge', 'uav_bridge', 'uav_sim', 'recorder', 'monitor')


def bash(text: str, **environment: str) -> str:
    done = subprocess.run(
        ['bash', '-u', '-c', f'source {SCRIPT}; {text}'],
        capture_output=True, text=True, check=True, env={**os.environ, **environment},
    )  # fmt: skip
    return done.stdout.strip()


def seats(cores: str, domain: int = 0) -> dict[str, str]:
    """Return the seat of each node on a machine with these cores ('' = any)."""
    script = (
        f'read_cores() {{ cores=({cores}); }}; '
        f'for name in {" ".join(NODES)} parser; do find_seat $name; echo "$name=$seat"; done'
    )
    lines = bash(script, ROS_DOMAIN_ID=str(domain)).splitlines()
    return dict(line.split('=', 1) for line in lines)


def test_with_two_cores_the_vehicles_have_the_second_with_the_observers() -> None:
    found = seats('0 1')
    assert [found[name] for name in NODES] == ['0', '0', '0', '1', '1', '1', '1']
    assert found['parser'] == ''


def test_with_more_cores_the_observers_have_their_own() -> None:
    assert [seats('0 1 2 3')[name] for name in NODES] == ['0', '0', '0', '1', '1', '2', '2']


def test_one_core_leaves_no_choice() -> None:
    assert set(seats('5').values()) == {''}


@pytest.mark.parametrize('cores', ['2 3', '0 1 2 3 8 9 10 11'])
def test_domains_begin_at_different_cores_of_those_that_are_allowed(cores: str) -> None:
    first, second = seats(cores, 0), seats(cores, 1)
    assert first['sync'] != second['sync']
    assert {first['sync'], second['sync']} <= set(cores.split())


def test_a_process_sits_where_its_node_belongs_unless_that_is_switched_off() -> None:
    allowed = os.sched_getaffinity(0)
    show = 'take_seat sync; read_cores; echo ${cores[*]}'
    mine = {int(core) for core in bash(show).split()}
    assert mine <= allowed
    assert len(mine) == 1
    assert {int(core) for core in bash(show, AURORA_SEATS='0').split()} == allowed
