# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic echo`."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import yaml

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import add_look_arguments, full_name, settled_node, spin_until
from aurora_ros2cli.output import emit
from aurora_ros2cli.qos import matching_profile, named_profile
from aurora_ros2cli.rendering import TRUNCATE_LENGTH, Style, as_csv, as_yaml
from aurora_ros2cli.topic.subscribing import (
    PRESET,
    add_topic_arguments,
    message_filter,
    only_type,
)
from aurora_ros2cli.types import load_type


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    add_topic_arguments(parser)
    parser.add_argument(
        'message_type', nargs='?', help="Type of the ROS message (e.g. 'std_msgs/msg/String')"
    )
    parser.add_argument('--csv', action='store_true', help='Output all fields, comma separated')
    parser.add_argument(
        '--field', help="Echo a selected field of a message; '.' selects sub-fields"
    )
    parser.add_argument(
        '-f', '--full-length', action='store_true', help='Output all elements of long fields'
    )
    parser.add_argument(
        '-l',
        '--truncate-length',
        type=int,
        default=TRUNCATE_LENGTH,
        help='The length to truncate arrays, bytes, and string to (default: %(default)s)',
    )
    for option, text in {
        '--no-arr': "Don't print array fields of messages",
        '--no-str': "Don't print string fields of messages",
        '--flow-style': 'Print collections in the block style (not available with csv format)',
        '--no-lost-messages': 'Accepted; lost messages are not reported',
        '--raw': 'Echo the raw binary representation',
        '--once': 'Print the first message received and then exit',
        '--include-message-info': 'Shows the associated message info',
    }.items():
        parser.add_argument(option, action='store_true', help=text)


def main(arguments: argparse.Namespace) -> int:
    """Print messages until Ctrl-C, or the first one only.

    Raises:
        CliError: If the type is unknown or ambiguous, or a field does not exist.
    """
    passes = message_filter(arguments.filter_expr)
    render = renderer(arguments)
    with settled_node(arguments) as node:
        topic = full_name(node, arguments.topic_name)
        type_name = arguments.message_type or only_type(node, topic)
        if type_name is None:
            raise CliError(
                f'WARNING: topic [{topic}] does not appear to be published yet\n'
                'Could not determine the type for the passed topic'
            )
        profile = named_profile(arguments, PRESET) or matching_profile(node, topic)
        heard = 0
        failures: list[CliError] = []

        def hear(message: Any, info: dict[str, Any]) -> None:
            nonlocal heard
            if arguments.once and heard:
                return
            try:
                shown = selected(message, arguments.field)
                if passes is not None and not passes(shown):
                    return
                if arguments.include_message_info:
                    emit(yaml.safe_dump(info, sort_keys=False) + '---')
                emit(render(shown))
            except CliError as err:
                failures.append(err)
            heard += 1

        node.create_subscription(
            load_type(type_name, 'msg'), topic, hear, profile, raw=arguments.raw
        )
        spin_until(node, lambda: bool(failures) or bool(arguments.once and heard))
        if failures:
            raise failures[0]
    return 0


def selected(message: Any, field: str | None) -> Any:
    """Return a part of a message.

    Args:
        message: The message.
        field: Field names joined by dots; None selects all of it.

    Raises:
        CliError: If there is no such field.
    """
    for part in field.split('.') if field else ():
        if not hasattr(message, part):
            raise CliError(
                f"Invalid field '{field}': '{type(message).__name__}' object has no attribute "
                f"'{part}'"
            )
        message = getattr(message, part)
    return message


def renderer(arguments: argparse.Namespace) -> Callable[[Any], str]:
    """Return the function that turns a message, or a part of one, into text."""
    style = Style(
        longest=None if arguments.full_length else arguments.truncate_length,
        arrays=not arguments.no_arr,
        strings=not arguments.no_str,
        flow=arguments.flow_style,
    )

    def render(value: Any) -> str:
        if arguments.csv:
            return as_csv(value, style)
        if hasattr(value, 'get_fields_and_field_types'):
            return as_yaml(value, style) + '---'
        return f'{value}\n---'

    return render
