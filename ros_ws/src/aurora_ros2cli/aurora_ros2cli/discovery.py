# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Wait until a node that has just started knows the graph.

ros2cli asks a daemon that has been looking for long; here every command looks for itself. How many
participants there are is known from the ports that they hold, so nothing has to be guessed: the
wait ends soon after the last one was found, however busy the machine is.

Source: OMG DDSI-RTPS 2.5, section 9.6.2.3: participant i of domain d holds the ports
7400 + 250 d + 10 + 2 i (discovery) and the next one (data).
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path

from rclpy.node import Node

from aurora_ros2cli.errors import CliError

# Endpoints of a participant come in several packets after it was found.
QUIET_S = 0.2
# The same where some participant has no node (yet).
QUIET_UNSURE_S = 1.0
# Where the ports cannot be read (another system, other ports): as long as nobody has been seen.
ALONE_S = 2.0
# A participant that holds ports and never answers (a stopped process) ends the wait.
MOST_S = 5.0
# On a busy machine everything takes longer, as much as there are processes for each processor.
_PATIENCE_MOST = 4.0
_POLL_S = 0.02

_LAST_DOMAIN = 232
_PORTS_BASE = 7400
_PORTS_PER_DOMAIN = 250
_FIRST_UNICAST = 10
_SOCKETS = Path('/proc/net/udp')
# Every participant of the ROS middleware publishes its nodes here, without the usual prefix.
_NODES_TOPIC = 'ros_discovery_info'
_GUID_PREFIX_BYTES = 12


def look_around(
    node: Node, *, least_s: float = 0.0, found: Callable[[], bool] | None = None
) -> None:
    """Wait until a node knows every node, topic and service of the graph.

    Args:
        node: The node that has just started.
        least_s: Look for this long at least.
        found: Ends the wait early, once what is looked for is there.
    """
    domain = domain_id()
    start_s = changed_s = time.monotonic()
    alone = seen = _view(node)
    patience = _patience()
    while True:
        if found is not None and found():
            return
        now_s = time.monotonic()
        view = _view(node)
        if view != seen:
            seen, changed_s = view, now_s
        passed_s = now_s - start_s
        if passed_s >= max(MOST_S * patience, least_s):
            return
        expected = participants_here(domain)
        quiet_s = (now_s - changed_s) / patience
        if passed_s >= least_s and enough(expected, seen, passed_s, quiet_s, seen == alone):
            return
        time.sleep(_POLL_S)


def domain_id() -> int:
    """Return the ROS domain of this process.

    Raises:
        CliError: If the environment names none.
    """
    text = os.environ.get('ROS_DOMAIN_ID') or '0'
    if not text.isdecimal() or int(text) > _LAST_DOMAIN:
        raise CliError(
            f"ROS_DOMAIN_ID is '{text}': expected a whole number from 0 to {_LAST_DOMAIN}"
        )
    return int(text)


def enough(
    expected: int | None, view: tuple[int, ...], passed_s: float, quiet_s: float, alone: bool
) -> bool:
    """Whether the graph can be taken as known.

    Args:
        expected: Participants on this machine, where that is known.
        view: Participants and nodes that were found, and more.
        passed_s: Time since the start (s).
        quiet_s: Time since the view last changed (s), less on a busy machine.
        alone: Whether the view is still what it was at the start.
    """
    participants, nodes = view[:2]
    if expected is None:
        return quiet_s >= QUIET_UNSURE_S and (passed_s >= ALONE_S or not alone)
    if participants < expected:
        return False
    if expected == 1 and participants == 1:
        return True  # nobody else has a port
    return quiet_s >= (QUIET_S if nodes >= participants else QUIET_UNSURE_S)


def _patience() -> float:
    """Return by how much longer than on an idle machine things take."""
    try:
        waiting = os.getloadavg()[0]
    except OSError:
        return 1.0
    return min(max(waiting / (os.cpu_count() or 1), 1.0), _PATIENCE_MOST)


def _view(node: Node) -> tuple[int, ...]:
    """Return participants, nodes, topics and services, endpoints: as counts, which only grow."""
    # Endpoints reach us in packets of their own: a topic that we publish too is known before them.
    writers = node.get_publishers_info_by_topic(_NODES_TOPIC, no_mangle=True)
    topics = node.get_topic_names_and_types(no_demangle=True)
    return (
        len({bytes(writer.endpoint_gid[:_GUID_PREFIX_BYTES]) for writer in writers}),
        len(node.get_node_names_and_namespaces()),
        len(topics),
        sum(
            len(node.get_publishers_info_by_topic(name, no_mangle=True))
            + len(node.get_subscriptions_info_by_topic(name, no_mangle=True))
            for name, _ in topics
        ),
    )


def participants_here(domain: int, sockets: Path = _SOCKETS) -> int | None:
    """Return how many participants of a domain hold ports on this machine, the own one included.

    Args:
        domain: ROS domain id.
        sockets: The kernel's table of UDP sockets.

    Returns:
        Their number, or None where it cannot be told.
    """
    try:
        lines = sockets.read_text(encoding='ascii').splitlines()[1:]
    except OSError:
        return None
    first = _PORTS_BASE + _PORTS_PER_DOMAIN * domain + _FIRST_UNICAST
    last = first + _PORTS_PER_DOMAIN - _FIRST_UNICAST
    ports = {int(line.split()[1].rpartition(':')[2], 16) for line in lines}
    # Both ports of the pair: a MAVLink port may lie in the same block.
    count = sum(port in ports and port + 1 in ports for port in range(first, last, 2))
    # The caller is a participant: where even that is not seen, other ports are in use.
    return count or None
