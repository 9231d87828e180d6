# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param` and `ros2 lifecycle`, whose verbs ask the services of a node."""

from __future__ import annotations

from collections.abc import Callable
from subprocess import CompletedProcess

import pytest
import yaml

pytest.importorskip('rclpy')

from aurora_ros2cli.param.dump import nested

Ros2 = Callable[..., CompletedProcess[str]]

pytestmark = pytest.mark.ros


@pytest.mark.parametrize(
    ('name', 'expected'),
    [
        ('food.hay_kg', 'Double value is: 2.5\n'),
        ('food.names', "String values are: ['hay', 'oats']\n"),
        ('use_sim_time', 'Boolean value is: False\n'),
    ],
)
def test_get_names_the_type(ros2: Ros2, name: str, expected: str) -> None:
    assert ros2('param', 'get', '/zoo/partner', name).stdout == expected
    bare = ros2('param', 'get', '--hide-type', 'zoo/partner', name).stdout
    assert bare == expected.partition(': ')[2]


def test_set_changes_what_get_reads(ros2: Ros2) -> None:
    done = ros2('param', 'set', '/zoo/partner', 'legs', '6')
    assert (done.returncode, done.stdout) == (0, 'Set parameter successful\n')
    assert ros2('param', 'get', '/zoo/partner', 'legs').stdout == 'Integer value is: 6\n'

    refused = ros2('param', 'set', '/zoo/partner', 'legs', 'six')
    assert refused.stdout == ''
    assert refused.stderr.startswith('Setting parameter failed: ')


def test_list_of_one_node_and_of_all(ros2: Ros2) -> None:
    one = ros2('param', 'list', '/zoo/partner').stdout.splitlines()
    assert '  legs' in one
    assert one == sorted(one)

    every = ros2('param', 'list').stdout.splitlines()
    assert [line for line in every if not line.startswith(' ')] == [
        '/zoo/keeper:',
        '/zoo/partner:',
    ]
    typed = ros2('param', 'list', '/zoo/partner', '--param-prefixes', 'food', '--param-type')
    assert typed.stdout == '  food.hay_kg (type: double)\n  food.names (type: string array)\n'


def test_describe_tells_type_words_and_limits(ros2: Ros2) -> None:
    done = ros2('param', 'describe', '/zoo/partner', 'legs', 'food.hay_kg')

    assert done.stdout == (
        'Parameter name: legs\n  Type: integer\n  Description: of all animals\n  Constraints:\n'
        '    Min value: 0\n    Max value: 100\n    Step: 2\n'
        'Parameter name: food.hay_kg\n  Type: double\n  Constraints:\n'
    )


def test_dump_is_a_parameter_file(ros2: Ros2) -> None:
    dumped = yaml.safe_load(ros2('param', 'dump', '/zoo/partner').stdout)

    values = dumped['/zoo/partner']['ros__parameters']
    assert values['food'] == {'hay_kg': 2.5, 'names': ['hay', 'oats']}


def test_dotted_names_become_a_tree() -> None:
    assert nested({'a.b': 1, 'a.c.d': 2, 'e': 3}) == {'a': {'b': 1, 'c': {'d': 2}}, 'e': 3}
    assert nested({'a': 1, 'a.b': 2}) == {'a': 1, 'a.b': 2}


def test_nodes_and_parameters_that_are_not_there(ros2: Ros2) -> None:
    for arguments in (
        ('param', 'get', '/zoo/ghost', 'legs'),
        ('param', 'list', '/zoo/ghost'),
        ('param', 'describe', '/zoo/ghost', 'legs'),
        ('lifecycle', 'get', '/zoo/partner'),
        ('lifecycle', 'set', '/zoo/ghost', 'configure'),
    ):
        done = ros2(*arguments)
        assert (done.returncode, done.stderr) == (1, 'Node not found\n'), arguments
    done = ros2('param', 'get', '/zoo/partner', 'wings')
    assert (done.returncode, done.stderr) == (1, 'Parameter not set\n')


def test_a_lifecycle_from_state_to_state(ros2: Ros2) -> None:
    assert ros2('lifecycle', 'get', '/zoo/keeper').stdout == 'unconfigured [1]\n'
    assert ros2('lifecycle', 'get').stdout == '/zoo/keeper: unconfigured [1]\n'
    assert ros2('lifecycle', 'list', '/zoo/keeper').stdout == (
        '- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n'
        '- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n'
    )
    every = ros2('lifecycle', 'list', '-a', '/zoo/keeper').stdout
    assert '- activate [3]\n\tStart: inactive\n\tGoal: activating\n' in every

    wrong = ros2('lifecycle', 'set', '/zoo/keeper', 'fly')
    assert wrong.returncode == 1
    assert wrong.stderr == (
        'Unknown transition requested, available ones are:\n- configure [1]\n- shutdown [5]\n'
    )
    done = ros2('lifecycle', 'set', '/zoo/keeper', 'configure')
    assert done.stdout == 'Transitioning successful\n'
    assert ros2('lifecycle', 'get', 'zoo/keeper').stdout == 'inactive [2]\n'
    assert ros2('lifecycle', 'set', '/zoo/keeper', '3').stderr == 'Transitioning failed\n'
    assert ros2('lifecycle', 'set', '/zoo/keeper', 'cleanup').returncode == 0
    assert ros2('lifecycle', 'get', '/zoo/keeper').stdout == 'unconfigured [1]\n'
