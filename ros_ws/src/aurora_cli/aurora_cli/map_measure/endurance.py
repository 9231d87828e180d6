# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long the battery lasts: flown until it is empty, at several speeds and in several winds."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_cli.map_measure.flight import EAST, HEIGHT_M, Flight, level
from aurora_core.knowledge.uav_record import EnduranceRow
from aurora_uav_sim.autopilot import Target

# Along the wind and against it in turn, so long each.
_LEG_S = 60.0
# Who flies longer is brought down: no scenario is so long.
_MOST_S = 7200.0
_HOVER = Target((0.0, 0.0), HEIGHT_M, (0.0, 0.0), 0.0, EAST)


def measure_endurance(
    dt_s: float, speeds_mps: Sequence[float], winds_mps: Sequence[tuple[float, float]]
) -> tuple[EnduranceRow, ...]:
    """Hover, and fly there and back, from a full battery until what may be flown of it is.

    Args:
        dt_s: Step of the set-points.
        speeds_mps: Over the ground, beside a hover.
        winds_mps: Mean and gusts.
    """
    return tuple(_flown(dt_s, speed, wind) for speed in (0.0, *speeds_mps) for wind in winds_mps)


def _flown(dt_s: float, speed_mps: float, wind_mps: tuple[float, float]) -> EnduranceRow:
    flight = Flight(dt_s, wind_mps)

    def target(t_s: float) -> Target:
        back = int(t_s / _LEG_S) % 2
        return level(-speed_mps if back else speed_mps) if speed_mps > 0.0 else _HOVER

    flight.fly(target, _MOST_S, lambda: flight.battery.is_flown)
    return EnduranceRow(
        speed_mps=speed_mps,
        mean_mps=wind_mps[0],
        gust_mps=wind_mps[1],
        endurance_s=round(flight.airborne_s, 1),
    )
