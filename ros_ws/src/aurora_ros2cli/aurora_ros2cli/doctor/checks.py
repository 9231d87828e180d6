# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What `ros2 doctor` checks."""

from __future__ import annotations

import importlib
import os
import socket
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from rclpy.node import Node
from rclpy.qos import QoSCompatibility, qos_check_compatible

from aurora_ros2cli.graph import is_hidden
from aurora_ros2cli.packages import package_prefixes, prefixes

# Everybody publishes these, nobody needs to listen.
_UNHEARD = ('/parameter_events', '/rosout')


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Something that is not as it should be.

    Attributes:
        text: What, and what to do.
        error: Whether it counts as a failure.
    """

    text: str
    error: bool = False


def check_platform(_node: Node) -> list[Finding]:
    """Check the variables of the environment."""
    findings = [
        Finding(text=f"{name} is not set: 'source ros_ws/setup.bash'", error=True)
        for name in ('ROS_DISTRO', 'AMENT_PREFIX_PATH', 'RMW_IMPLEMENTATION')
        if not os.environ.get(name)
    ]
    return findings + [
        Finding(text=f"AMENT_PREFIX_PATH names '{prefix}', which does not exist", error=True)
        for prefix in prefixes()
        if not prefix.is_dir()
    ]


def check_packages(_node: Node) -> list[Finding]:
    """Check that the packages of the index are there, and the middleware with them."""
    findings = [
        Finding(text=f"package '{name}' has no package.xml in {prefix}")
        for name, prefix in sorted(package_prefixes().items())
        if not (prefix / 'share' / name / 'package.xml').is_file()
    ]
    for module in ('rclpy', 'aurora_msgs.msg'):
        try:
            importlib.import_module(module)
        except ImportError as err:
            text = f"cannot import {module} ({err}): call 'make setup'"
            findings.append(Finding(text=text, error=True))
    return findings


def check_network(_node: Node) -> list[Finding]:
    """Check that this machine can talk to itself, which discovery needs."""
    profile = os.environ.get('FASTRTPS_DEFAULT_PROFILES_FILE')
    findings = []
    if profile and not Path(profile).is_file():
        text = f"FASTRTPS_DEFAULT_PROFILES_FILE names '{profile}', which does not exist"
        findings.append(Finding(text=text, error=True))
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
            receiver.bind(('127.0.0.1', 0))
            receiver.settimeout(1.0)
            receiver.sendto(b'doctor', receiver.getsockname())
            receiver.recv(16)
    except OSError as err:
        text = f'UDP on 127.0.0.1 does not work ({err}): is the loopback interface up?'
        findings.append(Finding(text=text, error=True))
    return findings


def check_qos(node: Node) -> list[Finding]:
    """Check that publishers and subscriptions of each topic agree."""
    return [
        Finding(text=f'{topic}: {reason}', error=compatibility == QoSCompatibility.ERROR)
        for topic, _, _, compatibility, reason in compatibilities(node)
        if compatibility != QoSCompatibility.OK
    ]


def compatibilities(node: Node) -> Iterator[tuple[str, str, str, QoSCompatibility, str]]:
    """Yield topic, publishing node, subscribing node, verdict and reason, for each pair."""
    for topic, _ in sorted(node.get_topic_names_and_types()):
        if is_hidden(topic):
            continue
        for offer in node.get_publishers_info_by_topic(topic):
            for request in node.get_subscriptions_info_by_topic(topic):
                verdict, reason = qos_check_compatible(offer.qos_profile, request.qos_profile)
                yield topic, offer.node_name, request.node_name, verdict, reason


def check_topics(node: Node) -> list[Finding]:
    """Check for topics with one side only; that is normal while a graph comes up."""
    findings = []
    for topic, _ in sorted(node.get_topic_names_and_types()):
        if topic in _UNHEARD or is_hidden(topic):
            continue
        if node.count_subscribers(topic) == 0:
            findings.append(Finding(text=f'Publisher without subscriber detected on {topic}.'))
        elif node.count_publishers(topic) == 0:
            findings.append(Finding(text=f'Subscriber without publisher detected on {topic}.'))
    return findings


CHECKS: dict[str, Callable[[Node], list[Finding]]] = {
    'platform': check_platform,
    'package': check_packages,
    'network': check_network,
    'qos': check_qos,
    'topic': check_topics,
}
