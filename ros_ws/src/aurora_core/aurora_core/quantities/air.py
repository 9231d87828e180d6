# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The air that a multirotor flies in, by how it leans: thrust is what gravity and drag leave.

A recorded wind says what was to blow. This is what blew, of states alone: along the rotor axis
there is thrust of any strength, across it only drag, and drag goes with the speed through the air.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.quantities import motion
from aurora_core.quantities.view import Body, RunView
from aurora_core.trace.layout import UavColumn

FloatArray = npt.NDArray[np.float64]
TickArray = npt.NDArray[np.intp]

_GRAVITY_MPS2 = 9.80665
# Drag goes with the speed that is looked for: so many rounds come to it within 1 mm/s.
_ROUNDS = 12
# Who leans by more than that (a share of upright) is not flown: its drag cannot be told.
_UPRIGHT = 0.3


def wind_of_flight(view: RunView, uav: Body, touchdown_m: float) -> tuple[TickArray, FloatArray]:
    """Return the horizontal wind that the states of a flight show.

    Args:
        view: The run.
        uav: Who flies.
        touchdown_m: Height below which a UAV that reports landed is down.

    Returns:
        Ticks (n,), and the wind (n, 2) at each, ENU, where the air goes, m/s: in the air, with a
        tick in the air before and behind, n >= 0.
    """
    rows = view.rows(uav)
    flies = motion.airborne(view, uav, touchdown_m) & (rows[:, UavColumn.Z] > touchdown_m)
    qw, qx, qy, qz = rows[:, UavColumn.QW : UavColumn.QZ + 1].T
    axis = np.stack(
        (2.0 * (qx * qz + qw * qy), 2.0 * (qy * qz - qw * qx), 1.0 - 2.0 * (qx * qx + qy * qy)),
        axis=1,
    )
    inner = flies[:-2] & flies[1:-1] & flies[2:] & (axis[1:-1, 2] > _UPRIGHT)
    ticks = np.flatnonzero(inner) + 1
    velocity = rows[:, UavColumn.VX : UavColumn.VZ + 1]
    gain = (velocity[ticks + 1] - velocity[ticks - 1]) / (2.0 * view.dt_s)
    velocity, axis = velocity[ticks], axis[ticks]
    limits = view.world.limits
    air = np.zeros((len(ticks), 2))
    for _ in range(_ROUNDS):
        speed = np.sqrt(air[:, 0] ** 2 + air[:, 1] ** 2 + velocity[:, 2] ** 2)
        drag = limits.uav_drag_hz + limits.uav_drag_per_m * speed
        lift = (gain[:, 2] + _GRAVITY_MPS2 + drag * velocity[:, 2]) / axis[:, 2]
        air = (lift[:, None] * axis[:, :2] - gain[:, :2]) / drag[:, None]
    return ticks, velocity[:, :2] - air
