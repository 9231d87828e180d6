# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places at which a stated speed could not show either, which is seen before a co-simulation.

It shows where no junction is near. Where a way has hardly such a stretch as far as its driver can
come until the end, the condition has no more samples there than where it failed for want of them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from aurora_core.judging.quantities.free_speed import FreeSpeed
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.outcomes.verdict import Reason, Verdict

# The way is looked at in steps of so much (m).
_STEP_M = 1.0
# Less than this share of what has to show at the stated speed is nowhere enough (1).
_SCARCE = 0.5


def never_shown(verdict: Verdict, after: Agsg, network: RoadNetwork) -> Iterator[str]:
    """Yield which speed a scene would show as little as the one that it is to mend.

    Args:
        verdict: Of the realisation that is to be mended.
        after: What came of an edit, grounded.
        network: Roads of the map.
    """
    empty = {r.id for r in verdict.results if r.reason is Reason.EMPTY_PHASE}
    if after.grounding is None or after.schedule is None or not empty:
        return
    horizon_s = after.schedule.horizon_s
    agents = {agent.id: agent for agent in after.grounding.agents}
    for condition in after.conditions:
        asked = condition.arguments
        driver = agents.get(condition.of[0]) if condition.of else None
        if condition.id not in empty or not isinstance(asked, FreeSpeed) or driver is None:
            continue
        speed_mps = driver.drive_speed_mps
        if not speed_mps:
            continue
        open_m = _open_way_m(driver, network, asked.free_m, horizon_s * speed_mps)
        if open_m < _SCARCE * asked.least_s * speed_mps:
            yield (
                f'{condition.id} would not show there either: {open_m:.0f} m of its way are '
                f'farther than {asked.free_m:g} m from junctions'
            )


def _open_way_m(
    driver: GroundedAgent, network: RoadNetwork, free_m: float, reach_m: float
) -> float:
    """Return how much of a way is farther than `free_m` from every end of a lane, metres."""
    corners = np.array(driver.route_xy_m)
    legs = np.hypot(*np.diff(corners, axis=0).T)
    arcs = np.concatenate(([0.0], np.cumsum(legs)))
    at = np.arange(0.0, min(reach_m, arcs[-1]), _STEP_M)
    way = np.stack([np.interp(at, arcs, corners[:, k]) for k in (0, 1)], axis=1)
    near = np.zeros(len(way), dtype=np.bool_)
    for x, y in _lane_ends(network):
        near |= np.hypot(way[:, 0] - x, way[:, 1] - y) <= free_m
    return float(np.count_nonzero(~near)) * _STEP_M


def _lane_ends(network: RoadNetwork) -> npt.NDArray[np.float64]:
    ends = {tuple(lane.polyline[k][:2]) for lane in network.lanes.values() for k in (0, -1)}
    return np.array(sorted(ends))
