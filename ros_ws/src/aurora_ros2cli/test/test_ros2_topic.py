# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic echo`, `hz`, `info` and `pub`."""

from __future__ import annotations

import re
import signal
from collections.abc import Callable
from subprocess import CompletedProcess, Popen

import pytest
import yaml

Ros2 = Callable[..., CompletedProcess[str]]
Started = Callable[..., Popen[str]]

pytestmark = pytest.mark.ros


def test_echo_once_hears_a_latched_message(ros2: Ros2) -> None:
    done = ros2('topic', 'echo', '--once', '/zoo/sign')

    assert done.returncode == 0
    assert done.stdout == 'data: open\n---\n'


@pytest.mark.parametrize(
    ('options', 'expected'),
    [
        (('--field', 'data'), 'open\n---\n'),
        (('--csv',), 'open\n'),
        (('--flow-style',), '{data: open}\n---\n'),
        (('--no-str',), "data: '<string length: <4>>'\n---\n"),
        (('-l', '2'), 'data: op...\n---\n'),
        (('--filter', "m.data == 'open'"), 'data: open\n---\n'),
        (('--raw',), "b'\\x00\\x01\\x00\\x00\\x05\\x00\\x00\\x00open\\x00"),
    ],
)
def test_echo_renders_as_asked(ros2: Ros2, options: tuple[str, ...], expected: str) -> None:
    done = ros2('topic', 'echo', '--once', 'zoo/sign', 'std_msgs/msg/String', *options)

    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(expected)


def test_echo_of_a_nested_field(ros2: Ros2) -> None:
    done = ros2('topic', 'echo', '--once', '/zoo/pose', '--field', 'pose.position')

    assert done.stdout == 'x: 0.0\ny: 0.0\nz: 0.0\n---\n'


def test_echo_takes_what_all_publishers_offer(ros2: Ros2) -> None:
    # A reliable request would never match the publisher of `beat`.
    assert ros2('topic', 'echo', '--once', '/zoo/beat').stdout == 'data: tick\n---\n'


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        (('/zoo/moat',), 'Could not determine the type for the passed topic\n'),
        (('/zoo/sign', 'std_msgs/msg/Nothing'), 'The passed message type is invalid\n'),
        (('/zoo/sign', 'std_srvs/srv/SetBool'), 'The passed message type is invalid\n'),
        (
            ('/zoo/sign', '--field', 'colour'),
            "Invalid field 'colour': 'String' object has no attribute 'colour'\n",
        ),
        (('/zoo/sign', '--filter', 'm.data ='), "Invalid filter expression 'm.data ='"),
        (('/zoo/si gn',), "topic name '/zoo/si gn' is invalid: "),
    ],
)
def test_echo_says_what_is_wrong(ros2: Ros2, arguments: tuple[str, ...], message: str) -> None:
    done = ros2('topic', 'echo', *arguments)

    assert done.returncode == 1
    assert message in done.stderr
    assert 'Traceback' not in done.stderr


def test_hz_prints_the_rate_until_ctrl_c(started: Started) -> None:
    process = started('topic', 'hz', '/zoo/beat')
    assert process.stdout is not None

    lines = [process.stdout.readline(), process.stdout.readline()]
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)

    assert re.fullmatch(r'average rate: \d+\.\d{3}\n', lines[0])
    assert re.fullmatch(
        r'\tmin: \d\.\d{3}s max: \d\.\d{3}s std dev: \d\.\d{5}s window: \d+\n', lines[1]
    )
    assert process.returncode == 2
    assert 'Traceback' not in err


def test_bw_prints_the_bandwidth_until_ctrl_c(started: Started) -> None:
    process = started('topic', 'bw', '/zoo/beat')
    assert process.stdout is not None

    lines = [process.stdout.readline() for _ in range(3)]
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)

    assert lines[0] == 'Subscribed to [/zoo/beat]\n'
    # "tick" as a CDR string: 4 bytes of encapsulation, its length, five characters, padded or not.
    assert re.fullmatch(r'\d+ B/s from \d+ messages\n', lines[1])
    assert re.fullmatch(r'\tMessage size mean: (1[3-6]) B min: \1 B max: \1 B\n', lines[2])
    assert process.returncode == 2
    assert 'Traceback' not in err


def test_info_counts_and_describes(ros2: Ros2) -> None:
    short = ros2('topic', 'info', '/zoo/mixed').stdout
    assert short == 'Type: std_msgs/msg/String\nPublisher count: 2\nSubscription count: 0\n'

    full = ros2('topic', 'info', '-v', '/zoo/sign').stdout
    assert full.startswith(
        'Type: std_msgs/msg/String\n\nPublisher count: 1\n\nNode name: partner\n'
        'Node namespace: /zoo\nTopic type: std_msgs/msg/String\nTopic type hash: RIHS01_'
    )
    assert '\nEndpoint type: PUBLISHER\n' in full
    assert '\n  Durability: TRANSIENT_LOCAL\n' in full
    assert full.endswith('\n\nSubscription count: 0\n\n')

    done = ros2('topic', 'info', '/zoo/moat')
    assert (done.returncode, done.stderr) == (1, "Unknown topic '/zoo/moat'\n")


def test_pub_is_heard(ros2: Ros2, started: Started) -> None:
    listener = started('topic', 'echo', '--once', '/zoo/news', 'std_msgs/msg/Header')
    assert listener.stdout is not None

    done = ros2(
        'topic', 'pub', '--once', '/zoo/news', 'std_msgs/msg/Header',
        '{frame_id: "a \'b\'\\nç", stamp: now}',
    )  # fmt: skip
    heard, _ = listener.communicate(timeout=60)

    assert done.returncode == 0, done.stderr
    assert 'publisher: beginning loop\npublishing #1: std_msgs.msg.Header(' in done.stdout
    message = yaml.safe_load(heard.removesuffix('---\n'))
    assert message['frame_id'] == "a 'b'\nç"
    assert message['stamp']['sec'] > 0


def test_pub_says_what_is_wrong(ros2: Ros2) -> None:
    done = ros2('topic', 'pub', '--once', '/x', 'std_msgs/msg/String', '{data: [')
    assert (done.returncode, done.stderr[:26]) == (1, 'Failed to populate field: ')

    done = ros2('topic', 'pub', '/x', 'std_msgs/msg/Nothing', '{}')
    assert (done.returncode, done.stderr) == (1, 'The passed message type is invalid\n')

    done = ros2(
        'topic',
        'pub',
        '--once',
        '--max-wait-time-secs',
        '0.1',
        '/zoo/nobody',
        'std_msgs/msg/Empty',
    )
    assert done.returncode == 1
    assert done.stderr.startswith('Timed out waiting for subscribers: Expected 1 ')
