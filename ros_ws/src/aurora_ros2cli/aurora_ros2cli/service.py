# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 service list` and `ros2 service call`."""

from __future__ import annotations

import argparse
import sys

import rclpy
import yaml

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.fields import FieldError, set_fields
from aurora_ros2cli.graph import is_hidden, settle, temporary_node
from aurora_ros2cli.output import emit
from aurora_ros2cli.types import load_type
from aurora_ros2cli.verbs import add_verbs

_WAIT_S = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the verbs of the command."""
    verbs = add_verbs(parser)
    listing = verbs.add_parser('list', help='Output a list of available services')
    listing.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the service type'
    )
    listing.add_argument(
        '-c', '--count-services', action='store_true', help='Only display the number of services'
    )
    listing.add_argument(
        '--include-hidden-services', action='store_true', help='Consider hidden services as well'
    )
    listing.set_defaults(main=list_services)
    call = verbs.add_parser('call', help='Call a service')
    call.add_argument(
        'service_name', help="Name of the ROS service to call to (e.g. '/add_two_ints')"
    )
    call.add_argument('service_type', help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    values = call.add_mutually_exclusive_group()
    values.add_argument(
        'values', nargs='?', default='{}', help="Request in YAML (e.g. '{a: 1, b: 2}')"
    )
    values.add_argument('--stdin', action='store_true', help='Read values from standard input')
    call.set_defaults(main=call_service)


def list_services(arguments: argparse.Namespace) -> int:
    """Print each service, with its types on request."""
    with temporary_node() as node:
        settle(lambda: sorted(map(str, node.get_service_names_and_types())))
        found = sorted(node.get_service_names_and_types())
    shown = [
        (name, types)
        for name, types in found
        if arguments.include_hidden_services or not is_hidden(name)
    ]
    if arguments.count_services:
        emit(str(len(shown)))
        return 0
    for name, types in shown:
        emit(f'{name} [{", ".join(types)}]' if arguments.show_types else name)
    return 0


def call_service(arguments: argparse.Namespace) -> int:
    """Call a service once and print request and response.

    Raises:
        CliError: If the type is unknown, the values do not fit it, or the call failed.
    """
    service = load_type(arguments.service_type, 'srv', 'The passed service type is invalid')
    request = service.Request()
    text = sys.stdin.read() if arguments.stdin else arguments.values
    try:
        set_fields(request, yaml.safe_load(text))
    except (FieldError, yaml.YAMLError) as err:
        raise CliError(f'Failed to populate field: {err}') from err
    with temporary_node(f'_requester_{service.__name__}') as node:
        client = node.create_client(service, arguments.service_name)
        if not client.service_is_ready() and not client.wait_for_service(timeout_sec=_WAIT_S):
            emit('waiting for service to become available...')
            while not client.wait_for_service(timeout_sec=_WAIT_S):
                pass  # for as long as the user likes, as ros2cli does
        emit(f'requester: making request: {request!r}\n')
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future)
        if future.exception() is not None:
            raise CliError(f'Exception while calling service: {future.exception()!r}')
        emit(f'response:\n{future.result()!r}\n')
    return 0
