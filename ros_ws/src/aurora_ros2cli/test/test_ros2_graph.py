# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs that look at a running graph, against a node in another process."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip('rclpy')

ROOT = Path(__file__).resolve().parents[1]
DOMAIN = '93'
PARTNER = """
import rclpy, sys
from std_msgs.msg import String
from std_srvs.srv import SetBool
from rclpy.qos import DurabilityPolicy, QoSProfile

rclpy.init()
node = rclpy.create_node('partner', namespace='/zoo')

def answer(request, response):
    response.success = request.data
    response.message = 'heard'
    return response

node.create_service(SetBool, 'gate', answer)
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_publisher(String, 'sign', latched).publish(String(data='open'))
print('ready', flush=True)
while rclpy.ok():
    rclpy.spin_once(node, timeout_sec=0.1)
"""

pytestmark = pytest.mark.ros


@pytest.fixture(scope='module')
def environment() -> dict[str, str]:
    paths = [str(ROOT), os.environ.get('PYTHONPATH', '')]
    return {**os.environ, 'ROS_DOMAIN_ID': DOMAIN, 'PYTHONPATH': os.pathsep.join(paths)}


@pytest.fixture(scope='module', autouse=True)
def partner(environment: dict[str, str]) -> Iterator[None]:
    process = subprocess.Popen(
        [sys.executable, '-c', PARTNER], env=environment, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == 'ready\n'
    yield
    process.kill()
    process.wait()
    process.stdout.close()


@pytest.fixture
def ros2(environment: dict[str, str]) -> Ros2:
    return Ros2(environment)


class Ros2:
    """Calls the stand-in."""

    def __init__(self, environment: dict[str, str]) -> None:
        self._environment = environment

    def __call__(self, *arguments: str, given: str = '') -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, str(ROOT / 'scripts' / 'ros2'), *arguments],
            env=self._environment,
            input=given,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )


def test_node_list_shows_others_and_not_itself(ros2: Ros2) -> None:
    assert ros2('node', 'list').stdout == '/zoo/partner\n'
    assert ros2('node', 'list', '-c').stdout == '1\n'


def test_topic_list_with_types(ros2: Ros2) -> None:
    names = ros2('topic', 'list').stdout.splitlines()
    typed = ros2('topic', 'list', '-t').stdout.splitlines()

    assert '/zoo/sign' in names
    assert '/zoo/sign [std_msgs/msg/String]' in typed
    assert names == sorted(names)


def test_service_list_with_types(ros2: Ros2) -> None:
    assert '/zoo/gate [std_srvs/srv/SetBool]' in ros2('service', 'list', '-t').stdout.splitlines()
    assert '/zoo/gate' in ros2('service', 'list').stdout.splitlines()


def test_topic_echo_once_hears_a_latched_message(ros2: Ros2) -> None:
    done = ros2('topic', 'echo', '--once', '/zoo/sign')

    assert done.returncode == 0
    assert done.stdout == 'data: open\n---\n'


def test_topic_echo_of_an_unknown_topic_fails(ros2: Ros2) -> None:
    done = ros2('topic', 'echo', '/zoo/moat')

    assert done.returncode == 1
    assert done.stderr.endswith('Could not determine the type for the passed topic\n')


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
    assert done.stderr.startswith(message)
