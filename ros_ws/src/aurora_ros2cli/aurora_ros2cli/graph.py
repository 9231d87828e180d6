# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A short-lived hidden node that has looked around in the ROS graph."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

# Hidden, as the names of ros2cli's own nodes are.
NAME_PREFIX = '_ros2cli'

DISCOVERY_LEAST_S = 0.5
# As long as nobody has been seen: on a busy machine the first answer takes more than a second.
DISCOVERY_ALONE_S = 2.0
DISCOVERY_QUIET_S = 0.4
DISCOVERY_MOST_S = 3.0
_POLL_S = 0.05


@contextmanager
def temporary_node(suffix: str = '') -> Iterator[Node]:
    """Start rclpy with a hidden node; Ctrl-C raises KeyboardInterrupt."""
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        node = rclpy.create_node(
            f'{NAME_PREFIX}{suffix}', enable_rosout=False, start_parameter_services=False
        )
        try:
            yield node
        finally:
            node.destroy_node()
    finally:
        rclpy.shutdown()


def settle(look: Callable[[], object]) -> None:
    """Wait until discovery has gone quiet: what `look` returns no longer changes.

    Args:
        look: Returns any comparable view of the graph.
    """
    start_s = changed_s = time.monotonic()
    alone = seen = look()
    while True:
        time.sleep(_POLL_S)
        now_s = time.monotonic()
        view = look()
        if view != seen:
            seen, changed_s = view, now_s
        least_s = DISCOVERY_ALONE_S if view == alone else DISCOVERY_LEAST_S
        enough = now_s - start_s >= least_s and now_s - changed_s >= DISCOVERY_QUIET_S
        if enough or now_s - start_s >= DISCOVERY_MOST_S:
            return


def is_hidden(name: str) -> bool:
    """Whether any part of a graph name begins with an underscore."""
    return any(part.startswith('_') for part in name.split('/'))
