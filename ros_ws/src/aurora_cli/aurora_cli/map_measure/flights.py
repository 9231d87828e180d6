# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the multirotor does: measured by flying it, set-point by set-point, as runs do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import ceil, isfinite, pi, sqrt

from aurora_core.comm.link import LinkSettings, MessageLink, Path, link_stream
from aurora_core.document import first_problem
from aurora_core.errors import AirSimulatorError
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.measured_on import weather_winds
from aurora_core.knowledge.uav_record import (
    RESERVE,
    BrakingRow,
    DriftRow,
    LagRow,
    LinkRow,
    TurnRow,
    UavRecord,
)
from aurora_core.trace.records import LinkEventKind
from aurora_uav_sim.autopilot import Autopilot, Result, Target
from aurora_uav_sim.parameters import MAX_SUBSTEP_S, installed_model
from aurora_uav_sim.wind import wind_stream

_OTHER_MODEL = 'compare config/multirotor.json with the shipped file'
# Commanded where the vehicle is to do all that it can (m/s).
_ALL_MPS = 90.0
_HEIGHT_M = 100.0
_EAST = (0.0, 1.0)  # sine and cosine of the yaw
_CLIMB_S = 600.0
_SETTLE_S = 15.0
_STANDS_MPS = 0.1
_LONGEST_S = 120.0
_SHARE = 0.9  # of the speed, at the end of an acceleration
_BRAKING_MPS = (5.0, 10.0, 15.0)
_TURN_MPS = (2.0, 5.0, 10.0, 15.0)
_LAG_MPS = (5.0, 10.0, 15.0)
# Beside those of every weather (mean and gust).
_STRONG_MPS = (10.0, 5.0)
_MOST_GUST_MPS = 5.0
_HOVER_S = 120.0
_SEED = 1
_AIR_KGPM3 = 1.225  # standard atmosphere at sea level
_LINK_STEP_M = 50.0
_LINK_MOST_M = 1000.0
_DIGITS = 3


class _Flight:
    """A vehicle that hovers at a height in wind; `fly` streams set-points to it."""

    def __init__(self, dt_s: float, wind_mps: tuple[float, float] = (0.0, 0.0)) -> None:
        self.dt_s = dt_s
        self._steps = ceil(dt_s / MAX_SUBSTEP_S)
        self.pilot = Autopilot()
        self.body = self.pilot.body
        self.pilot.wind.set(wind_mps[0], 0.0, 0.0, wind_mps[1])
        self.pilot.wind.seed(wind_stream(_SEED, 1))
        hover = Target((0.0, 0.0), _HEIGHT_M, (0.0, 0.0), 0.0, _EAST)
        self.pilot.set_target(hover)
        if (self.pilot.offboard().result, self.pilot.arm().result) != (Result.ACCEPTED,) * 2:
            raise AirSimulatorError('the multirotor does not arm for its measurement')
        self.fly(lambda _: hover, _CLIMB_S, self._is_up)
        self.fly(lambda _: hover, _SETTLE_S)
        if not self._is_up():
            raise AirSimulatorError(
                f'the multirotor is to be measured at {_HEIGHT_M:g} m and gets to '
                f'{self.body.z:.1f} m',
                hint=_OTHER_MODEL,
            )

    def _is_up(self) -> bool:
        return abs(self.body.z - _HEIGHT_M) < 1.0

    def fly(
        self,
        target: Callable[[float], Target],
        duration_s: float,
        until: Callable[[], bool] | None = None,
    ) -> float:
        """Fly for some time, or until something is so; return the time that it took."""
        h = self.dt_s / self._steps
        ticks = round(duration_s / self.dt_s)
        for tick in range(ticks):
            self.pilot.set_target(target(tick * self.dt_s))
            for _ in range(self._steps):
                self.pilot.step(h)
            if not isfinite(self.body.x + self.body.y + self.body.z + self.speed):
                raise AirSimulatorError(
                    'the multirotor tumbles when it is measured', hint=_OTHER_MODEL
                )
            if until is not None and until():
                return (tick + 1) * self.dt_s
        return ticks * self.dt_s

    @property
    def speed(self) -> float:
        return sqrt(self.body.vx * self.body.vx + self.body.vy * self.body.vy)

    @property
    def thrust_n(self) -> float:
        body = self.body
        return float(body.f0 + body.f1 + body.f2 + body.f3)


