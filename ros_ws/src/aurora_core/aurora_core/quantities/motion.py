# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Distance, altitude, speed and what follows from them, over a whole run.

Each function returns a series (T,) unless it says otherwise; samples at which a body is absent
hold its last values, see `RunView.present`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from aurora_core.quantities.kernels import Number, distance_2d, distance_3d
from aurora_core.quantities.view import Body, RunView, Series
from aurora_core.trace.layout import GroundColumn, UavColumn, UavCommandColumn, UavMode

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# A body that is slower keeps the course that it had (m/s).
COURSE_MPS = 0.5


def distance(view: RunView, a: str, b: str, *, on_road: bool = False) -> FloatArray:
    """Return the 3-D distance of two reference points in metres; `on_road`: see `between`."""
    delta = view.between(a, b, on_road=on_road)
    return distance_3d(delta[:, 0], delta[:, 1], delta[:, 2])


def horizontal_distance(view: RunView, a: str, b: str, *, on_road: bool = False) -> FloatArray:
    """Return the distance of two reference points in the plane, metres; see `distance`."""
    delta = view.between(a, b, on_road=on_road)
    return distance_2d(delta[:, 0], delta[:, 1])


def altitude(view: RunView, body: Body) -> FloatArray:
    """Return the height of the reference point above ground, metres."""
    return view.reference(body.body_id)[:, 2]


def speed(view: RunView, body: Body) -> FloatArray:
    """Return the speed in m/s: along the heading, for a UAV in space."""
    rows = view.rows(body)
    if body.is_uav:
        return distance_3d(rows[:, UavColumn.VX], rows[:, UavColumn.VY], rows[:, UavColumn.VZ])
    return rows[:, GroundColumn.SPEED]


def horizontal_speed(view: RunView, uav: Body) -> FloatArray:
    """Return the speed of a UAV over ground in m/s."""
    rows = view.rows(uav)
    return distance_2d(rows[:, UavColumn.VX], rows[:, UavColumn.VY])


def course(view: RunView, body: Body) -> FloatArray:
    """Return the heading of a ground body, (T, 2) unit vectors: while it stands, the last one.

    Until it moves it is the one that it has at t = 0.
    """
    rows = view.rows(body)
    moving = rows[:, GroundColumn.SPEED] > COURSE_MPS
    last = np.maximum.accumulate(np.where(moving, np.arange(view.ticks), 0))
    heading: FloatArray = rows[last, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1]
    return heading


def commanded_speed(view: RunView, uav: Body) -> FloatArray:
    """Return the commanded horizontal speed in m/s, 0 where no velocity is commanded."""
    rows = view.commands(uav)
    offboard = rows[:, UavCommandColumn.MODE] == UavMode.OFFBOARD
    wanted = distance_2d(rows[:, UavCommandColumn.VX], rows[:, UavCommandColumn.VY])
    return np.where(offboard, wanted, 0.0)


def climb_rate(view: RunView, uav: Body) -> FloatArray:
    """Return the vertical speed in m/s, upwards positive."""
    return view.rows(uav)[:, UavColumn.VZ]


def airborne(view: RunView, uav: Body, touchdown_m: float) -> BoolArray:
    """Return where a UAV flies: not reported landed, or higher than at rest."""
    rows = view.rows(uav)
    in_air: BoolArray = (rows[:, UavColumn.LANDED] < 0.5) | (rows[:, UavColumn.Z] > touchdown_m)
    return in_air


def battery(airborne_ticks: Number, dt_s: float, endurance_s: float) -> Number:
    """Return what is left of a charge: full at take-off, empty at the endurance, linear between.

    Args:
        airborne_ticks: So many ticks in the air.
        dt_s: Time step.
        endurance_s: For how long a full battery lasts.
    """
    return 1.0 - airborne_ticks * dt_s / endurance_s


def battery_series(view: RunView, uav: Body, touchdown_m: float) -> FloatArray:
    """Return the charge of a UAV at every tick, (T,) shares."""
    flown = np.cumsum(airborne(view, uav, touchdown_m)).astype(np.float64)
    return battery(flown, view.dt_s, view.world.limits.uav_endurance_s)


def on_ground(view: RunView, uav: Body, touchdown_m: float) -> BoolArray:
    """Return where a UAV is reported landed and is as low as at rest."""
    return ~airborne(view, uav, touchdown_m)


def deceleration(view: RunView, body: Body) -> FloatArray:
    """Return the loss of speed per second up to each tick, m/s^2; 0 at tick 0."""
    values = speed(view, body)
    result = np.zeros(view.ticks)
    result[1:] = (values[:-1] - values[1:]) / view.dt_s
    return result


def steps(view: RunView) -> FloatArray:
    """Return the way from the tick before, (T, bodies) metres; 0 at tick 0 and while absent.

    Ground bodies in row order, then UAVs: all at once, because for a tick alone the calls would
    cost more than the work.
    """

    def compute(part: RunView) -> Series:
        ground, uav = part.trace.ground, part.trace.uav
        on_ground, bodies = ground.shape[1], ground.shape[1] + uav.shape[1]
        point = np.zeros((part.ticks, bodies, 3))
        point[:, :on_ground, :2] = ground[:, :, GroundColumn.X : GroundColumn.Y + 1]
        point[:, on_ground:] = uav[:, :, UavColumn.X : UavColumn.Z + 1]
        present = np.ones((part.ticks, bodies), dtype=np.bool_)
        present[:, :on_ground] = ground[:, :, GroundColumn.PRESENT] > 0.5
        delta = point[1:] - point[:-1]
        moved = distance_3d(delta[:, :, 0], delta[:, :, 1], delta[:, :, 2])
        result = np.zeros((part.ticks, bodies))
        result[1:] = np.where(present[1:] & present[:-1], moved, 0.0)
        return (result,)

    found: FloatArray = view.series(('steps',), compute, before=1)[0]
    return found


def jump_speeds(view: RunView, bodies: Sequence[Body]) -> FloatArray:
    """Return displacement per second up to each tick, (T, bodies) m/s; as in `steps`."""
    columns = [_column(view, body) for body in bodies]
    return steps(view)[:, columns] / view.dt_s


def travelled(view: RunView, body: Body) -> FloatArray:
    """Return the way covered since tick 0 in metres (running sum, one sample after the other)."""
    way: FloatArray = np.add.accumulate(steps(view)[:, _column(view, body)])
    return way


def _column(view: RunView, body: Body) -> int:
    return body.row + view.trace.ground.shape[1] if body.is_uav else body.row


def closing_start_tick(view: RunView, body: Body, still_mps: float) -> int | None:
    """Return the last tick at which a body stood before it first moved.

    A body that moves at tick 0 has been closing from tick 0 on; one that never moves has no
    start (None).
    """
    moving = np.flatnonzero(speed(view, body) > still_mps)
    if len(moving) == 0:
        return None
    return max(int(moving[0]) - 1, 0)
