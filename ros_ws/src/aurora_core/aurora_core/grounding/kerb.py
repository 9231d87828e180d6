# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where one stands who is parked at the kerb."""

from __future__ import annotations

from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.net_types import Lane
from aurora_core.ports.simulators import kerb_offset_m

Pose = tuple[float, float, float, float]


def parked_pose(pose: Pose, lane: Lane, record: AgentTypeRecord) -> Pose:
    """Return where a vehicle is parked that would stand at a pose of a lane: right of it.

    Args:
        pose: x, y (m) and unit heading on the lane.
        lane: The lane.
        record: Size of the vehicle.
    """
    x, y, hx, hy = pose
    aside_m = kerb_offset_m(lane.width_m, record.width_m)
    return x + aside_m * hy, y - aside_m * hx, hx, hy
