# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Time headway and time to collision of a vehicle behind another one in its lane.

Headway: bumper gap along the route of the one behind, divided by its own speed (as in time gaps of
ISO 15622). Time to collision: the same gap divided by the speed with which it closes.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import numpy as np
import numpy.typing as npt

from aurora_core.quantities import motion
from aurora_core.quantities.routes import Along, along_route, route_of
from aurora_core.quantities.view import RunView
from aurora_core.spec.scenario import Event, HeadwayTrigger
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Measure = Literal['headway', 'ttc']

# What a trigger of two in one lane asks for.
MEASURES: dict[str, Measure] = {'headway_below': 'headway', 'ttc_below': 'ttc'}

# Of who stands, follows nobody or does not close in (s).
NONE_S = 100.0
# Who is slower stands (m/s).
_MOVING_MPS = 1.0
# Two whose ways are farther apart across are in two lanes: half the width of a lane (m).
_LANE_M = 1.75

_X, _Y, _HX, _HY = (int(GroundColumn[name]) for name in ('X', 'Y', 'HEADING_X', 'HEADING_Y'))
_SPEED, _PRESENT = int(GroundColumn.SPEED), int(GroundColumn.PRESENT)


def pair_series(view: RunView, measure: Measure, follower: str, leader: str) -> FloatArray:
    """Return headway or time to collision of two ground agents at every tick, (T,) s."""
    one, other = view.body(follower), view.body(leader)
    along = along_route(view, one, other)
    across_m = np.abs(along.offset_m - along.own_offset_m)
    here = view.present(follower) & view.present(leader)
    return _seconds(measure, along.gap_m, across_m, here, view.rows(one), view.rows(other))


def is_moving(view: RunView, follower: str) -> BoolArray:
    """Return when somebody is fast enough to have a headway, (T,)."""
    return motion.speed(view, view.body(follower)) > _MOVING_MPS


def _seconds(
    measure: Measure,
    gap_m: FloatArray,
    across_m: FloatArray,
    here: BoolArray,
    own: FloatArray,
    other: FloatArray,
) -> FloatArray:
    """Return the seconds that a gap stands for; rows of states (T, GROUND_WIDTH)."""
    rate = own[:, _SPEED]
    if measure == 'ttc':
        same_way = own[:, _HX] * other[:, _HX] + own[:, _HY] * other[:, _HY]
        rate = rate - other[:, _SPEED] * same_way
    counts = here & (gap_m > 0.0) & (across_m <= _LANE_M)
    counts &= rate > (_MOVING_MPS if measure == 'headway' else 0.0)
    return np.where(
        counts, np.minimum(np.maximum(gap_m, 0.0) / np.where(counts, rate, 1.0), NONE_S), NONE_S
    )


class PairWatch:
    """The same, tick after tick.

    Args:
        roster: Row order.
        measure: Headway or time to collision.
        follower: Id.
        leader: Id.
    """

    def __init__(self, roster: Roster, measure: Measure, follower: str, leader: str) -> None:
        self._measure = measure
        self._rows = roster.agent_index(follower), roster.agent_index(leader)
        self._entries = [None if row is None else roster.agents[row] for row in self._rows]
        self._along: Along | None = None

    def step(self, ground: FloatArray) -> float:
        """Return the seconds at a tick; ground: (N, GROUND_WIDTH)."""
        (row, index), (one, other) = self._rows, self._entries
        if row is None or index is None or one is None or other is None:
            return NONE_S
        own, lead = ground[row : row + 1], ground[index : index + 1]
        new = None
        if self._along is None:
            self._along, new = Along(), route_of(one, own[0])
        ahead_m, offset_m, own_offset_m = self._along.follow(
            new, own[:, : _Y + 1], lead[:, : _Y + 1]
        )
        gap_m = ahead_m - (one.length_m + other.length_m) / 2.0
        here = (own[:, _PRESENT] > 0.5) & (lead[:, _PRESENT] > 0.5)
        across_m = np.abs(offset_m - own_offset_m)
        return float(_seconds(self._measure, gap_m, across_m, here, own, lead)[0])


def pair_watches(roster: Roster, events: Iterable[Event]) -> dict[str, PairWatch]:
    """Return who has to be watched for the triggers of events, by event."""
    return {
        event.id: PairWatch(roster, MEASURES[trigger.on], trigger.a, trigger.b)
        for event in events
        if isinstance(trigger := event.trigger, HeadwayTrigger)
    }
