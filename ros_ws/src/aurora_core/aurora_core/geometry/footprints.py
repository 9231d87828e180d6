# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which polygons can matter to a row: candidates by bounding box, a superset by construction."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from aurora_core.geometry.arrays import FloatArray, IntArray, row_chunks
from aurora_core.geometry.edges import EdgeTable

ALL_PAIRS = 4096  # up to this many (row, polygon) pairs, comparing all boxes beats the tree


class FootprintTable:
    """Polygons with an index over their bounding boxes.

    Attributes:
        edges: Edges of all polygons.
        bounds: (N, 4) x_min, y_min, x_max, y_max.
    """

    def __init__(self, polygons: Sequence[Sequence[FloatArray]]) -> None:
        self.edges = EdgeTable(polygons)
        self.bounds = self.edges.bounds
        self._columns = tuple(np.ascontiguousarray(self.bounds[:, k]) for k in range(4))
        self._tree = shapely.STRtree(shapely.box(*self._columns))

    def __len__(self) -> int:
        """Return the number of polygons."""
        return len(self.edges)

    def near(
        self,
        x_min: FloatArray,
        y_min: FloatArray,
        x_max: FloatArray,
        y_max: FloatArray,
        margin_m: float,
    ) -> Iterator[tuple[slice, IntArray, IntArray]]:
        """Yield the polygons whose bounding box comes within a margin of each row's box.

        Args:
            x_min: (T,) west side of each row's box, metres, finite.
            y_min: (T,) south side.
            x_max: (T,) east side.
            y_max: (T,) north side.
            margin_m: How much each box grows on every side; may be infinite.

        Yields:
            A slice of rows, and for P pairs the row within the slice and the polygon.
        """
        if len(self) == 0:
            return
        west, south, east, north = (
            x_min - margin_m,
            y_min - margin_m,
            x_max + margin_m,
            y_max + margin_m,
        )
        for rows in row_chunks(len(x_min)):
            box = (west[rows], south[rows], east[rows], north[rows])
            row, item = self._pairs(*box)
            if len(row) > 0:
                yield rows, row, item

    def _pairs(
        self, west: FloatArray, south: FloatArray, east: FloatArray, north: FloatArray
    ) -> tuple[IntArray, IntArray]:
        if len(west) * len(self) <= ALL_PAIRS or not np.isfinite(west - east).all():
            x_min, y_min, x_max, y_max = self._columns
            overlap = (
                (x_min <= east[:, None])
                & (x_max >= west[:, None])
                & (y_min <= north[:, None])
                & (y_max >= south[:, None])
            )
            found_row, found_item = np.nonzero(overlap)
            return found_row, found_item
        found = self._tree.query(shapely.box(west, south, east, north))
        return found[0], found[1]