def _level(speed_mps: float) -> Target:
    return Target(None, _HEIGHT_M, (speed_mps, 0.0), 0.0, _EAST)


def measure_multirotor(dt_s: float, limits: Limits) -> UavRecord:
    """Fly the installed model and return what it did.

    Args:
        dt_s: Step of the set-points.
        limits: Whose link ranges the table of messages has, and up to whose wind it hovers.

    Raises:
        AirSimulatorError: The vehicle does not fly.
        ConfigError: Its file is missing or out of its schema.
    """
    try:
        return _flown(dt_s, limits)
    except (ArithmeticError, ValueError) as err:
        raise AirSimulatorError(
            f'the multirotor does not fly as it has to: {first_problem(err)}', hint=_OTHER_MODEL
        ) from err


def _flown(dt_s: float, limits: Limits) -> UavRecord:
    speed, gain_s = _top_speed(dt_s)
    climb, descent = (_vertical(dt_s, sign) for sign in (1.0, -1.0))
    stops = tuple(_braking(dt_s, v) for v in _below(_BRAKING_MPS, speed))
    asked = _rounded(speed / RESERVE)  # as fast as it may be asked to fly
    power_w, endurance_s = _endurance(dt_s)
    return UavRecord(
        speed_mps=speed,
        climb_mps=climb,
        descent_mps=descent,
        acceleration_mps2=_rounded(_SHARE * speed / gain_s),
        braking_mps2=_rounded(stops[-1].speed_mps / stops[-1].time_s),
        power_w=power_w,
        endurance_s=endurance_s,
        braking=stops,
        turns=tuple(_turn(dt_s, v) for v in _below(_TURN_MPS, asked)),
        lags=tuple(_lag(dt_s, v) for v in _below(_LAG_MPS, asked)),
        drifts=tuple(_drift(dt_s, wind) for wind in _winds(limits)),
        link=_link(dt_s, limits),
    )


def _winds(limits: Limits) -> Sequence[tuple[float, float]]:
    """Return the winds to hover in: of every weather, and the strongest that can be asked for."""
    winds = weather_winds(limits).values()
    gust_mps = max(_MOST_GUST_MPS, *(gust for _, gust in winds))
    return sorted({*winds, _STRONG_MPS, (limits.wind_max_mps, gust_mps)})


def _below(speeds: Sequence[float], most: float) -> Sequence[float]:
    """Return the speeds below a greatest one, and that."""
    return [*(v for v in speeds if v < most), most]


def _rounded(value: float) -> float:
    return round(value, _DIGITS)


def _top_speed(dt_s: float) -> tuple[float, float]:
    """Return the speed that is kept, and the time from a hover to most of it."""
    flight = _Flight(dt_s)
    flight.fly(lambda _: _level(_ALL_MPS), _LONGEST_S)
    top = flight.speed
    again = _Flight(dt_s)
    took_s = again.fly(lambda _: _level(_ALL_MPS), _LONGEST_S, lambda: again.speed >= _SHARE * top)
    return _rounded(top), took_s


def _vertical(dt_s: float, sign: float) -> float:
    flight = _Flight(dt_s)
    target = Target((0.0, 0.0), None, (0.0, 0.0), sign * _ALL_MPS, _EAST)
    flight.fly(lambda _: target, _SETTLE_S)
    return _rounded(sign * flight.body.vz)


def _braking(dt_s: float, speed_mps: float) -> BrakingRow:
    flight = _Flight(dt_s)
    flight.fly(lambda _: _level(speed_mps), 2.0 * _SETTLE_S)
    start_m = flight.body.x
    took_s = flight.fly(lambda _: _level(0.0), _LONGEST_S, lambda: flight.speed < _STANDS_MPS)
    return BrakingRow(
        speed_mps=speed_mps,
        distance_m=_rounded(flight.body.x - start_m),
        time_s=_rounded(took_s),
    )


