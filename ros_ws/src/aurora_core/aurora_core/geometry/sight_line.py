# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Is a single line free? The answer of `SightModel`, mostly without its arithmetic.

Nearly every line of a run passes no building, or passes high above it. Plain comparisons settle
those: for one line they cost a twentieth of array arithmetic. What they leave open goes to
`SightModel`.
"""

from __future__ import annotations

from math import floor, isfinite

from aurora_core.geometry.sight import SightModel

Point3 = tuple[float, float, float]
# West, south, east, north, top in metres.
Box = tuple[float, float, float, float, float]

_CELL_M = 32.0
# Longer lines are left to the model, which takes all buildings at once.
_MOST_CELLS = 64
# The boxes grow by this much; it exceeds every rounding of the model's arithmetic by far.
_SLACK_M = 1e-3


class SightLine:
    """Buildings as occluders of one line at a time.

    Args:
        model: Answers what is not settled here.

    Attributes:
        model: As given.
    """

    def __init__(self, model: SightModel) -> None:
        self.model = model
        self._cells: dict[tuple[int, int], list[Box]] = {}
        for west, south, east, north, top in model.boxes():
            box = (
                west - _SLACK_M,
                south - _SLACK_M,
                east + _SLACK_M,
                north + _SLACK_M,
                top + _SLACK_M,
            )
            for column in range(floor(box[0] / _CELL_M), floor(box[2] / _CELL_M) + 1):
                for row in range(floor(box[1] / _CELL_M), floor(box[3] / _CELL_M) + 1):
                    self._cells.setdefault((column, row), []).append(box)

    def free(self, p: Point3, q: Point3) -> bool:
        """Return whether `SightModel.clearance(p, q)` is above 0 (ENU metres)."""
        return self._surely_free(p, q) or self.model.clearance(p, q) > 0.0

    def _surely_free(self, p: Point3, q: Point3) -> bool:
        px, py, pz = p
        qx, qy, qz = q
        if not isfinite(px + py + pz + qx + qy + qz):
            return False
        west, east = (px, qx) if px <= qx else (qx, px)
        south, north = (py, qy) if py <= qy else (qy, py)
        columns = range(floor(west / _CELL_M), floor(east / _CELL_M) + 1)
        rows = range(floor(south / _CELL_M), floor(north / _CELL_M) + 1)
        if len(columns) * len(rows) > _MOST_CELLS:
            return False
        cells = self._cells
        for column in columns:
            for row in rows:
                for box in cells.get((column, row), ()):
                    if box[0] > east or box[2] < west or box[1] > north or box[3] < south:
                        continue
                    if not passes_above(px, py, pz, qx - px, qy - py, qz - pz, box):
                        return False
        return True


def passes_above(
    px: float, py: float, pz: float, dx: float, dy: float, dz: float, box: Box
) -> bool:
    """Return whether a segment stays above an upright box wherever it is over its footprint.

    True also for a segment that does not pass over the footprint at all.

    Args:
        px: Start of the segment, metres east.
        py: North.
        pz: Up.
        dx: End minus start, east.
        dy: North.
        dz: Up.
        box: The box.
    """
    west, south, east, north, top = box
    enter, leave = 0.0, 1.0
    if dx != 0.0:
        a, b = (west - px) / dx, (east - px) / dx
        if a > b:
            a, b = b, a
        enter, leave = max(enter, a), min(leave, b)
    elif not west <= px <= east:
        return True
    if dy != 0.0:
        a, b = (south - py) / dy, (north - py) / dy
        if a > b:
            a, b = b, a
        enter, leave = max(enter, a), min(leave, b)
    elif not south <= py <= north:
        return True
    if enter > leave:
        return True
    return pz + (enter if dz > 0.0 else leave) * dz > top
