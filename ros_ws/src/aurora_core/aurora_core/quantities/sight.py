# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Visible: in range, and the straight line crosses no building and no other vehicle.

The camera of a UAV is gimballed; there is no field of view. Persons look all round, drivers ahead.
One function serves a whole run and a single
tick (a series of one), so both give the same bits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.sight import SIGHT_CLEAR_M, SightModel, box_sight_series
from aurora_core.quantities.kernels import ahead_m, distance_3d
from aurora_core.quantities.view import RunView, Series
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.roster import RosterEntry

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# A line that stays this much farther from a box's centre than its corners cannot meet it.
_MISS_M = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SightSeries:
    """Sight of one target over T samples.

    Attributes:
        slant_range_m: (T,) from the observer to the sight point.
        clearance_m: (T,) height by which the line clears what is in its way, above 0 = free.
        margin_m: (T,) the least of the clearance, what is left of the range, and for a driver
            how far ahead the target is.
        visible: (T,).
    """

    slant_range_m: FloatArray
    clearance_m: FloatArray
    margin_m: FloatArray
    visible: BoolArray


def occluder_reach_m(entry: RosterEntry) -> float:
    """Return how near a line must come to a vehicle's centre to meet its box, and 1 m more."""
    return (entry.length_m + entry.width_m) / 2.0 + _MISS_M


def vehicle_clearance(
    observer: FloatArray,
    target: FloatArray,
    ground: FloatArray,
    entries: Sequence[RosterEntry],
    exclude: frozenset[int],
) -> FloatArray:
    """Return the margin of lines over all vehicles that are present.

    Args:
        observer: (T, 3) ENU metres.
        target: (T, 3) ENU metres.
        ground: (T, N, GROUND_WIDTH) states.
        entries: N roster entries.
        exclude: Rows that do not occlude (the target itself, the sender of a message).

    Returns:
        (T,) metres, at most SIGHT_CLEAR_M.
    """
    out = np.full(len(observer), SIGHT_CLEAR_M)
    start, step = observer[:, :2], target[:, :2] - observer[:, :2]
    square = step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1]
    safe = np.where(square > 0.0, square, 1.0)
    # All vehicles at once: few are ever near, and for each by itself the calls would cost most.
    centre = ground[:, :, GroundColumn.X : GroundColumn.Y + 1]
    to = centre - start[:, None]
    along = (to[:, :, 0] * step[:, :1] + to[:, :, 1] * step[:, 1:]) / safe[:, None]
    along = np.minimum(np.maximum(along, 0.0), 1.0)
    rest = to - along[:, :, None] * step[:, None]
    reach = np.array([occluder_reach_m(entry) for entry in entries])
    near = rest[:, :, 0] * rest[:, :, 0] + rest[:, :, 1] * rest[:, :, 1] <= reach * reach
    near &= ground[:, :, GroundColumn.PRESENT] > 0.5
    for row in np.flatnonzero(near.any(axis=0)).tolist():
        entry = entries[row]
        if entry.is_person or row in exclude:
            continue
        k = np.flatnonzero(near[:, row])
        margin = box_sight_series(
            observer[k],
            target[k],
            centre[k, row],
            ground[k, row, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1],
            entry.length_m,
            entry.width_m,
            entry.height_m,
        )
        out[k] = np.minimum(out[k], margin)
    return out


def sight_of(
    geometry: WorldGeometry,
    observer: FloatArray,
    target: FloatArray,
    ground: FloatArray,
    entries: Sequence[RosterEntry],
    exclude: frozenset[int],
    present: BoolArray,
    heading: FloatArray | None = None,
    hiding: SightModel | None = None,
) -> SightSeries:
    """Return the sight of a target; arguments as in `vehicle_clearance`.

    Args:
        geometry: Solids and sensing range of the world.
        observer: (T, 3) where it is looked from.
        target: (T, 3) sight points.
        ground: (T, N, GROUND_WIDTH) states.
        entries: N roster entries.
        exclude: Rows that do not occlude.
        present: (T,) where both exist; elsewhere the target is not visible.
        heading: (T, 2) of an observer that sees what is ahead of it alone.
        hiding: Buildings that can hide the target; default: all.
    """
    delta = target - observer
    slant = distance_3d(delta[:, 0], delta[:, 1], delta[:, 2])
    hiding = geometry.sight if hiding is None else hiding
    clearance = np.minimum(
        hiding.clearance_series(observer, target),
        vehicle_clearance(observer, target, ground, entries, exclude),
    )
    left = geometry.world.sensing_range_m - slant
    margin, visible = np.minimum(clearance, left), present & (left >= 0.0) & (clearance > 0.0)
    if heading is not None:
        ahead = ahead_m(delta[:, 0], delta[:, 1], heading[:, 0], heading[:, 1])
        margin, visible = np.minimum(margin, ahead), visible & (ahead >= 0.0)
    return SightSeries(
        slant_range_m=slant, clearance_m=clearance, margin_m=margin, visible=visible
    )


def sight_series(view: RunView, observer: str, target: str) -> SightSeries:
    """Return the sight of a body or place from any body over the whole run."""

    def compute(part: RunView) -> Series:
        body = part.body(observer)
        columns = slice(GroundColumn.HEADING_X, GroundColumn.HEADING_Y + 1)
        sight = sight_of(
            part.geometry,
            part.eye_point(observer),
            part.sight_point(target),
            part.trace.ground,
            part.trace.roster.agents,
            _rows_of(part, observer, target),
            part.present(observer) & part.present(target),
            part.rows(body)[:, columns] if body.looks_ahead else None,
            None if part.has(target) else part.geometry.sight_to(target).model,
        )
        return sight.slant_range_m, sight.clearance_m, sight.margin_m, sight.visible

    slant, clearance, margin, visible = view.series(('sight', observer, target), compute)
    return SightSeries(
        slant_range_m=slant, clearance_m=clearance, margin_m=margin, visible=visible
    )


def _rows_of(view: RunView, a: str, b: str) -> frozenset[int]:
    """Return the rows of the ground agents among two bodies."""
    return frozenset(
        view.body(name).row for name in (a, b) if view.has(name) and not view.body(name).is_uav
    )


def radio_sight_series(view: RunView, a: str, b: str) -> BoolArray:
    """Return where two radios have line of sight: no building, no third vehicle between."""

    def compute(part: RunView) -> Series:
        free = radio_sight_of(
            part.geometry,
            part.sight_point(a),
            part.sight_point(b),
            part.trace.ground,
            part.trace.roster.agents,
            _rows_of(part, a, b),
        )
        return (free,)

    free: BoolArray = view.series(('radio', a, b), compute)[0]
    return free


def radio_sight_of(
    geometry: WorldGeometry,
    a: FloatArray,
    b: FloatArray,
    ground: FloatArray,
    entries: Sequence[RosterEntry],
    exclude: frozenset[int],
) -> BoolArray:
    """Return (T,) where the line between two sight points is free; see `vehicle_clearance`."""
    clear = np.minimum(
        geometry.sight.clearance_series(a, b), vehicle_clearance(a, b, ground, entries, exclude)
    )
    free: BoolArray = clear > 0.0
    return free
