# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a vehicle can change lane, when it begins to, and when it is on the other lane.

The executor asks of one tick, the monitor of a whole run; both ask here.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.world import WorldModel
from aurora_core.quantities.lanes import (
    NO_LANE,
    LaneArray,
    edge_of,
    lane_before,
    lane_change_ticks,
    lane_of,
    lanes_of_rows,
    left_of_lane_m,
    off_lane_m,
)
from aurora_core.quantities.view import Body, RunView
from aurora_core.spec.vocabulary import LaneSide
from aurora_core.trace.layout import GroundColumn

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# Time that a driver takes to get from the middle of a lane to that of the next one (s).
LANE_CHANGE_S = 3.0

# So much driving has to be left of a street for it; long vehicles take longer to be straight (s).
ROOM_S = 5.0

# Nearer than this to its middle a vehicle is in the middle of a lane (m).
CENTRED_M = 0.35

# Speed away from the middle of its lane with which a vehicle leaves that (m/s).
_SIDEWAYS_MPS = 0.3


# Lanes are counted from the right in their direction of travel, the left lane first here.
_STEPS = {LaneSide.LEFT: 1, LaneSide.RIGHT: -1}


def ids_beside(lane_id: str, side: LaneSide | None = None) -> tuple[str, ...]:
    """Return the ids that lanes next to a lane have if there are any, the left one first."""
    edge, _, place = lane_id.rpartition('_')
    steps = _STEPS.values() if side is None else (_STEPS[side],)
    return tuple(f'{edge}_{int(place) + step}' for step in steps)


def lanes_beside(world: WorldModel, lane: int, side: LaneSide | None = None) -> tuple[int, ...]:
    """Return the indices of the lanes next to a lane on its street, the left one first."""
    ids = {other.lane_id: index for index, other in enumerate(world.lanes)}
    beside = ids_beside(world.lanes[lane].lane_id, side)
    return tuple(ids[lane_id] for lane_id in beside if lane_id in ids)


def is_to_side(world: WorldModel, was: int, now: int, side: LaneSide | None) -> bool:
    """Tell whether a change from one lane of a street to another one is to a side (None: any)."""
    places = (int(world.lanes[k].lane_id.rpartition('_')[2]) for k in (was, now))
    before, after = places
    return side is None or (after - before) * _STEPS[side] > 0


def can_change(
    world: WorldModel, rows: FloatArray, least_mps: float, side: LaneSide | None = None
) -> BoolArray:
    """Tell where a vehicle can change lane, (n,).

    It drives on a street with another lane beside its own, which goes on for `ROOM_S`.

    Args:
        world: With the lanes.
        rows: (n, GROUND_WIDTH) states of the vehicle.
        least_mps: Speed that counts as driving.
        side: Where the other lane has to be; None: on any side.
    """
    lanes = lanes_of_rows(world, rows)
    can = np.zeros(len(rows), dtype=np.bool_)
    for lane in np.unique(lanes[lanes != NO_LANE]).tolist():
        if not lanes_beside(world, lane, side):
            continue
        there = np.flatnonzero(lanes == lane)
        speed = rows[there, GroundColumn.SPEED]
        left_m = left_of_lane_m(world.lanes[lane], rows[there])
        can[there] = (left_m >= ROOM_S * speed) & (speed >= least_mps)
    return can


def change_ticks(view: RunView, lanes: LaneArray, side: LaneSide | None) -> list[int]:
    """Return the ticks at which a body is first seen on another lane, to a side (None: any).

    Args:
        view: The run.
        lanes: (T,) as `lane_of` returns it.
        side: Which changes count.
    """
    return [
        tick
        for tick in lane_change_ticks(view, lanes)
        if is_to_side(view.world, lane_before(lanes, tick), int(lanes[tick]), side)
    ]


def change_begins(
    view: RunView, body: Body, start: int, side: LaneSide | None = None
) -> int | None:
    """Return the tick at which the first change of lane after `start` begins, None without one.

    A change begins when the vehicle begins to go sideways.
    """
    lanes = lane_of(view, body)
    for tick in change_ticks(view, lanes, side):
        begins = _leaves(view, body, lanes, tick)
        if begins >= start:
            return begins
    return None


def change_is_over(
    view: RunView, body: Body, start: int, side: LaneSide | None = None
) -> int | None:
    """Return the tick at which a vehicle that changes lane after `start` is in the middle again.

    Args:
        view: The run.
        body: The vehicle.
        start: A change that began before does not count.
        side: Nor does one to another side than this (None: any).
    """
    lanes = lane_of(view, body)
    rows = view.rows(body)
    for tick in change_ticks(view, lanes, side):
        if _leaves(view, body, lanes, tick) < start:
            continue
        lane = int(lanes[tick])
        onward = np.flatnonzero(lanes[tick:] != lane)
        stop = tick + int(onward[0]) if len(onward) else view.ticks
        off_m = off_lane_m(view.world.lanes[lane], rows[tick:stop])
        centred = np.flatnonzero(off_m <= CENTRED_M)
        if len(centred):
            return tick + int(centred[0])
    return None


def _leaves(view: RunView, body: Body, lanes: LaneArray, tick: int) -> int:
    """Return when a body that is on another lane at `tick` began to go sideways to that."""
    lane = lane_before(lanes, tick)
    on = np.flatnonzero((lanes[:tick] != lane) & (lanes[:tick] != NO_LANE))
    first = int(on[-1]) + 1 if len(on) else 0
    off_m = off_lane_m(view.world.lanes[lane], view.rows(body)[first : tick + 1])
    keeps = np.flatnonzero(np.diff(off_m) < _SIDEWAYS_MPS * view.dt_s)
    return first + int(keeps[-1]) + 2 if len(keeps) else first


def other_lane(world: WorldModel, was: int, now: int) -> bool:
    """Tell whether a body has got from one lane to another one of the same street."""
    if NO_LANE in (was, now) or was == now:
        return False
    return edge_of(world.lanes[was]) == edge_of(world.lanes[now])
