# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs that name what is in the graph."""

from __future__ import annotations

from collections.abc import Callable
from subprocess import CompletedProcess

import pytest

Ros2 = Callable[..., CompletedProcess[str]]

pytestmark = pytest.mark.ros


def test_node_list_shows_others_and_not_itself(ros2: Ros2) -> None:
    assert ros2('node', 'list').stdout == '/zoo/keeper\n/zoo/partner\n'
    assert ros2('node', 'list', '-c', '--no-daemon').stdout == '2\n'
    assert '/zoo/_hidden' in ros2('node', 'list', '-a').stdout.splitlines()


def test_node_info_names_every_end(ros2: Ros2) -> None:
    lines = ros2('node', 'info', '/zoo/partner').stdout.splitlines()

    assert lines[0] == '/zoo/partner'
    sections = [line for line in lines if line.startswith('  ') and line.endswith(':')]
    assert sections == [
        '  Subscribers:',
        '  Publishers:',
        '  Service Servers:',
        '  Service Clients:',
        '  Action Servers:',
        '  Action Clients:',
    ]
    within = dict.fromkeys(sections, '')
    for line in lines[1:]:
        if line in sections:
            section = line
        else:
            within[section] += line + '\n'
    assert '    /zoo/ear: std_msgs/msg/String\n' in within['  Subscribers:']
    assert '    /zoo/sign: std_msgs/msg/String\n' in within['  Publishers:']
    assert '    /zoo/gate: std_srvs/srv/SetBool\n' in within['  Service Servers:']
    assert within['  Service Clients:'] == '\n'
    assert '    /zoo/walk: aurora_msgs/action/ExecuteScenario\n' in within['  Action Servers:']


def test_topic_list_in_its_forms(ros2: Ros2) -> None:
    names = ros2('topic', 'list').stdout.splitlines()
    assert names == sorted(names)
    assert '/zoo/sign' in names
    assert not any('_action' in name for name in names)

    assert '/zoo/sign [std_msgs/msg/String]' in ros2('topic', 'list', '-t').stdout.splitlines()
    assert ros2('topic', 'list', '--count-topics').stdout == f'{len(names)}\n'
    hidden = ros2('topic', 'list', '--include-hidden-topics').stdout.splitlines()
    assert '/zoo/walk/_action/status' in hidden
    verbose = ros2('topic', 'list', '-v').stdout
    published, _, subscribed = verbose.partition('Subscribed topics:')
    assert ' * /zoo/mixed [std_msgs/msg/String] 2 publishers\n' in published
    assert ' * /zoo/ear [std_msgs/msg/String] 1 subscriber\n' in subscribed


def test_service_action_and_lifecycle_lists(ros2: Ros2) -> None:
    assert '/zoo/gate [std_srvs/srv/SetBool]\n' in ros2('service', 'list', '-t').stdout
    assert '/zoo/gate\n' in ros2('service', 'list').stdout
    assert ros2('action', 'list').stdout == '/zoo/walk\n'
    typed = ros2('action', 'list', '-t').stdout
    assert typed == '/zoo/walk [aurora_msgs/action/ExecuteScenario]\n'
    assert ros2('lifecycle', 'nodes').stdout == '/zoo/keeper\n'


@pytest.mark.parametrize(
    ('command', 'name', 'type_name'),
    [
        ('topic', '/zoo/sign', 'std_msgs/msg/String'),
        ('service', '/zoo/gate', 'std_srvs/srv/SetBool'),
        ('action', '/zoo/walk', 'aurora_msgs/action/ExecuteScenario'),
    ],
)
def test_type_and_find_are_each_others_reverse(
    ros2: Ros2, command: str, name: str, type_name: str
) -> None:
    done = ros2(command, 'type', name)
    assert (done.returncode, done.stdout) == (0, f'{type_name}\n')

    assert name in ros2(command, 'find', type_name).stdout.splitlines()


def test_what_is_not_there(ros2: Ros2) -> None:
    done = ros2('topic', 'type', '/zoo/moat')
    assert (done.returncode, done.stdout, done.stderr) == (1, '', '')

    done = ros2('node', 'info', '/zoo/ghost')
    assert (done.returncode, done.stderr) == (1, "Unable to find node '/zoo/ghost'\n")

    done = ros2('topic', 'find', 'std_msgs/msg/Nothing', '--count-topics')
    assert (done.returncode, done.stdout) == (0, '0\n')


def test_there_is_no_daemon(ros2: Ros2) -> None:
    for verb in ('status', 'stop'):
        assert ros2('daemon', verb).stdout == 'The daemon is not running\n'
