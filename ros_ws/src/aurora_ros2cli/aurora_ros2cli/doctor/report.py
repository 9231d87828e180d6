# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The sections of `ros2 doctor --report`."""

from __future__ import annotations

import os
import platform
import socket
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Collection, Iterator
from pathlib import Path

from rclpy.node import Node
from rclpy.qos import QoSCompatibility
from rclpy.utilities import get_rmw_implementation_identifier

from aurora_ros2cli.doctor.checks import compatibilities
from aurora_ros2cli.output import emit
from aurora_ros2cli.packages import package_prefixes

Items = list[tuple[str, str]]


def print_report(node: Node, checks: Collection[str] | None = None) -> None:
    """Print every section.

    Args:
        node: A node that knows the graph.
        checks: Only the sections of these checks.
    """
    for title, (check, section) in SECTIONS.items():
        if checks is not None and check not in checks:
            continue
        emit(f'\n   {title}')
        for items in section(node):
            width = max((len(key) for key, _ in items), default=0)
            for key, value in items:
                emit(f'{key:<{width}} : {value}')


def _network(_node: Node) -> Iterator[Items]:
    yield [('host', socket.gethostname())]
    yield [('interface', name) for _, name in socket.if_nameindex()]


def _packages(_node: Node) -> Iterator[Items]:
    items: Items = []
    for name, prefix in sorted(package_prefixes().items()):
        items.append((name, f'installed={_version(prefix / "share" / name / "package.xml")}'))
    yield items


def _version(path: Path) -> str:
    try:
        # Written by our own build and the wheels.
        return ElementTree.parse(path).findtext('version', 'unknown').strip()  # nosec B314
    except (OSError, ElementTree.ParseError):
        return 'unknown'


def _platform(_node: Node) -> Iterator[Items]:
    yield [
        ('system', platform.system()),
        ('platform info', platform.platform()),
        ('release', platform.release()),
        ('processor', platform.processor() or platform.machine()),
        ('python', platform.python_version()),
    ]


def _qos(node: Node) -> Iterator[Items]:
    words = {QoSCompatibility.OK: 'OK', QoSCompatibility.WARNING: 'WARNING'}
    for topic, publisher, subscriber, verdict, reason in compatibilities(node):
        status = words.get(verdict, 'ERROR') + (f': {reason}' if reason else '')
        yield [
            ('topic [type]', topic),
            ('publisher node', publisher),
            ('subscriber node', subscriber),
            ('compatibility status', status),
        ]


def _middleware(_node: Node) -> Iterator[Items]:
    yield [('middleware name', get_rmw_implementation_identifier())]


def _ros(_node: Node) -> Iterator[Items]:
    yield [
        ('distribution name', os.environ.get('ROS_DISTRO', 'unknown')),
        ('distribution type', 'ros2'),
        ('command line', 'aurora_ros2cli (stand-in)'),
    ]


def _environment(_node: Node) -> Iterator[Items]:
    prefixes = ('ROS_', 'RMW_', 'AMENT_', 'FASTRTPS_', 'FASTDDS_', 'RCUTILS_')
    yield [(key, value) for key, value in sorted(os.environ.items()) if key.startswith(prefixes)]


def _services(node: Node) -> Iterator[Items]:
    for name, types in sorted(node.get_service_names_and_types()):
        yield [('service', name), ('type', ', '.join(types))]


def _topics(node: Node) -> Iterator[Items]:
    for name, types in sorted(node.get_topic_names_and_types()):
        yield [
            ('topic', f'{name} [{", ".join(types)}]'),
            ('publisher count', str(node.count_publishers(name))),
            ('subscriber count', str(node.count_subscribers(name))),
        ]


# Title → the check that it belongs to, and what fills it.
SECTIONS: dict[str, tuple[str, Callable[[Node], Iterator[Items]]]] = {
    'NETWORK CONFIGURATION': ('network', _network),
    'PACKAGE VERSIONS': ('package', _packages),
    'PLATFORM INFORMATION': ('platform', _platform),
    'QOS COMPATIBILITY LIST': ('qos', _qos),
    'RMW MIDDLEWARE': ('platform', _middleware),
    'ROS 2 INFORMATION': ('platform', _ros),
    'ROS ENVIRONMENT': ('platform', _environment),
    'SERVICE LIST': ('topic', _services),
    'TOPIC LIST': ('topic', _topics),
}
