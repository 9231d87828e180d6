# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag record`, `info` and `play`: what is recorded comes out again."""

from __future__ import annotations

import re
import signal
import time
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess, Popen
from threading import Thread

import pytest

pytest.importorskip('rclpy')

from rosbags.highlevel import AnyReader

from aurora_ros2cli.bag.info import file_size, seconds, time_point
from aurora_ros2cli.bag.writer import BagFolder, RecordedTopic

Ros2 = Callable[..., CompletedProcess[str]]
Started = Callable[..., Popen[str]]

pytestmark = pytest.mark.ros

FOREVER = {'sec': 9223372036, 'nsec': 854775807}
STRING = b'\x00\x01\x00\x00\x03\x00\x00\x00hi\x00\x00'
S = 1_000_000_000
# What is volatile reaches those that are matched; on a busy machine a player may be over first.
_PLAYED_AT_MOST = 6
_HEARD_WITHIN_S = 5.0


def profile(durability: str) -> dict[str, object]:
    return {
        'history': 'keep_last',
        'depth': 3,
        'reliability': 'reliable',
        'durability': durability,
        'deadline': FOREVER,
        'lifespan': FOREVER,
        'liveliness': 'automatic',
        'liveliness_lease_duration': FOREVER,
        'avoid_ros_namespace_conventions': False,
    }


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Write a bag of two topics, 2 s long."""
    folder = tmp_path / 'small'
    writer = BagFolder(folder, 'jazzy')
    for name, durability in (('/zoo/sung', 'volatile'), ('/zoo/said', 'transient_local')):
        writer.add(
            RecordedTopic(
                name=name,
                type_name='std_msgs/msg/String',
                type_hash='RIHS01_' + '0' * 64,
                profiles=(profile(durability),),
            )
        )
    for time_ns in (5 * S, 6 * S, 7 * S):
        writer.write('/zoo/sung', STRING, log_ns=time_ns, publish_ns=time_ns)
    writer.write('/zoo/said', STRING, log_ns=6 * S, publish_ns=6 * S)
    writer.close()
    return folder


def wait_for(process: Popen[str], text: str) -> None:
    assert process.stderr is not None
    while text not in (line := process.stderr.readline()):
        assert line, 'ended before it said so'


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_recording_is_readable_by_rosbags(
    started: Started, ros2: Ros2, tmp_path: Path, number: signal.Signals
) -> None:
    folder = tmp_path / 'bag'
    process = started('bag', 'record', '-o', str(folder), '-s', 'mcap', '/zoo/beat', '/zoo/sign')
    wait_for(process, 'Recording...')
    # The first second is on the disk while the recording goes on.
    file = folder / 'bag_0.mcap'
    while file.stat().st_size == 0:
        assert process.poll() is None

    process.send_signal(number)
    _, err = process.communicate(timeout=60)

    assert process.returncode == 0
    assert 'Traceback' not in err
    with AnyReader([folder]) as reader:
        counts = {name: topic.msgcount for name, topic in reader.topics.items()}
        texts = {
            connection.topic: str(vars(reader.deserialize(data, connection.msgtype))['data'])
            for connection, _, data in reader.messages()
        }
    assert texts == {'/zoo/beat': 'tick', '/zoo/sign': 'open'}
    assert counts['/zoo/sign'] == 1
    shown = ros2('bag', 'info', str(folder)).stdout
    assert (
        f'Topic: /zoo/beat | Type: std_msgs/msg/String | Count: {counts["/zoo/beat"]} |' in shown
    )


def test_info_is_the_table_of_rosbag2(
    ros2: Ros2, bag: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('TZ', 'UTC')

    lines = ros2('bag', 'info', str(bag)).stdout.splitlines()

    assert lines[0] == ''
    assert lines[1] == 'Files:             small_0.mcap'
    assert re.fullmatch(r'Bag size:          \d+(\.\d)? (B|KiB)', lines[2])
    assert lines[3:9] == [
        'Storage id:        mcap',
        'ROS Distro:        jazzy',
        'Duration:          2.000000000s',
        'Start:             Jan  1 1970 00:00:05.000000000 (5.000000000)',
        'End:               Jan  1 1970 00:00:07.000000000 (7.000000000)',
        'Messages:          4',
    ]
    kind = 'Type: std_msgs/msg/String'
    assert lines[9:11] == [
        f'Topic information: Topic: /zoo/said | {kind} | Count: 1 | Serialization Format: cdr',
        f'                   Topic: /zoo/sung | {kind} | Count: 3 | Serialization Format: cdr',
    ]
    assert ros2('bag', 'info', '-t', str(bag)).stdout == '/zoo/said\n/zoo/sung\n'
    alone = ros2('bag', 'info', str(bag / 'small_0.mcap')).stdout
    assert '\nMessages:          4\n' in alone


def test_numbers_of_the_table() -> None:
    assert [file_size(size) for size in (0, 1023, 1024, 3_300_000)] == [
        '0 B', '1023 B', '1.0 KiB', '3.1 MiB',
    ]  # fmt: skip
    assert seconds(1_000_000_001) == '1.000000001'
    assert time_point(123_000_000).endswith('.123000000 (0.123000000)')


def test_play_publishes_the_bytes(ros2: Ros2, started: Started, bag: Path) -> None:
    listener = started('topic', 'echo', '/zoo/sung', 'std_msgs/msg/String', '--csv')
    clock = started('topic', 'echo', '/clock', 'rosgraph_msgs/msg/Clock', '--once', '--csv')

    for topic in ('/zoo/sung', '/clock'):
        while 'Subscription count: 1' not in ros2('topic', 'info', topic).stdout:
            assert listener.poll() is None
            assert clock.poll() is None

    assert listener.stdout is not None
    lines = listener.stdout
    heard: list[str] = []

    def listen() -> None:
        for line in lines:
            heard.append(line)

    reader = Thread(target=listen, daemon=True)
    reader.start()
    for _ in range(_PLAYED_AT_MOST):
        before = len(heard)
        done = ros2('bag', 'play', str(bag), '--rate', '4', '--clock', '10', '--delay', '2')
        assert done.returncode == 0, done.stderr
        assert '[rosbag2_player]: Set rate to 4' in done.stderr
        deadline = time.monotonic() + _HEARD_WITHIN_S
        while len(heard) < before + 3 and time.monotonic() < deadline:
            time.sleep(0.02)
        if len(heard) >= before + 3:
            break
    listener.send_signal(signal.SIGINT)
    listener.wait(timeout=60)
    reader.join(timeout=60)
    assert heard[before:] == ['hi\n'] * 3
    assert clock.communicate(timeout=60)[0].partition(',')[0] in ('5', '6', '7')


def test_play_in_a_loop_of_one_topic_until_ctrl_c(started: Started, bag: Path) -> None:
    process = started(
        'bag', 'play', '-l', '-r', '50', str(bag), '--topics', '/zoo/said', '-m',
        '/zoo/said:=/zoo/replayed',
    )  # fmt: skip
    wait_for(process, 'Set rate to 50')
    # Latched as it was recorded; heard although the subscription came later.
    listener = started('topic', 'echo', '--once', '/zoo/replayed', 'std_msgs/msg/String')
    assert listener.communicate(timeout=60)[0] == 'data: hi\n---\n'

    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)

    assert process.returncode == 2
    assert 'Traceback' not in err


def test_bags_that_cannot_be_used(ros2: Ros2, bag: Path, tmp_path: Path) -> None:
    missing = ros2('bag', 'info', str(tmp_path / 'none'))
    assert (missing.returncode, missing.stderr.count('\n')) == (1, 1)
    assert 'does not exist!' in missing.stderr

    file = bag / 'small_0.mcap'
    file.write_bytes(file.read_bytes()[:-50])
    for verb in ('info', 'play'):
        cut = ros2('bag', verb, str(bag))
        assert cut.returncode == 1
        assert cut.stderr.startswith('[ERROR] [ros2bag]: cannot read the bag')


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        ((), 'Need to specify at least one option out of --all, --topics or --regex'),
        (('-a', '-o', '.'), "Output folder '.' already exists."),
        (('-e', '('), 'invalid regular expression: '),
    ],
)
def test_record_says_what_is_wrong(ros2: Ros2, arguments: tuple[str, ...], message: str) -> None:
    done = ros2('bag', 'record', *arguments)

    assert done.returncode == 1
    assert done.stderr.startswith(f'[ERROR] [ros2bag]: {message}')
