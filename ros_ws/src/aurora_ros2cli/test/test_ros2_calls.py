# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 service call`, `ros2 action` and Ctrl-C while they wait."""

from __future__ import annotations

import json
import re
import signal
from collections.abc import Callable
from subprocess import CompletedProcess, Popen

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Started = Callable[..., Popen[str]]

pytestmark = pytest.mark.ros

WALK = ('/zoo/walk', 'aurora_msgs/action/ExecuteScenario')


@pytest.mark.parametrize('by_stdin', [False, True])
def test_service_call_prints_request_and_response(ros2: Ros2, by_stdin: bool) -> None:
    values = '{data: true}'
    extra = ('--stdin',) if by_stdin else (values,)

    done = ros2('service', 'call', '/zoo/gate', 'std_srvs/srv/SetBool', *extra, given=values)

    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith(
        'requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n'
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='heard')\n\n"
    )


def test_a_prompt_arrives_as_it_was_given(ros2: Ros2) -> None:
    prompt = 'It\'s a "van": {closing}\n\t- 45 m, $HOME `x` # ünïcode 無人機 \\ %s'

    done = ros2(
        'service', 'call', '/zoo/repeat', 'aurora_msgs/srv/ParsePrompt',
        json.dumps({'prompt': prompt}),
    )  # fmt: skip

    assert done.returncode == 0, done.stderr
    assert f'error_msg={prompt!r})' in done.stdout


@pytest.mark.parametrize(
    ('type_name', 'values', 'message'),
    [
        ('std_srvs/srv/Nothing', '{}', 'The passed service type is invalid'),
        ('std_msgs/msg/String', '{}', 'The passed service type is invalid'),
        ('std_srvs/srv/SetBool', '{colour: red}', 'Failed to populate field: '),
        ('std_srvs/srv/SetBool', '{data: [', 'Failed to populate field: '),
    ],
)
def test_service_call_says_what_is_wrong(
    ros2: Ros2, type_name: str, values: str, message: str
) -> None:
    done = ros2('service', 'call', '/zoo/gate', type_name, values)

    assert done.returncode == 1
    # rclpy may say something of its own about the node that goes.
    assert any(line.startswith(message) for line in done.stderr.splitlines())


def test_a_service_that_is_not_there_is_awaited_until_ctrl_c(started: Started) -> None:
    process = started('service', 'call', '/zoo/moat', 'std_srvs/srv/Trigger')
    assert process.stdout is not None
    assert process.stdout.readline() == 'waiting for service to become available...\n'

    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)

    assert process.returncode == 2
    assert err == ''


def test_send_goal_with_feedback(ros2: Ros2) -> None:
    done = ros2('action', 'send_goal', '-f', *WALK, '{bag_directory: x}')

    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(
        'Waiting for an action server to become available...\nSending goal:\n     agsg:\n'
    )
    assert re.search(r'^Goal accepted with ID: [0-9a-f]{32}\n\n', done.stdout, re.MULTILINE)
    assert '\nFeedback:\n    sim_time_s: 0.5\ntick: 10\n\n' in done.stdout
    assert "\nResult:\n    bag_uri: ''\n" in done.stdout
    assert done.stdout.endswith('\nGoal finished with status: SUCCEEDED\n')


def test_goals_that_are_refused_or_fail(ros2: Ros2) -> None:
    refused = ros2('action', 'send_goal', *WALK, '{bag_directory: "no"}')
    assert refused.stdout.endswith('Goal was rejected.\n')

    failed = ros2('action', 'send_goal', *WALK, '{bag_directory: nowhere}')
    assert failed.stdout.endswith('Goal finished with status: ABORTED\n')

    wrong = ros2('action', 'send_goal', *WALK, '{colour: red}')
    assert (wrong.returncode, wrong.stderr[:34]) == (1, 'Failed to populate message fields:')

    unknown = ros2('action', 'send_goal', '/zoo/walk', 'aurora_msgs/action/Nothing')
    assert (unknown.returncode, unknown.stderr) == (1, 'The passed action type is invalid\n')


def test_ctrl_c_cancels_the_goal(started: Started) -> None:
    process = started('action', 'send_goal', '-f', *WALK, '{bag_directory: for ever}')
    assert process.stdout is not None
    while not process.stdout.readline().startswith('Feedback:'):
        assert process.poll() is None

    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)

    assert 'Canceling goal...\n' in out
    assert out.endswith('Goal canceled.\n')
    assert process.returncode == 2
    assert 'Traceback' not in err


def test_action_info(ros2: Ros2) -> None:
    assert ros2('action', 'info', '-t', '/zoo/walk').stdout == (
        'Action: /zoo/walk\nAction clients: 0\nAction servers: 1\n'
        '    /zoo/partner [aurora_msgs/action/ExecuteScenario]\n'
    )
    assert ros2('action', 'info', '-c', '/zoo/run').stdout == (
        'Action: /zoo/run\nAction clients: 0\nAction servers: 0\n'
    )
