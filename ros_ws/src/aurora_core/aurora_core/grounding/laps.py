# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes that are flown again and again, for as long as a request says."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import ceil

from aurora_core.geometry.kernel import norm2
from aurora_core.knowledge.settings import Settings
from aurora_core.mission.setpoint import FlightSettings, RouteReference
from aurora_core.quantities.waypoints import Point3
from aurora_core.spec.vocabulary import Pattern

# A route is over so long before its time: from its capture the UAV comes to the first point, and
# follows its reference with some delay (s).
_EARLY_S = 4.0
# Slower than this nobody patrols (m/s).
_SLOWEST_MPS = 0.5
_SEARCH_STEPS = 16
# Legs shorter than this are not flown for themselves (m).
_SHORT_M = 1.0

# One goes round these, or to and fro.
REPEATED = frozenset({Pattern.RECTANGLE, Pattern.ORBIT, Pattern.LINE})

# A part of an orbit has so many points at least: its circle follows from them.
_ARC_POINTS = 3

# A lap of which rounding leaves so little out is a whole one (m).
_EXACT_M = 1e-6


class Laps:
    """Plans how often a route is flown.

    Args:
        settings: Reference motion and time step.
    """

    def __init__(self, settings: Settings) -> None:
        self._flight = FlightSettings(**settings.flight.model_dump())
        self._dt_s = settings.run.dt_s

    def lasting(
        self, way: Sequence[Point3], speed_mps: float, asked_s: float, *, keeps_speed: bool
    ) -> tuple[tuple[Point3, ...], float]:
        """Return a route that takes as long as asked, and the speed to fly it with.

        With a speed of its own choice the UAV flies whole laps; with a stated one the last lap
        ends where the time does. It flies one lap in any case.

        Args:
            way: One lap (x, y, z in m): closed, or a line that is flown to and fro.
            speed_mps: Stated or usual speed.
            asked_s: Time from its first point to the end, seconds.
            keeps_speed: The speed is stated.
        """
        goal_s = asked_s - _EARLY_S
        lap_s = self._time_s(way, speed_mps)
        if keeps_speed:
            laps = _repeated(way, max(1, ceil(goal_s / lap_s) + 1))
            return self._cut(laps, _length_m(way), speed_mps, goal_s), speed_mps
        count = max(1, round(goal_s / lap_s))
        while (
            count > 1 and self._time_s(_repeated(way, count), self._flight.speed_max_mps) > goal_s
        ):
            count -= 1
        laps = _repeated(way, count)
        return laps, self._speed_mps(laps, goal_s)

    def part(self, way: Sequence[Point3], speed_mps: float, asked_s: float) -> tuple[Point3, ...]:
        """Return as many steps of an orbit as there is time for.

        Args:
            way: One lap (x, y, z in m), closed.
            speed_mps: To fly it with.
            asked_s: Time from its first point to the end, seconds.
        """
        least, most = _ARC_POINTS, len(way) - 1
        while least < most:
            middle = (least + most + 1) // 2
            in_time = self._time_s(way[:middle], speed_mps) <= asked_s - _EARLY_S
            least, most = (middle, most) if in_time else (least, middle - 1)
        return tuple(way[:least])

    def turned(
        self,
        way: Sequence[Point3],
        turns: float,
        speed_mps: float,
        asked_s: float | None,
        *,
        keeps_speed: bool,
    ) -> tuple[tuple[Point3, ...], float]:
        """Return a closed route that goes round as often as asked, and the speed to fly it with.

        Args:
            way: One lap (x, y, z in m), closed.
            turns: At least 1; the last lap may be a part of one.
            speed_mps: Stated or usual speed.
            asked_s: Time from its first point to the end, seconds; None: any.
            keeps_speed: The speed is stated.
        """
        laps = _up_to(_repeated(way, ceil(turns)), turns * _length_m(way))
        if asked_s is None or keeps_speed:
            return laps, speed_mps
        return laps, self._speed_mps(laps, asked_s - _EARLY_S)

    def _speed_mps(self, way: Sequence[Point3], goal_s: float) -> float:
        """Return the slowest speed with which a route is over in time, at most the fastest."""
        slow, fast = _SLOWEST_MPS, self._flight.speed_max_mps
        for _ in range(_SEARCH_STEPS):
            middle = (slow + fast) / 2.0
            if self._time_s(way, middle) > goal_s:
                slow = middle
            else:
                fast = middle
        return fast

    def _cut(
        self, laps: tuple[Point3, ...], lap_m: float, speed_mps: float, goal_s: float
    ) -> tuple[Point3, ...]:
        """Return the part of some laps for which there is time, at least one lap."""
        if self._time_s(laps, speed_mps) <= goal_s:
            return laps
        least, most = lap_m, _length_m(laps)
        for _ in range(_SEARCH_STEPS):
            middle = (least + most) / 2.0
            if self._time_s(_up_to(laps, middle), speed_mps) <= goal_s:
                least = middle
            else:
                most = middle
        return _up_to(laps, least)

    def _time_s(self, way: Sequence[Point3], speed_mps: float) -> float:
        reference = RouteReference(way, speed_mps)
        ticks = 0
        while not reference.done:
            reference.step(self._flight, self._dt_s)
            ticks += 1
        return ticks * self._dt_s


def _repeated(way: Sequence[Point3], count: int) -> tuple[Point3, ...]:
    """Return laps of a closed route, or ways to and fro on an open one."""
    closed = way[0] == way[-1]
    found = list(way)
    for k in range(1, count):
        lap = way if closed or k % 2 == 0 else way[::-1]
        found += lap[1:]
    return tuple(found)


def _up_to(way: Sequence[Point3], length_m: float) -> tuple[Point3, ...]:
    """Return the first part of a route."""
    found, left_m = [way[0]], length_m
    for a, b in pairwise(way):
        leg_m = norm2(b[0] - a[0], b[1] - a[1])
        if left_m < leg_m - _EXACT_M:
            if left_m > _SHORT_M:
                share = left_m / leg_m
                found.append((a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2]))
            break
        found.append(b)
        left_m -= leg_m
    return tuple(found)


def _length_m(way: Sequence[Point3]) -> float:
    return sum(norm2(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(way))