def _turn(dt_s: float, speed_mps: float) -> TurnRow:
    """A set-point that moves east and then, at once, north."""
    flight = _Flight(dt_s)
    corner_m = speed_mps * _SETTLE_S
    farthest = 0.0

    def target(t_s: float) -> Target:
        nonlocal farthest
        farthest = max(farthest, flight.body.x - corner_m)
        way_m = speed_mps * t_s
        if way_m < corner_m:
            return Target((way_m, 0.0), _HEIGHT_M, (speed_mps, 0.0), 0.0, _EAST)
        north_m = way_m - corner_m
        return Target((corner_m, north_m), _HEIGHT_M, (0.0, speed_mps), 0.0, _EAST)

    flight.fly(target, 2.0 * _SETTLE_S)
    return TurnRow(speed_mps=speed_mps, overshoot_m=_rounded(farthest))


def _lag(dt_s: float, speed_mps: float) -> LagRow:
    """A set-point that begins to move at once; the distance behind it when it has settled."""
    flight = _Flight(dt_s)
    behind = 0.0

    def target(t_s: float) -> Target:
        nonlocal behind
        behind = speed_mps * t_s - flight.body.x
        return Target((speed_mps * t_s, 0.0), _HEIGHT_M, (speed_mps, 0.0), 0.0, _EAST)

    flight.fly(target, 4.0 * _SETTLE_S)
    return LagRow(speed_mps=speed_mps, lag_m=_rounded(max(0.0, behind)))


def _drift(dt_s: float, wind_mps: tuple[float, float]) -> DriftRow:
    flight = _Flight(dt_s, wind_mps)
    farthest = 0.0

    def target(_t_s: float) -> Target:
        nonlocal farthest
        x, y = flight.body.x, flight.body.y
        farthest = max(farthest, sqrt(x * x + y * y))
        return Target((0.0, 0.0), _HEIGHT_M, (0.0, 0.0), 0.0, _EAST)

    flight.fly(target, _HOVER_S)
    return DriftRow(mean_mps=wind_mps[0], gust_mps=wind_mps[1], drift_m=_rounded(farthest))


def _endurance(dt_s: float) -> tuple[float, float]:
    """Return power (W) and endurance (s) of a hover in calm air.

    Source: ideal power of a hovering rotor, T^1.5 / sqrt(2 rho A), momentum theory (Leishman,
    Principles of Helicopter Aerodynamics, section 2.2), over the efficiency of the model.
    """
    energy = installed_model().energy
    flight = _Flight(dt_s)
    thrust_n = flight.thrust_n
    disc_m2 = 4.0 * pi * energy.rotor_radius_m * energy.rotor_radius_m
    power_w = thrust_n * sqrt(thrust_n / (2.0 * _AIR_KGPM3 * disc_m2)) / energy.efficiency
    usable_ws = 3600.0 * energy.battery_wh * energy.usable_share
    return _rounded(power_w), round(usable_ws / power_w, 1)


def _link(dt_s: float, limits: Limits) -> tuple[LinkRow, ...]:
    """Send a message without chance of loss over each distance, as far as one is received."""
    rows = []
    for step in range(1, round(_LINK_MOST_M / _LINK_STEP_M) + 1):
        distance_m = step * _LINK_STEP_M
        with_sight = _received(dt_s, limits, distance_m, line_of_sight=True)
        without = _received(dt_s, limits, distance_m, line_of_sight=False)
        rows.append(LinkRow(distance_m=distance_m, with_sight=with_sight, without_sight=without))
        if not with_sight and not without:
            break
    return tuple(rows)


def _received(dt_s: float, limits: Limits, distance_m: float, *, line_of_sight: bool) -> bool:
    settings = LinkSettings(
        link_id='measured',
        sender='a',
        receiver='b',
        loss=0.0,
        latency_s=0.0,
        retransmissions=0,
        interval_s=1.0,
        range_sight_m=limits.link_range_sight_m,
        range_blocked_m=limits.link_range_blocked_m,
    )
    link = MessageLink(settings, dt_s, link_stream(_SEED, settings.link_id))
    link.send(0, 1, '')
    path = Path(distance_m=distance_m, line_of_sight=line_of_sight)
    records = [r for tick in (0, 1) for r in link.step(tick, lambda: path, lambda: 0)]
    return any(record.kind is LinkEventKind.DELIVERED for record in records)
