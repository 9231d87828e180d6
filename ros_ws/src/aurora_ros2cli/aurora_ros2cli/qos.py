# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Quality of service: options of the command line, and what fits the publishers of a topic."""

from __future__ import annotations

import argparse
import sys

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    InvalidQoSProfileException,
    LivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)

from aurora_ros2cli.errors import CliError

DEPTH = 10
_POLICIES = {
    'history': HistoryPolicy,
    'reliability': ReliabilityPolicy,
    'durability': DurabilityPolicy,
    'liveliness': LivelinessPolicy,
}


def add_qos_arguments(parser: argparse.ArgumentParser, does: str, preset: str) -> None:
    """Add the options that name a profile.

    Args:
        parser: The parser of a verb.
        does: What the profile is for, e.g. `subscribe`.
        preset: Name of the profile where nothing else is known.
    """
    parser.add_argument(
        '--qos-profile',
        choices=QoSPresetProfiles.short_keys(),
        help=f'Quality of service preset profile to {does} with (default: {preset})',
    )
    parser.add_argument(
        '--qos-depth',
        metavar='N',
        type=int,
        help=f'Queue size setting to {does} with (overrides depth value of --qos-profile option)',
    )
    for name, policy in _POLICIES.items():
        parser.add_argument(
            f'--qos-{name}',
            choices=policy.short_keys(),
            help=f'Quality of service {name} setting to {does} with '
            f'(overrides {name} value of --qos-profile option)',
        )
    parser.add_argument(
        '--qos-liveliness-lease-duration-seconds',
        type=float,
        help=f'Quality of service liveliness lease duration setting to {does} with '
        '(overrides the value of --qos-profile option)',
    )


def named_profile(arguments: argparse.Namespace, preset: str) -> QoSProfile | None:
    """Return the profile that the options name, or None where none was given.

    Raises:
        CliError: If the options contradict each other.
    """
    lease_s = arguments.qos_liveliness_lease_duration_seconds
    given = [arguments.qos_profile, arguments.qos_depth, lease_s]
    if all(value is None for value in given) and not any(
        getattr(arguments, f'qos_{name}') for name in _POLICIES
    ):
        return None
    return _profile(arguments, preset)


def profile_or_preset(arguments: argparse.Namespace, preset: str) -> QoSProfile:
    """Return the profile that the options name; where none was given the preset.

    Raises:
        CliError: If the options contradict each other.
    """
    return _profile(arguments, preset)


def _profile(arguments: argparse.Namespace, preset: str) -> QoSProfile:
    base = QoSPresetProfiles.get_from_short_key(arguments.qos_profile or preset)
    chosen = {
        name: policy.get_from_short_key(getattr(arguments, f'qos_{name}'))
        if getattr(arguments, f'qos_{name}')
        else getattr(base, name)
        for name, policy in _POLICIES.items()
    }
    depth = base.depth if arguments.qos_depth is None else arguments.qos_depth
    lease_s = arguments.qos_liveliness_lease_duration_seconds
    if lease_s is not None:
        if lease_s < 0:
            raise CliError('liveliness lease duration cannot be negative')
        chosen['liveliness_lease_duration'] = Duration(seconds=lease_s)
    try:
        return QoSProfile(depth=depth, **chosen)
    except (InvalidQoSProfileException, ValueError) as err:
        raise CliError(str(err)) from err


def matching_profile(node: Node, topic: str, *, depth: int = DEPTH) -> QoSProfile:
    """Ask for no more than every publisher offers, so that all of them are heard.

    Args:
        node: A node that knows the graph.
        topic: Full name.
        depth: Of the own queue.
    """
    offered = [info.qos_profile for info in node.get_publishers_info_by_topic(topic)]
    reliable = [qos.reliability == ReliabilityPolicy.RELIABLE for qos in offered]
    latched = [qos.durability == DurabilityPolicy.TRANSIENT_LOCAL for qos in offered]
    for flags, policy, strict, lax in (
        (reliable, 'Reliability', 'RELIABLE', 'BEST_EFFORT'),
        (latched, 'Durability', 'TRANSIENT_LOCAL', 'VOLATILE'),
    ):
        if any(flags) and not all(flags):
            kind = f'QoS{policy}Policy'
            sys.stderr.write(
                f'Some, but not all, publishers are offering {kind}.{strict}. Falling back to '
                f'{kind}.{lax} as it will connect to all publishers\n'
            )
    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE
        if reliable and all(reliable)
        else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if latched and all(latched)
        else DurabilityPolicy.VOLATILE,
    )
