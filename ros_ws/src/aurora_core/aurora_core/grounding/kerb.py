# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The kerb: where one is parked at it, and where a person steps off it."""

from __future__ import annotations

import numpy as np
import shapely

from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.walk_path import WalkPath
from aurora_core.ports.simulators import kerb_offset_m

Pose = tuple[float, float, float, float]

# Who waits at the kerb stands so far before the carriageway (m).
STEP_M = 0.1
# A way is looked along in such steps, from so far before the end of the sidewalk (m).
_STEP_M = 0.05
_BEFORE_END_M = 3.0


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


def steps_off_m(network: RoadNetwork, path: WalkPath) -> float | None:
    """Return where on a way over the street it gets onto the carriageway (m), None for nowhere."""
    first_m = 0.0
    if path.begins_m is None:
        first_m = max(0.0, network.lane(path.lane_id).arc_length_m - _BEFORE_END_M)
    arcs_m = np.arange(first_m, path.length_m, _STEP_M)
    points = path.positions_at(arcs_m)[:, :2]
    on = shapely.contains_xy(network.carriageway, points[:, 0], points[:, 1])
    return float(arcs_m[int(np.argmax(on))]) if on.any() else None
