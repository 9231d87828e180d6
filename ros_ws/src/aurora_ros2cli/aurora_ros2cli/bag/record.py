# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag record`: stores messages as they come off the wire."""

from __future__ import annotations

import argparse
import re
import signal
import threading
import time
from datetime import datetime
from pathlib import Path
from types import FrameType

from aurora_ros2cli.bag.recorder import Recorder, Selection
from aurora_ros2cli.discovery import look_around
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import temporary_node

NODE_NAME = 'rosbag2_recorder'
POLL_S = 0.005
FLUSH_EACH_S = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument('topics', nargs='*', default=[], help='Topics to record.')
    parser.add_argument(
        '--topics', dest='more_topics', nargs='+', default=[], help='Topics to record.'
    )
    parser.add_argument(
        '-a', '--all', '--all-topics', dest='all', action='store_true', help='Record all topics.'
    )
    parser.add_argument(
        '-e', '--regex', default='', help='Record only topics containing the regular expression.'
    )
    parser.add_argument('-x', '--exclude-regex', default='', help='Exclude topics containing it.')
    parser.add_argument('--exclude-topics', nargs='+', default=[], help='Topics not to record.')
    parser.add_argument(
        '--include-hidden-topics', action='store_true', help='Record also hidden topics.'
    )
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        help='Destination of the bag to create, defaults to a timestamped folder in the current '
        'directory.',
    )
    parser.add_argument('-s', '--storage', choices=('mcap',), default='mcap', help='Only mcap')
    parser.add_argument(
        '--no-discovery',
        action='store_true',
        help='Only topics present at startup will be recorded.',
    )
    parser.add_argument(
        '-p',
        '--polling-interval',
        type=int,
        default=100,
        help='Time in ms to wait between querying available topics (default: %(default)s).',
    )
    parser.add_argument(
        '--use-sim-time',
        action='store_true',
        help='Use simulation time for message timestamps by subscribing to the /clock topic.',
    )
    parser.add_argument(
        '--disable-keyboard-controls', action='store_true', help='Accepted; there are none here'
    )
    parser.add_argument(
        '--max-cache-size', type=int, default=0, help='Accepted; flushed every second anyway'
    )


def main(arguments: argparse.Namespace) -> int:
    """Record until Ctrl-C or a termination signal.

    Raises:
        CliError: If nothing is selected, or the bag cannot be written.
    """
    selection = _selection(arguments)
    output = arguments.output or Path(datetime.now().strftime('rosbag2_%Y_%m_%d-%H_%M_%S'))
    if output.exists():
        raise CliError(f"[ERROR] [ros2bag]: Output folder '{output}' already exists.")

    stopping = threading.Event()

    # No exception out of a handler: it could strike while a record is half written.
    def stop(_number: int, _frame: FrameType | None) -> None:
        stopping.set()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    with temporary_node(NODE_NAME) as node:
        look_around(node, found=stopping.is_set)
        try:
            recorder = Recorder(node, output, selection, simulated=arguments.use_sim_time)
            _record(recorder, stopping, arguments)
            recorder.log('Recording stopped')
            recorder.close()
        except OSError as err:
            raise CliError(f"[ERROR] [ros2bag]: cannot write '{output}': {err}") from err
    return 0


def _record(recorder: Recorder, stopping: threading.Event, arguments: argparse.Namespace) -> None:
    recorder.log('Listening for topics...')
    recorder.subscribe()
    recorder.log('Recording...')
    looked_s = flushed_s = time.monotonic()
    while not stopping.is_set():
        recorder.drain()
        now_s = time.monotonic()
        due = now_s - looked_s >= arguments.polling_interval / 1000
        if due and not arguments.no_discovery:
            looked_s = now_s
            recorder.subscribe()
        if now_s - flushed_s >= FLUSH_EACH_S:
            flushed_s = now_s
            recorder.flush()
        time.sleep(POLL_S)


def _selection(arguments: argparse.Namespace) -> Selection:
    topics = [*arguments.topics, *arguments.more_topics]
    if not (topics or arguments.all or arguments.regex):
        raise CliError(
            '[ERROR] [ros2bag]: Need to specify at least one option out of --all, --topics or '
            '--regex'
        )
    try:
        return Selection(
            topics=frozenset(name if name.startswith('/') else f'/{name}' for name in topics),
            every=arguments.all,
            pattern=re.compile(arguments.regex) if arguments.regex else None,
            excluded=frozenset(arguments.exclude_topics),
            excluded_pattern=re.compile(arguments.exclude_regex)
            if arguments.exclude_regex
            else None,
            hidden=arguments.include_hidden_topics,
        )
    except re.error as err:
        raise CliError(f'[ERROR] [ros2bag]: invalid regular expression: {err}') from err
