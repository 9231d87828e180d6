# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a driver is free to choose its speed: on its way, and no leader or junction near.

Red lights stand at junctions; what is said of junctions covers them.
"""

from __future__ import annotations

from math import inf

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.world import SurfaceKind
from aurora_core.quantities import motion
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.routes import along_route
from aurora_core.quantities.ticks import first_tick
from aurora_core.quantities.view import Body, RunView, Series

BoolArray = npt.NDArray[np.bool_]

# A person on the road is in the way this far off the route of a vehicle, on its street (m).
_STREET_M = 12.0

# Who has caught up is nearer than so many times the gap that counts as tailgating.
_CLOSED = 2.0


def caught_up_m(
    speed_mps: float, slow_mps: float, tailgate_gap_s: float, brake_mps2: float
) -> float:
    """Return how near to a slower one somebody has caught up with it, metres.

    Nearer than that it would have to brake, or tailgates it soon.

    Args:
        speed_mps: Of who comes up behind.
        slow_mps: Of who is ahead.
        tailgate_gap_s: Time gap that counts as tailgating.
        brake_mps2: Deceleration that counts as braking.
    """
    brakes_m = (speed_mps * speed_mps - slow_mps * slow_mps) / (2.0 * brake_mps2)
    return max(_CLOSED * tailgate_gap_s * speed_mps, tailgate_gap_s * speed_mps + brakes_m)


def free_of_junctions(view: RunView, body: Body, within_m: float) -> BoolArray:
    """Return where no junction, that is no end of a lane, is nearer than `within_m`, (T,)."""
    ends = {tuple(lane.points[k].tolist()) for lane in view.world.lanes for k in (0, -1)}

    def compute(part: RunView) -> Series:
        point = part.reference(body.body_id)
        free = np.ones(part.ticks, dtype=np.bool_)
        for x, y in sorted(ends):
            free &= distance_2d(point[:, 0] - x, point[:, 1] - y) > within_m
        return (free,)

    free: BoolArray = view.series(('junctions', body.body_id, str(within_m)), compute)[0]
    return free


def free_of_leaders(
    view: RunView,
    body: Body,
    within_m: float,
    offset_m: float,
    besides: tuple[str, ...] = (),
    below_mps: float = inf,
) -> BoolArray:
    """Return where nobody is ahead on the route with a gap of at most `within_m`, (T,).

    That is a vehicle in the way, or a person anywhere on the carriageway.

    Args:
        view: The run.
        body: The driver.
        within_m: Bumper to bumper.
        offset_m: How far from the route a vehicle may be to be in the way.
        besides: Who is in nobody's way.
        below_mps: Nor is who drives as fast as that.
    """
    free = np.ones(view.ticks, dtype=np.bool_)
    for other in view.agents:
        if other.body_id in (body.body_id, *besides):
            continue
        along = along_route(view, body, other)
        leads = (along.lead_m > 0.0) & (along.gap_m <= within_m)
        if other.entry.is_person:
            driving = view.geometry.surfaces(SurfaceKind.DRIVING)
            leads &= along.offset_m <= _STREET_M
            leads[leads] = driving.contains(view.reference(other.body_id)[leads, :2])
        else:
            leads &= along.offset_m <= offset_m
        if below_mps < inf:
            leads &= motion.speed(view, other) < below_mps
        free &= ~(leads & view.present(other.body_id))
    return free


def under_way(
    view: RunView, body: Body, moving_mps: float, way_m: float, settled: BoolArray
) -> BoolArray:
    """Return where a body has covered `way_m` since it first moved, or has settled before, (T,).

    Args:
        view: The run.
        body: The driver.
        moving_mps: Speed that counts as moving.
        way_m: Way that it may need to reach its speed.
        settled: (T,) where it has reached it.
    """
    moved = first_tick(motion.speed(view, body) >= moving_mps)
    if moved is None:
        return np.zeros(view.ticks, dtype=np.bool_)
    way = motion.travelled(view, body)
    started: BoolArray = way - way[moved] > way_m
    started[1:] |= np.logical_or.accumulate(settled)[:-1]
    return started
