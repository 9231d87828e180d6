# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parts that flights of every mode share: altitude, speed on legs, places kept away from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import (
    Judged,
    Outcome,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.flights import corners
from aurora_bench.checker.numbers import Wanted, wanted
from aurora_bench.checker.phases import Segment
from aurora_bench.checker.scene import Scene, share


@dataclass(frozen=True, slots=True, kw_only=True)
class Flight:
    """What a mission is judged on.

    Attributes:
        targets: Bodies or places that the target can mean; empty: none stated.
        until: Tick at which an event changes the flight (its end otherwise).
        climbs: An event changes its altitude.
        cut: An annotated event ends it, maybe before its stated time.
    """

    scene: Scene
    uav: str
    segment: Segment
    targets: Sequence[str]
    variation: Mapping[str, Any]
    until: int
    climbs: bool = False
    cut: bool = False

    @property
    def ticks(self) -> slice:
        """Return the ticks of the mission up to its change."""
        return slice(self.segment.start, max(self.until, self.segment.start + 1))


def is_free(flight: Flight, requirement: Mapping[str, Any]) -> bool:
    """Tell whether any height may be that of a mission: none is annotated, and it climbs."""
    return flight.climbs and requirement.get('altitude_m') is None


def level_of(flight: Flight, requirement: Mapping[str, Any]) -> tuple[float, Wanted | None]:
    """Return the altitude that the mission is about: annotated, else the median at its end."""
    asked = wanted(requirement, 'altitude_m', flight.variation, limits.ALTITUDE)
    altitude = flight.scene.altitude(flight.uav)[flight.ticks]
    # The way to where a mission is flown may lead over what stands in between.
    flown = float(np.median(altitude[3 * len(altitude) // 4 :]))
    if asked is None or asked.slack > 0.0:
        return flown, asked
    return asked.value, asked


def asked_altitude(requirement: Mapping[str, Any], variation: Mapping[str, Any]) -> Wanted | None:
    """Return the annotated altitude, which may be one between two."""
    band = requirement.get('altitude_m')
    if isinstance(band, list | tuple) and len(band) == 2:
        return Wanted(float(band[0]), float(band[0]), float(band[1]), 2.0)
    return wanted(requirement, 'altitude_m', variation, limits.ALTITUDE)


def altitude(flight: Flight, requirement: Mapping[str, Any], start: int) -> Judged:
    """Return whether the annotated altitude was kept from a tick on, for 95 % of the time."""
    height = flight.scene.altitude(flight.uav)[start : flight.ticks.stop]
    asked = asked_altitude(requirement, flight.variation)
    if asked is None:
        return holds('')
    if not len(height):
        return does_not('no sample of the altitude')
    inside = (height >= asked.low - asked.slack) & (height <= asked.high + asked.slack)
    middle = float(np.median(height))
    why = f'{share(inside):.1%} at altitude {asked.text()} m, median {middle:.2f}'
    ok = share(inside) >= limits.ALTITUDE_SHARE
    return decide(ok and (asked.slack == 0.0 or asked.counts(middle)), why)


def leg_speed(flight: Flight, requirement: Mapping[str, Any], window: slice) -> Judged:
    """Return whether the legs are flown at the annotated speed, outside of turns."""
    asked = wanted(requirement, 'speed_mps', flight.variation, limits.SPEED)
    if asked is None:
        return holds('')
    scene = flight.scene
    whole = _leg_speed(flight, requirement, window, asked)
    xy = scene.xy(flight.uav)[window]
    turns = corners(xy)
    if whole.outcome is Outcome.HOLDS or len(turns) < 3:
        return whole
    # The way to the pattern is no leg of it.
    return any_of([whole, _leg_speed(flight, requirement, _from(window, turns[1]), asked)])


def _from(window: slice, later: int) -> slice:
    return slice(window.start + later, window.stop)


def _leg_speed(
    flight: Flight, requirement: Mapping[str, Any], window: slice, asked: Wanted
) -> Judged:
    scene = flight.scene
    xy, speed = scene.xy(flight.uav)[window], scene.speed(flight.uav)[window]
    if requirement.get('pattern') == 'orbit':
        turns = np.array([0, len(xy) - 1])
    else:
        turns = np.array(corners(xy))
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(xy, axis=0), axis=1))])
    to_turn = np.abs(arc[:, None] - arc[turns][None]).min(axis=1)
    low, high = asked.low - asked.slack, asked.high + asked.slack
    moving = speed > 0.3
    best, why = 0.0, 'no leg is long enough to reach the speed'
    # How fast the UAV speeds up is not recorded: short distances are tried, then longer ones.
    for gain_mps2 in (3.0, 1.5, 0.75):
        # What counts begins where the slowest speed that does can be reached.
        free = moving & (to_turn > max(low, 0.0) ** 2 / (2.0 * gain_mps2))
        if free.sum() * scene.dt_s < 1.0:
            continue
        good = share((speed[free] >= low) & (speed[free] <= high))
        if good >= best:
            best = good
            why = f'{good:.1%} of the legs at {asked.text()} m/s, median '
            why += f'{float(np.median(speed[free])):.2f}'
    top = float(speed.max()) if len(speed) else 0.0
    reached = bool(low <= top <= high + asked.slack)
    return graded(best >= limits.SPEED_SHARE, best == 0.0 and reached, f'{why}, fastest {top:.2f}')


def avoided(flight: Flight, requirement: Mapping[str, Any]) -> list[Judged]:
    """Return for each place to be avoided whether the UAV kept away from it while airborne."""
    avoid = requirement.get('avoid') or ()
    names = [avoid] if isinstance(avoid, str) else list(avoid)
    least = float(requirement.get('avoid_m') or 0.0)
    scene, parts = flight.scene, []
    for name in names:
        airborne = scene.airborne(flight.uav)
        if not scene.places.known(name):
            zones = [z.polygon for z in scene.world.zones if name.casefold() in z.name.casefold()]
            if not zones:
                parts.append(cannot_tell(f'no place {name!r} in the recorded world'))
                continue
        away = scene.places.outline_distance(name, scene.xy(flight.uav)[airborne])
        nearest = float(away.min()) if len(away) else np.inf
        parts.append(decide(nearest > 0.0 and nearest >= least, f'{nearest:.1f} m from {name}'))
    return parts
