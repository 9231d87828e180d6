# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A short-lived hidden node, and names in the graph."""

from __future__ import annotations

import argparse
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

import rclpy
from rclpy.exceptions import InvalidTopicNameException
from rclpy.executors import SingleThreadedExecutor
from rclpy.expand_topic_name import expand_topic_name
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rclpy.validate_full_topic_name import validate_full_topic_name

from aurora_ros2cli.discovery import domain_id, look_around
from aurora_ros2cli.errors import CliError

# Hidden, as the names of ros2cli's own nodes are.
NAME_PREFIX = '_ros2cli'

# Waiting is cut in slices: Python sees Ctrl-C only between two of them.
_SLICE_S = 0.1


@contextmanager
def temporary_node(name: str | None = None, *, use_sim_time: bool = False) -> Iterator[Node]:
    """Start rclpy with a node; Ctrl-C raises KeyboardInterrupt.

    Args:
        name: Node name; a hidden one of its own by default.
        use_sim_time: Whether its clock follows `/clock`.

    Raises:
        CliError: If the environment or the name does not allow a node.
    """
    domain_id()
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        node = rclpy.create_node(
            name or f'{NAME_PREFIX}_{os.getpid()}',
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter('use_sim_time', value=use_sim_time)],
        )
        try:
            yield node
        finally:
            node.destroy_node()
    finally:
        rclpy.shutdown()


def add_look_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of every verb that looks at the graph."""
    parser.add_argument(
        '--spin-time',
        type=float,
        default=0.0,
        metavar='SPIN_TIME',
        help='Spin time in seconds to wait for discovery (at least)',
    )
    parser.add_argument(
        '-s', '--use-sim-time', action='store_true', help='Enable ROS simulation time'
    )
    parser.add_argument(
        '--no-daemon', action='store_true', help='Accepted; there never is a daemon here'
    )


@contextmanager
def settled_node(
    arguments: argparse.Namespace, found: Callable[[Node], bool] | None = None
) -> Iterator[Node]:
    """Start a node that knows the graph.

    Args:
        arguments: With the options of `add_look_arguments`.
        found: Ends the looking early, once what is looked for is there.
    """
    with temporary_node(use_sim_time=arguments.use_sim_time) as node:
        look_around(
            node,
            least_s=arguments.spin_time,
            found=None if found is None else lambda: found(node),
        )
        yield node


def spin_until(node: Node, done: Callable[[], bool], limit_s: float | None = None) -> bool:
    """Serve a node's callbacks until something holds.

    Args:
        node: The node.
        done: Asked after each callback, and ten times a second at least.
        limit_s: Give up after this time (s); None waits for ever.

    Returns:
        Whether it holds.
    """
    end_s = None if limit_s is None else time.monotonic() + limit_s
    with interrupts_held() as struck:
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        try:
            while not done():
                if struck.is_set() or (end_s is not None and time.monotonic() >= end_s):
                    return False
                executor.spin_once(timeout_sec=_SLICE_S)
            return True
        finally:
            executor.remove_node(node)
            executor.shutdown()
            del executor  # here: an exception that strikes in its `__del__` is lost


# Set by Ctrl-C while a block of `interrupts_held` runs.
_held: threading.Event | None = None


@contextmanager
def interrupts_held() -> Iterator[threading.Event]:
    """Hold Ctrl-C back until the block ends, or a block within it; a second one strikes at once.

    Amid a callback it would leave the callback group blocked, and cancelling a goal after it
    would never be answered; amid a finalizer Python drops it.

    Raises:
        KeyboardInterrupt: After the block, if Ctrl-C came.
    """
    global _held
    if _held is not None:
        yield _held
        _raise_if(_held)
        return
    struck = threading.Event()

    def strike(_number: int, _frame: FrameType | None) -> None:
        if struck.is_set():
            raise KeyboardInterrupt
        struck.set()

    previous = signal.getsignal(signal.SIGINT)
    if previous is signal.default_int_handler:  # in a background job it is ignored
        signal.signal(signal.SIGINT, strike)
    _held = struck
    try:
        yield struck
    finally:
        _held = None
        signal.signal(signal.SIGINT, previous)
    _raise_if(struck)


def _raise_if(struck: threading.Event) -> None:
    if struck.is_set():
        raise KeyboardInterrupt


def is_hidden(name: str) -> bool:
    """Whether any part of a graph name begins with an underscore."""
    return any(part.startswith('_') for part in name.split('/'))


def full_name(node: Node, name: str) -> str:
    """Return the absolute name of a topic, service or action.

    Raises:
        CliError: If no such name can exist.
    """
    try:
        expanded: str = expand_topic_name(name, node.get_name(), node.get_namespace())
        validate_full_topic_name(expanded)
    except (InvalidTopicNameException, ValueError) as err:
        raise CliError(str(err)) from err
    return expanded


def node_names(node: Node, *, hidden: bool) -> list[str]:
    """Return the full names of the nodes in the graph, sorted; equal names stand side by side."""
    return sorted(
        f'{space.rstrip("/")}/{name}'
        for name, space in node.get_node_names_and_namespaces()
        if hidden or not name.startswith('_')
    )


def split_node_name(name: str) -> tuple[str, str]:
    """Return the base name and the namespace of a full node name."""
    space, _, base = name.rpartition('/')
    return base, space or '/'
