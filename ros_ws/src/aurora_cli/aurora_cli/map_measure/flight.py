# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One flight of the installed multirotor: a hover, then set-points, as runs stream them."""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, isfinite, sqrt

from aurora_core.errors import AirSimulatorError
from aurora_uav_sim.autopilot import Autopilot, Result, Target
from aurora_uav_sim.battery import Battery
from aurora_uav_sim.parameters import MAX_SUBSTEP_S
from aurora_uav_sim.wind import wind_stream

OTHER_MODEL = 'compare config/multirotor.json with the shipped file'
HEIGHT_M = 100.0
EAST = (0.0, 1.0)  # sine and cosine of the yaw
SETTLE_S = 15.0
SEED = 1
_CLIMB_S = 600.0
CALM = (0.0, 0.0)


class Flight:
    """A vehicle that hovers at a height in wind; `fly` streams set-points to it.

    Args:
        dt_s: Step of the set-points.
        wind_mps: Mean towards east, and gusts.

    Attributes:
        pilot: The autopilot.
        body: What flies.
        battery: Full before the take-off.
        airborne_s: Time since the take-off.
    """

    def __init__(self, dt_s: float, wind_mps: tuple[float, float] = CALM) -> None:
        self.dt_s = dt_s
        self._steps = ceil(dt_s / MAX_SUBSTEP_S)
        self.pilot = Autopilot()
        self.body = self.pilot.body
        self.battery = Battery(self.pilot.settings)
        self.airborne_s = 0.0
        self.pilot.wind.set(wind_mps[0], 0.0, 0.0, wind_mps[1])
        self.pilot.wind.seed(wind_stream(SEED, 1))
        hover = Target((0.0, 0.0), HEIGHT_M, (0.0, 0.0), 0.0, EAST)
        self.pilot.set_target(hover)
        if (self.pilot.offboard().result, self.pilot.arm().result) != (Result.ACCEPTED,) * 2:
            raise AirSimulatorError('the multirotor does not arm for its measurement')
        self.fly(lambda _: hover, _CLIMB_S, self._is_up)
        self.fly(lambda _: hover, SETTLE_S)
        if not self._is_up():
            raise AirSimulatorError(
                f'the multirotor is to be measured at {HEIGHT_M:g} m and gets to '
                f'{self.body.z:.1f} m',
                hint=OTHER_MODEL,
            )

    def _is_up(self) -> bool:
        return abs(self.body.z - HEIGHT_M) < 1.0

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
            self.pilot.run(self._steps, h)
            if not self.pilot.landed:
                self.battery.step(self.dt_s, self.body, self.pilot.wind)
                self.airborne_s += self.dt_s
            if not isfinite(self.body.x + self.body.y + self.body.z + self.speed):
                raise AirSimulatorError(
                    'the multirotor tumbles when it is measured', hint=OTHER_MODEL
                )
            if until is not None and until():
                return (tick + 1) * self.dt_s
        return ticks * self.dt_s

    @property
    def speed(self) -> float:
        """Over the ground, m/s."""
        return sqrt(self.body.vx * self.body.vx + self.body.vy * self.body.vy)


def level(speed_mps: float) -> Target:
    """Return the set-point of a level flight east (below 0: west)."""
    return Target(None, HEIGHT_M, (speed_mps, 0.0), 0.0, EAST)
