# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs `list`, `type`, `find` and `nodes` know of nodes, topics, services, actions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from rclpy.action import get_action_names_and_types
from rclpy.node import Node

from aurora_ros2cli.graph import is_hidden, node_names

Found = list[tuple[str, list[str]]]

LIFECYCLE_TYPE = 'lifecycle_msgs/srv/GetState'
LIFECYCLE_SERVICE = '/get_state'


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """One kind of name in the graph.

    Attributes:
        one: The word for one of them.
        found: Returns all names with their types (none for nodes), in order.
        hidden: Whether a name is shown on request only.
        show_hidden: The option that shows hidden names too.
        typed: Whether its names have types.
    """

    one: str
    found: Callable[[Node], Found]
    hidden: Callable[[str], bool]
    show_hidden: str
    typed: bool = True


def _nodes(node: Node) -> Found:
    return [(name, []) for name in node_names(node, hidden=True)]


def lifecycle_nodes(node: Node) -> list[str]:
    """Return the full names of the nodes that have a lifecycle."""
    served = {
        name.removesuffix(LIFECYCLE_SERVICE)
        for name, types in node.get_service_names_and_types()
        if name.endswith(LIFECYCLE_SERVICE) and LIFECYCLE_TYPE in types
    }
    return [name for name in node_names(node, hidden=True) if name in served]


def _node_is_hidden(name: str) -> bool:
    return name.rpartition('/')[2].startswith('_')


KINDS = {
    'action': Kind(
        one='action',
        found=lambda node: sorted(get_action_names_and_types(node)),
        hidden=lambda name: False,
        show_hidden='--include-hidden-actions',
    ),
    'lifecycle': Kind(
        one='node',
        found=lambda node: [(name, []) for name in lifecycle_nodes(node)],
        hidden=_node_is_hidden,
        show_hidden='--include-hidden-nodes',
        typed=False,
    ),
    'node': Kind(
        one='node',
        found=_nodes,
        hidden=_node_is_hidden,
        show_hidden='--include-hidden-nodes',
        typed=False,
    ),
    'service': Kind(
        one='service',
        found=lambda node: sorted(node.get_service_names_and_types()),
        hidden=is_hidden,
        show_hidden='--include-hidden-services',
    ),
    'topic': Kind(
        one='topic',
        found=lambda node: sorted(node.get_topic_names_and_types()),
        hidden=is_hidden,
        show_hidden='--include-hidden-topics',
    ),
}
