# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Line of sight over buildings and over vehicles, as a signed margin in metres.

The margin is the least height of the straight line above the roof while it passes over the
footprint. The line is free if and only if the margin is above 0; touching a roof or a wall is not
free. A line that passes no footprint, or passes high above, has the margin SIGHT_CLEAR_M.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from aurora_core.geometry.arrays import (
    FloatArray,
    FloatLike,
    FloatOrArray,
    IntArray,
    as_point,
    as_rows,
    finite_rows,
    row_chunks,
    same_length,
    size_rows,
    spread_rows,
)
from aurora_core.geometry.contacts import find_contacts, least_height
from aurora_core.geometry.edges import EdgeRows
from aurora_core.geometry.polygon import Polygon, PolygonSet
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.prisms import NO_UNDERSIDE_M, PrismTable

SIGHT_CLEAR_M = 100.0
_SLACK_M = 1e-6  # how much footprints' boxes grow before a line is held to miss them

_FEW_PAIRS = 64  # up to this many (line, building) pairs, sorting out costs more than it saves


class SightModel:
    """Buildings as occluders.

    A prism with a raised base also lets a line through below it; a line that passes the same
    prism once above and once below counts as blocked.
    """

    def __init__(self, prisms: Iterable[Prism]) -> None:
        self._table = PrismTable(prisms)
        bounds = self._table.footprints.bounds
        self._centre_x: FloatArray = (bounds[:, 0] + bounds[:, 2]) / 2.0
        self._centre_y: FloatArray = (bounds[:, 1] + bounds[:, 3]) / 2.0
        self._half_x: FloatArray = (bounds[:, 2] - bounds[:, 0]) / 2.0 + _SLACK_M
        self._half_y: FloatArray = (bounds[:, 3] - bounds[:, 1]) / 2.0 + _SLACK_M
        self._at: dict[tuple[float, float], SightModel] = {}

    def around(self, x_m: float, y_m: float) -> SightModel:
        """Return the same without the prisms that hold a point, for whoever looks at them.

        Who looks at a place in a building looks at the building, which does not hide itself.
        """
        if (x_m, y_m) not in self._at:
            here = np.array([[x_m, y_m]])
            bounds = self._table.footprints.bounds
            low, high = bounds[:, :2] - _SLACK_M, bounds[:, 2:] + _SLACK_M
            near = set(np.flatnonzero(((low <= here) & (here <= high)).all(axis=1)).tolist())
            left = [p for k, p in enumerate(self.prisms) if k not in near or not _holds(p, here)]
            same = len(left) == len(self.prisms)
            self._at[x_m, y_m] = self if same else SightModel(left)
        return self._at[x_m, y_m]

    @property
    def prisms(self) -> tuple[Prism, ...]:
        """The prisms, as given."""
        return self._table.prisms

    def boxes(self) -> list[list[float]]:
        """Return west, south, east, north and top (m) of the box around each prism."""
        bounds, top = self._table.footprints.bounds, self._table.top
        boxes: list[list[float]] = np.column_stack((bounds, top)).tolist()
        return boxes

    def clearance(self, observer_xyz: FloatLike, target_xyz: FloatLike) -> float:
        """Return the margin of one line, bit for bit that of `clearance_series`.

        Args:
            observer_xyz: (3,) ENU metres.
            target_xyz: (3,) ENU metres.
        """
        observer = as_point('observer_xyz', observer_xyz, 3)
        return float(self._series(observer, as_point('target_xyz', target_xyz, 3))[0])

    def clearance_series(self, observer: FloatLike, target: FloatLike) -> FloatArray:
        """Return the margin of many lines over all buildings.

        Args:
            observer: (T, 3) ENU metres.
            target: (T, 3) ENU metres.

        Returns:
            (T,) metres, above 0 free, at most SIGHT_CLEAR_M. NaN where an end is not finite.
        """
        start, end = as_rows('observer', observer, 3), as_rows('target', target, 3)
        same_length(observer=start, target=end)
        return self._series(start, end)

    def _series(self, start: FloatArray, end: FloatArray) -> FloatArray:
        finite = finite_rows(start, end)
        if not finite.all():
            return spread_rows(self._series(start[finite], end[finite]), finite)
        out = np.full(len(start), SIGHT_CLEAR_M)
        low, high = np.minimum(start, end), np.maximum(start, end)
        near = self._table.footprints.near(low[:, 0], low[:, 1], high[:, 0], high[:, 1], 0.0)
        for rows, row, item in near:
            p, q = start[rows][row], end[rows][row]
            if len(row) > _FEW_PAIRS:
                kept = self._line_meets_bounds(p, q, item)
                row, item, p, q = row[kept], item[kept], p[kept], q[kept]
            np.minimum.at(out[rows], row, self._margins(p, q, item))
        return out

    def _line_meets_bounds(self, p: FloatArray, q: FloatArray, item: IntArray) -> IntArray:
        """Return the pairs whose line can meet the box around the footprint."""
        dx, dy = q[:, 0] - p[:, 0], q[:, 1] - p[:, 1]
        offset = dx * (self._centre_y[item] - p[:, 1]) - dy * (self._centre_x[item] - p[:, 0])
        reach = self._half_x[item] * np.abs(dy) + self._half_y[item] * np.abs(dx)
        kept: IntArray = np.flatnonzero(np.abs(offset) <= reach)
        return kept

    def _margins(self, p: FloatArray, q: FloatArray, item: IntArray) -> FloatArray:
        rows = self._table.footprints.edges.rows_of_pairs(item)
        return _margins(p, q, rows, self._table.base[item], self._table.top[item])


