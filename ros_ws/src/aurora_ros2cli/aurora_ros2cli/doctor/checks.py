# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What `ros2 doctor` checks.

The machine and the environment are the affair of `aurora doctor`, whose checks are called; what
needs a node to be seen is here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from rclpy.node import Node
from rclpy.qos import QoSCompatibility, qos_check_compatible

from aurora_cli.doctor import network, versions
from aurora_cli.doctor.machine import Finding as OfTheMachine
from aurora_cli.doctor.machine import Machine
from aurora_ros2cli.graph import is_hidden
from aurora_ros2cli.packages import package_prefixes

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
    return _errors(versions.variables(Machine()))


def check_packages(_node: Node) -> list[Finding]:
    """Check that the packages of the index are there, and our messages with them."""
    findings = [
        Finding(text=f"package '{name}' has no package.xml in {prefix}")
        for name, prefix in sorted(package_prefixes().items())
        if not (prefix / 'share' / name / 'package.xml').is_file()
    ]
    return findings + _errors(versions.imports(Machine(), ['aurora_msgs.msg']))


def check_network(_node: Node) -> list[Finding]:
    """Check that the middleware keeps to this machine, and that it can talk to itself."""
    machine = Machine()
    return _errors([*network.middleware(machine), *network.loopback(machine)])


def _errors(found: Iterable[OfTheMachine]) -> list[Finding]:
    return [Finding(text=f'{one.found}: {one.fix}', error=True) for one in found]


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
