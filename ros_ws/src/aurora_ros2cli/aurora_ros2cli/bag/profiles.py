# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""QoS profiles to and from the form in which rosbag2 stores them (metadata version 9)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)

_NS = 1_000_000_000
# An infinite time, as the middleware and the bags have it.
_FOREVER = (9_223_372_036, 854_775_807)
DEPTH = 1000


def stored(profile: QoSProfile) -> dict[str, Any]:
    """Return what `offered_qos_profiles` holds of a publisher."""
    return {
        'history': profile.history.name.lower(),
        'depth': profile.depth,
        'reliability': profile.reliability.name.lower(),
        'durability': profile.durability.name.lower(),
        'deadline': _time(profile.deadline),
        'lifespan': _time(profile.lifespan),
        'liveliness': profile.liveliness.name.lower(),
        'liveliness_lease_duration': _time(profile.liveliness_lease_duration),
        'avoid_ros_namespace_conventions': profile.avoid_ros_namespace_conventions,
    }


def _time(duration: Duration) -> dict[str, int]:
    sec, nsec = divmod(duration.nanoseconds, _NS)
    return {'sec': sec, 'nsec': nsec}


def to_offer(recorded: Sequence[Any]) -> QoSProfile:
    """Return the profile of a publisher that plays a topic back.

    Args:
        recorded: Profiles of the recorded publishers (`rosbags.interfaces.Qos`). Where they
            differ, the least strict values win: they were compatible with every subscription.
    """
    reliable = all(qos.reliability.name != 'BEST_EFFORT' for qos in recorded)
    latched = bool(recorded) and all(qos.durability.name == 'TRANSIENT_LOCAL' for qos in recorded)
    keep_all = bool(recorded) and all(qos.history.name == 'KEEP_ALL' for qos in recorded)
    depths = [qos.depth for qos in recorded if qos.history.name == 'KEEP_LAST' and qos.depth]
    profile = QoSProfile(
        history=HistoryPolicy.KEEP_ALL if keep_all else HistoryPolicy.KEEP_LAST,
        depth=max(depths, default=DEPTH) if latched else DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
    for name in ('deadline', 'lifespan', 'liveliness_lease_duration'):
        values = {getattr(qos, name)[:2] for qos in recorded}
        if len(values) == 1 and (value := values.pop()) not in (_FOREVER, (0, 0)):
            setattr(profile, name, Duration(seconds=value[0], nanoseconds=value[1]))
    kinds = {qos.liveliness.name for qos in recorded}
    if kinds == {'MANUAL_BY_TOPIC'}:
        profile.liveliness = LivelinessPolicy.MANUAL_BY_TOPIC
    return profile