def _holds(prism: Prism, xy: FloatArray) -> bool:
    """Tell whether a point (1, 2) is inside the outer ring of a prism."""
    return bool(PolygonSet((Polygon(prism.ring_xy),)).contains(xy)[0])


def box_sight_series(
    observer: FloatLike,
    target: FloatLike,
    centres: FloatLike,
    headings: FloatLike,
    length_m: FloatOrArray,
    width_m: FloatOrArray,
    height_m: FloatOrArray,
) -> FloatArray:
    """Return the margin of many lines over one moving box that stands on the ground.

    The observer and the target must not be the box itself.

    Args:
        observer: (T, 3) ENU metres.
        target: (T, 3) ENU metres.
        centres: (T, 2) centre of the box in the plane, metres.
        headings: (T, 2) unit vector of its heading.
        length_m: Extent along the heading; one number or (T,), like the next two.
        width_m: Extent across it.
        height_m: Height of its top above ground.

    Returns:
        (T,) metres, above 0 free, at most SIGHT_CLEAR_M. NaN where an argument is not finite.
    """
    start, end = as_rows('observer', observer, 3), as_rows('target', target, 3)
    centre, heading = as_rows('centres', centres, 2), as_rows('headings', headings, 2)
    same_length(observer=start, target=end, centres=centre, headings=heading)
    finite = finite_rows(start, end, centre, heading)
    sizes = size_rows(len(start), length_m, width_m, height_m)
    if not finite.all():
        start, end, centre, heading = start[finite], end[finite], centre[finite], heading[finite]
        sizes = sizes[finite]
    out = np.empty(len(start))
    for part in row_chunks(len(start)):
        edges = _box_edges(centre[part], heading[part], sizes[part] / 2.0)
        base = np.full(part.stop - part.start, NO_UNDERSIDE_M)
        out[part] = _margins(start[part], end[part], edges, base, sizes[part, 2])
    return out if finite.all() else spread_rows(out, finite)


def _box_edges(centre: FloatArray, heading: FloatArray, half: FloatArray) -> EdgeRows:
    """Return the four edges of T boxes; `half` is (T, >= 2), half the length and the width."""
    ux, uy = heading[:, :1] * half[:, :1], heading[:, 1:] * half[:, :1]
    vx, vy = heading[:, 1:] * -half[:, 1:2], heading[:, :1] * half[:, 1:2]
    x = centre[:, :1] + np.concatenate((ux + vx, vx - ux, -ux - vx, ux - vx), axis=1)
    y = centre[:, 1:] + np.concatenate((uy + vy, vy - uy, -uy - vy, uy - vy), axis=1)
    return EdgeRows(
        ax=x.ravel(),
        ay=y.ravel(),
        bx=np.concatenate((x[:, 1:], x[:, :1]), axis=1).ravel(),
        by=np.concatenate((y[:, 1:], y[:, :1]), axis=1).ravel(),
        pair=np.repeat(np.arange(len(x), dtype=np.intp), 4),
    )


def _margins(
    p: FloatArray, q: FloatArray, edges: EdgeRows, base: FloatArray, top: FloatArray
) -> FloatArray:
    px, py = p[:, 0], p[:, 1]
    contacts = find_contacts(px, py, q[:, 0] - px, q[:, 1] - py, edges)
    margin = least_height(contacts, p[:, 2], q[:, 2]) - top
    if (base > NO_UNDERSIDE_M).any():
        # the greatest height is the least one upside down
        margin = np.maximum(margin, least_height(contacts, -p[:, 2], -q[:, 2]) + base)
    return np.minimum(margin, SIGHT_CLEAR_M) + 0.0
