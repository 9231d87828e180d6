# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The parser node by itself, from the command line, as docs/interfaces.md says."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator

import pytest

pytest.importorskip('rclpy')

import yaml

from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.forked import ForkedNode
from aurora_ros.testing.processes import nodes

pytestmark = pytest.mark.ros

PROMPT = 'A drone hovers at 40 m over City Hall, twice.'
LIMIT_S = 90.0


@pytest.fixture(scope='module')
def domain(tmp_path_factory: pytest.TempPathFactory) -> Iterator[int]:
    with own_domain() as number:
        node = ForkedNode('aurora_nodes.parser', number, tmp_path_factory.mktemp('parser'))
        with nodes(node):
            node.await_ready()
            yield number


def _ros2(domain: int, *words: str) -> str:
    done = subprocess.run(
        ('ros2', *words),
        env=os.environ | {'ROS_DOMAIN_ID': str(domain)},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_call_says_what_was_understood_and_the_graph_stays_to_be_seen(domain: int) -> None:
    kind = 'aurora_msgs/srv/ParsePrompt'
    said = _ros2(domain, 'service', 'call', '/aurora/parse', kind, f'{{prompt: "{PROMPT}"}}')
    assert 'understood=True' in said
    assert '"status":"not_encoded"' in said
    assert "id='uav1'" in said
    # asked for after the call: the last graph is kept for whoever comes later
    shown = next(yaml.safe_load_all(_ros2(domain, 'topic', 'echo', '/aurora/agsg', '--once')))
    altitude = {p['path']: p for p in shown['parameters']}['missions/m1/altitude_m']
    assert (altitude['requested'], altitude['unit']) == (40.0, 'm')
    assert PROMPT[altitude['span_start'] : altitude['span_end']] == '40 m'


def test_a_question_is_no_understanding(domain: int) -> None:
    kind = 'aurora_msgs/srv/ParsePrompt'
    said = _ros2(domain, 'service', 'call', '/aurora/parse', kind, '{prompt: "Bonjour."}')
    assert 'understood=False' in said
    assert '"question":"' in said
