# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the multirotor does: measured by flying it, set-point by set-point, as runs do."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from aurora_cli.map_measure.endurance import measure_endurance
from aurora_cli.map_measure.flight import EAST, HEIGHT_M, OTHER_MODEL, SETTLE_S, Flight, level
from aurora_cli.map_measure.link_reach import measure_link
from aurora_core.document import first_problem
from aurora_core.errors import AirSimulatorError
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.measured_on import weather_winds
from aurora_core.knowledge.uav_record import (
    RESERVE,
    BrakingRow,
    DriftRow,
    LagRow,
    TurnRow,
    UavRecord,
)
from aurora_uav_sim.autopilot import Target

# Commanded where the vehicle is to do all that it can (m/s).
_ALL_MPS = 90.0
_STANDS_MPS = 0.1
_LONGEST_S = 120.0
_SHARE = 0.9  # of the speed, at the end of an acceleration
_BRAKING_MPS = (5.0, 10.0, 15.0)
_TURN_MPS = (2.0, 5.0, 10.0, 15.0)
_LAG_MPS = (5.0, 10.0, 15.0)
_CRUISE_MPS = (10.0,)
# Hovered in beside those of every weather (mean and gust).
_STRONG_MPS = (10.0, 5.0)
_MOST_GUST_MPS = 5.0
_HOVER_S = 120.0
_DIGITS = 3


def measure_multirotor(dt_s: float, limits: Limits) -> UavRecord:
    """Fly the installed model and return what it did.

    Args:
        dt_s: Step of the set-points.
        limits: Whose link ranges the messages have, and up to whose speed and wind it flies.

    Raises:
        AirSimulatorError: The vehicle does not fly.
        ConfigError: Its file is missing or out of its schema.
    """
    try:
        return _flown(dt_s, limits)
    except (ArithmeticError, ValueError) as err:
        raise AirSimulatorError(
            f'the multirotor does not fly as it has to: {first_problem(err)}', hint=OTHER_MODEL
        ) from err


def _flown(dt_s: float, limits: Limits) -> UavRecord:
    speed, gain_s = _top_speed(dt_s)
    climb, descent = (_vertical(dt_s, sign) for sign in (1.0, -1.0))
    stops = tuple(_braking(dt_s, v) for v in _below(_BRAKING_MPS, speed))
    asked = _rounded(speed / RESERVE)  # as fast as it may be asked to fly
    reaches, link = measure_link(dt_s, limits)
    most = min(asked, limits.uav_speed_max_mps)
    return UavRecord(
        speed_mps=speed,
        climb_mps=climb,
        descent_mps=descent,
        acceleration_mps2=_rounded(_SHARE * speed / gain_s),
        braking_mps2=_rounded(stops[-1].speed_mps / stops[-1].time_s),
        endurances=measure_endurance(dt_s, _below(_CRUISE_MPS, most), _winds(limits)),
        braking=stops,
        turns=tuple(_turn(dt_s, v) for v in _below(_TURN_MPS, asked)),
        lags=tuple(_lag(dt_s, v) for v in _below(_LAG_MPS, asked)),
        drifts=tuple(_drift(dt_s, wind) for wind in sorted({*_winds(limits), _STRONG_MPS})),
        reach_sight_m=reaches[0],
        reach_blocked_m=reaches[1],
        link=link,
    )


def _winds(limits: Limits) -> Sequence[tuple[float, float]]:
    """Return the winds to fly in: of every weather, and the strongest that can be asked for."""
    winds = weather_winds(limits).values()
    gust_mps = max(_MOST_GUST_MPS, *(gust for _, gust in winds))
    return sorted({*winds, (limits.wind_max_mps, gust_mps)})


def _below(speeds: Sequence[float], most: float) -> Sequence[float]:
    """Return the speeds below a greatest one, and that."""
    return [*(v for v in speeds if v < most), most]


def _rounded(value: float) -> float:
    return round(value, _DIGITS)


def _top_speed(dt_s: float) -> tuple[float, float]:
    """Return the speed that is kept, and the time from a hover to most of it."""
    flight = Flight(dt_s)
    flight.fly(lambda _: level(_ALL_MPS), _LONGEST_S)
    top = flight.speed
    again = Flight(dt_s)
    took_s = again.fly(lambda _: level(_ALL_MPS), _LONGEST_S, lambda: again.speed >= _SHARE * top)
    return _rounded(top), took_s


def _vertical(dt_s: float, sign: float) -> float:
    flight = Flight(dt_s)
    target = Target((0.0, 0.0), None, (0.0, 0.0), sign * _ALL_MPS, EAST)
    flight.fly(lambda _: target, SETTLE_S)
    return _rounded(sign * flight.body.vz)


def _braking(dt_s: float, speed_mps: float) -> BrakingRow:
    flight = Flight(dt_s)
    flight.fly(lambda _: level(speed_mps), 2.0 * SETTLE_S)
    start_m = flight.body.x
    took_s = flight.fly(lambda _: level(0.0), _LONGEST_S, lambda: flight.speed < _STANDS_MPS)
    return BrakingRow(
        speed_mps=speed_mps,
        distance_m=_rounded(flight.body.x - start_m),
        time_s=_rounded(took_s),
    )


def _turn(dt_s: float, speed_mps: float) -> TurnRow:
    """A set-point that moves east and then, at once, north."""
    flight = Flight(dt_s)
    corner_m = speed_mps * SETTLE_S
    farthest = 0.0

    def target(t_s: float) -> Target:
        nonlocal farthest
        farthest = max(farthest, flight.body.x - corner_m)
        way_m = speed_mps * t_s
        if way_m < corner_m:
            return Target((way_m, 0.0), HEIGHT_M, (speed_mps, 0.0), 0.0, EAST)
        north_m = way_m - corner_m
        return Target((corner_m, north_m), HEIGHT_M, (0.0, speed_mps), 0.0, EAST)

    flight.fly(target, 2.0 * SETTLE_S)
    return TurnRow(speed_mps=speed_mps, overshoot_m=_rounded(farthest))


def _lag(dt_s: float, speed_mps: float) -> LagRow:
    """A set-point that begins to move at once; the distance behind it when it has settled."""
    flight = Flight(dt_s)
    behind = 0.0

    def target(t_s: float) -> Target:
        nonlocal behind
        behind = speed_mps * t_s - flight.body.x
        return Target((speed_mps * t_s, 0.0), HEIGHT_M, (speed_mps, 0.0), 0.0, EAST)

    flight.fly(target, 4.0 * SETTLE_S)
    return LagRow(speed_mps=speed_mps, lag_m=_rounded(max(0.0, behind)))


def _drift(dt_s: float, wind_mps: tuple[float, float]) -> DriftRow:
    flight = Flight(dt_s, wind_mps)
    farthest = 0.0

    def target(_t_s: float) -> Target:
        nonlocal farthest
        x, y = flight.body.x, flight.body.y
        farthest = max(farthest, sqrt(x * x + y * y))
        return Target((0.0, 0.0), HEIGHT_M, (0.0, 0.0), 0.0, EAST)

    flight.fly(target, _HOVER_S)
    return DriftRow(mean_mps=wind_mps[0], gust_mps=wind_mps[1], drift_m=_rounded(farthest))
