# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a person has crossed the way of a vehicle, and which of the two came first.

A person is on a side of a way while it is clear of the lane of who drives there; it has crossed
once it is clear of it on the other side.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import copysign

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.polyline import Polyline
from aurora_core.quantities.routes import planned_route
from aurora_core.quantities.view import Body, RunView, Series

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# From the middle of its way a lane is left at this distance: half a lane and half a person (m).
CLEAR_M = 2.0

# Of its own way a vehicle has come at most so far in one tick, and a person who is to be let pass
# is looked for so far behind and ahead of it (m).
_STEP_M = 20.0
_BEHIND_M = 20.0
_AHEAD_M = 180.0
_EDGE_M = 0.01


@dataclass(slots=True)
class WayCrossing:
    """A person and the way of a vehicle, tick after tick.

    Attributes:
        line: Way of the vehicle's reference point.
        side: On which side of the way the person was first, 0.0 before it was on any.
        beyond_m: How far the person is clear of the way on the other side; negative before.
        crossed: It has been clear there.
    """

    line: Polyline
    side: float = 0.0
    beyond_m: float = -CLEAR_M
    crossed: bool = False
    _arc_m: float | None = field(default=None)

    def step(self, own: tuple[float, float], other: tuple[float, float]) -> float:
        """Take the places (x, y in m) of a tick, return how far ahead the person is (m)."""
        arc_m, _ = self.line.project(*own, near_s=self._arc_m, window_m=self._window())
        self._arc_m = arc_m
        middle_m = arc_m + (_AHEAD_M - _BEHIND_M) / 2.0
        window_m = (_AHEAD_M + _BEHIND_M) / 2.0
        at_m, aside_m = self.line.project(*other, near_s=middle_m, window_m=window_m)
        if abs(at_m - middle_m) >= window_m - _EDGE_M:
            return at_m - arc_m  # somewhere else: how far aside that is says nothing
        if self.side == 0.0 and abs(aside_m) >= CLEAR_M:
            self.side = copysign(1.0, aside_m)
        if self.side != 0.0:
            self.beyond_m = -self.side * aside_m - CLEAR_M
            self.crossed = self.crossed or self.beyond_m >= 0.0
        return at_m - arc_m

    def _window(self) -> float | None:
        return None if self._arc_m is None else _STEP_M


def crossing_series(
    view: RunView, vehicle: Body, person: Body
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Return how far ahead a person is, how far beyond the way, and whether it has crossed it.

    All (T,): metres between reference points along the way, metres, and yes or no.
    """
    key = ('way_crossing', vehicle.body_id, person.body_id)
    lead, beyond, crossed = view.series(key, _Parts(vehicle, person))
    return lead, beyond, crossed


class _Parts:
    """The series of two bodies, part after part of a run."""

    def __init__(self, vehicle: Body, person: Body) -> None:
        self._vehicle = vehicle
        self._person = person
        self._way: WayCrossing | None = None

    def __call__(self, part: RunView) -> Series:
        way = self._way
        if way is None:
            way = self._way = WayCrossing(line=planned_route(part, self._vehicle))
        lead, beyond = np.zeros(part.ticks), np.zeros(part.ticks)
        crossed = np.zeros(part.ticks, dtype=np.bool_)
        own = part.reference(self._vehicle.body_id)[:, :2].tolist()
        other = part.reference(self._person.body_id)[:, :2].tolist()
        there = part.present(self._vehicle.body_id) & part.present(self._person.body_id)
        for tick, both in enumerate(there.tolist()):
            if both:
                lead[tick] = way.step(tuple(own[tick]), tuple(other[tick]))
            beyond[tick], crossed[tick] = way.beyond_m, way.crossed
        return lead, beyond, crossed
