# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Drivers let persons pass who walk over the street away from crosswalks.

SUMO's drivers look out for persons on crossings only. Here they brake before somebody who is, or
will be, on the stretch that they drive on, as far as they can; who only stands at the kerb is not
waited for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import libsumo

from aurora_core.geometry.frames import sumo_angle_to_heading
from aurora_sumo_bridge.driver import Driver
from aurora_sumo_bridge.free_walk import FreeWalk
from aurora_sumo_bridge.polyline import Point

# They stop so far before the way of the person (m), and brake so hard for that (m/s^2).
_STOPS_BEFORE_M = 3.0
_BRAKES_MPS2 = 3.0
# Nobody drives nearer past a person who walks (m).
_BESIDE_M = 1.0
# Who is past so much earlier than the person comes drives on (s).
_EARLIER_S = 1.5


@dataclass(frozen=True, slots=True, kw_only=True)
class _Front:
    """A vehicle's front: place (m, ENU), unit heading, speed, and the size of its box."""

    place: Point
    heading: tuple[float, float]
    speed_mps: float
    length_m: float
    width_m: float


class StreetWatch:
    """Who of some drivers brakes for persons.

    Args:
        drivers: Row, vehicle id, driver, length and width of the box (m).
        walks: Of the persons who cross freely.
    """

    def __init__(
        self,
        drivers: Iterable[tuple[int, str, Driver, float, float]],
        walks: Iterable[FreeWalk],
    ) -> None:
        self._walks = tuple(walks)
        self._drivers = tuple(drivers) if self._walks else ()

    def step(self, is_present: Callable[[int], bool]) -> None:
        """Let the drivers brake, or drive on, whose rows are still present."""
        walking = [walk for walk in self._walks if walk.speed_mps > 0.0]
        for row, vehicle, driver, length_m, width_m in self._drivers:
            if not is_present(row):
                continue
            front = _front(vehicle, length_m, width_m)
            caps = [cap for walk in walking if (cap := _cap_mps(front, walk)) is not None]
            driver.look_out(front.speed_mps, min(caps, default=None))


def _front(vehicle: str, length_m: float, width_m: float) -> _Front:
    x, y = libsumo.vehicle.getPosition(vehicle)
    return _Front(
        place=(x, y),
        heading=sumo_angle_to_heading(libsumo.vehicle.getAngle(vehicle)),
        speed_mps=float(libsumo.vehicle.getSpeed(vehicle)),
        length_m=length_m,
        width_m=width_m,
    )


def _cap_mps(front: _Front, walk: FreeWalk) -> float | None:
    """Return how fast a vehicle may be before the rest of a walk, None where it need not care."""
    half_m = 0.5 * front.width_m + _BESIDE_M
    here, goal = (_seen(front, point) for point in walk.rest)
    if max(here[1], goal[1]) < -half_m or min(here[1], goal[1]) > half_m:
        return None
    # Where the way comes onto the stretch of the vehicle, and what the person has to go till then.
    outside_m = max(0.0, abs(here[1]) - half_m)
    aside_m = abs(goal[1] - here[1])
    share = outside_m / aside_m if aside_m > 0.0 else 0.0
    along_m = here[0] + share * (goal[0] - here[0])
    if along_m <= 0.0:
        return None  # it is past
    way_m = share * math.sqrt((goal[0] - here[0]) ** 2 + aside_m * aside_m)
    clears_m = along_m + front.length_m
    if front.speed_mps * (way_m / walk.speed_mps - _EARLIER_S) > clears_m:
        return None
    return math.sqrt(2.0 * _BRAKES_MPS2 * max(0.0, along_m - _STOPS_BEFORE_M))


def _seen(front: _Front, point: Point) -> tuple[float, float]:
    """Return how far ahead of a vehicle's front, and left of its middle, a point is (m)."""
    dx, dy = point[0] - front.place[0], point[1] - front.place[1]
    hx, hy = front.heading
    return dx * hx + dy * hy, dy * hx - dx * hy
