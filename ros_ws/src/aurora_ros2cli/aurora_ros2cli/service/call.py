# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 service call`."""

from __future__ import annotations

import argparse
import sys
import time

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.fields import FieldError, read_fields
from aurora_ros2cli.graph import NAME_PREFIX, full_name, spin_until, temporary_node
from aurora_ros2cli.output import emit
from aurora_ros2cli.types import load_type

# A running server is found within this time; only then the user is told to wait.
_SILENT_WAIT_S = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        'service_name', help="Name of the ROS service to call to (e.g. '/add_two_ints')"
    )
    parser.add_argument('service_type', help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    values = parser.add_mutually_exclusive_group()
    values.add_argument(
        'values', nargs='?', default='{}', help="Request in YAML (e.g. '{a: 1, b: 2}')"
    )
    values.add_argument('--stdin', action='store_true', help='Read values from standard input')
    parser.add_argument(
        '-r', '--rate', metavar='N', type=float, help='Repeat the call at a specific rate in Hz'
    )


def main(arguments: argparse.Namespace) -> int:
    """Call a service and print request and response; waits for it as long as the user likes.

    Raises:
        CliError: If the type is unknown, the values do not fit it, or the call failed.
    """
    if arguments.rate is not None and arguments.rate <= 0:
        raise CliError('rate must be greater than zero')
    service = load_type(arguments.service_type, 'srv')
    request = service.Request()
    text = sys.stdin.read() if arguments.stdin else arguments.values
    try:
        stamps = read_fields(request, text)
    except FieldError as err:
        raise CliError(f'Failed to populate field: {err}') from err
    package = service.__module__.partition('.')[0]
    with temporary_node(f'{NAME_PREFIX}_requester_{package}_{service.__name__}') as node:
        client = node.create_client(service, full_name(node, arguments.service_name))
        if not spin_until(node, client.service_is_ready, _SILENT_WAIT_S):
            emit('waiting for service to become available...')
            spin_until(node, client.service_is_ready)
        while True:
            called_s = time.monotonic()
            for stamp in stamps:
                stamp(node.get_clock().now().to_msg())
            emit(f'requester: making request: {request!r}\n')
            future = client.call_async(request)
            spin_until(node, future.done)
            if future.exception() is not None:
                raise CliError(f'Exception while calling service: {future.exception()!r}')
            emit(f'response:\n{future.result()!r}\n')
            if arguments.rate is None:
                return 0
            time.sleep(max(0.0, called_s + 1.0 / arguments.rate - time.monotonic()))
