# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`HeightLattice`: above which height the air over each cell of a map is surely free."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np
import numpy.typing as npt
import shapely

from aurora_core.errors import MapError
from aurora_core.knowledge.map_model import MapModel

FloatArray = npt.NDArray[np.float64]

CELL_M = 5.0
# Larger maps have larger cells, each twice as wide as before, until there are no more than these.
_MOST_CELLS = 1_000_000
# Distances are counted as this much shorter, so that rounding never frees a cell.
_SLACK_M = 0.01
_STEP_M = 0.1
# A height that nothing flies at: where a cell counts heights in tenths of a metre.
_HIGHEST_M = 6000.0


@dataclass(frozen=True, kw_only=True)
class HeightLattice:
    """Heights over a grid of square cells.

    At or above the height of its cell, a point keeps the clearance from every building and every
    no-fly zone. Below it, it may or may not: the exact check decides. Ways of UAVs are looked up
    here first.

    Attributes:
        west_m: West border of the first column (south_m: south border of the first row).
        cell_m: Side of a cell.
        clearance_m: What is kept from obstacles.
        free_above_dm: Rows from south, columns from west, tenths of a metre; 0 = free everywhere.
    """

    west_m: float
    south_m: float
    cell_m: float
    clearance_m: float
    free_above_dm: npt.NDArray[np.uint16]

    def free_above_m(self, xy: FloatArray) -> FloatArray:
        """Return above which height points (N, 2) are free, metres; infinite off the grid."""
        rows, columns = self.free_above_dm.shape
        column = np.floor((xy[:, 0] - self.west_m) / self.cell_m)
        row = np.floor((xy[:, 1] - self.south_m) / self.cell_m)
        inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
        out = np.full(len(xy), np.inf)
        cells = self.free_above_dm[row[inside].astype(int), column[inside].astype(int)]
        out[inside] = cells * _STEP_M
        return out

    def frees_way(self, start: FloatArray, end: FloatArray) -> bool:
        """Tell whether a straight way surely keeps the clearance all along.

        The way is looked at once per cell length, each time with the cells around, so that no
        cell that it touches is left out. False says nothing: the exact check decides.

        Args:
            start: (3,) ENU metres.
            end: (3,) ENU metres.
        """
        length_m = float(np.linalg.norm(end - start))
        if not np.isfinite(length_m):
            return False
        count = 1 + int(np.ceil(length_m / self.cell_m))
        points = start + np.linspace(0.0, 1.0, count)[:, None] * (end - start)
        lowest_m = points[:, 2] - (self.cell_m / 2.0 if start[2] != end[2] else 0.0)
        return bool((lowest_m >= self._around.free_above_m(points[:, :2])).all())

    @cached_property
    def _around(self) -> HeightLattice:
        """The same with the height of the highest cell around each; beyond the grid is none."""
        rows, columns = self.free_above_dm.shape
        wide = np.pad(self.free_above_dm, 1, constant_values=np.iinfo(np.uint16).max)
        highest = self.free_above_dm
        for row in range(3):
            for column in range(3):
                highest = np.maximum(highest, wide[row : row + rows, column : column + columns])
        return replace(self, free_above_dm=highest)

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """Return everything as arrays, by name."""
        frame = [self.west_m, self.south_m, self.cell_m, self.clearance_m]
        return {'frame_m': np.array(frame), 'free_above_dm': self.free_above_dm}

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, npt.NDArray[Any]]) -> Self:
        """Return a lattice from its arrays.

        Raises:
            MapError: An array is missing or has another shape.
        """
        try:
            west, south, cell, clearance = (float(v) for v in arrays['frame_m'])
            heights = arrays['free_above_dm']
        except (KeyError, ValueError, TypeError) as err:
            raise MapError(f'a height lattice has other arrays: {err}') from err
        if heights.ndim != 2 or heights.dtype != np.uint16 or not cell > 0.0:
            raise MapError('a height lattice is a table of 16-bit tenths of a metre')
        return cls(
            west_m=west,
            south_m=south,
            cell_m=cell,
            clearance_m=clearance,
            free_above_dm=heights,
        )


def height_lattice(model: MapModel, clearance_m: float) -> HeightLattice:
    """Return the lattice of a map: of each cell the highest obstacle that is near enough.

    Args:
        model: Map.
        clearance_m: What is kept from obstacles.
    """
    west, south, east, north = model.bounds_m
    cell_m = _cell_m(east - west, north - south)
    columns, rows = _cells(east - west, cell_m), _cells(north - south, cell_m)
    x = west + cell_m * np.arange(columns)
    y = south + cell_m * np.arange(rows)
    grid_x, grid_y = np.meshgrid(x, y)
    cells = shapely.box(grid_x, grid_y, grid_x + cell_m, grid_y + cell_m).ravel()
    shapes = [shapely.Polygon(b.ring, b.holes) for b in model.buildings]
    shapes += [shapely.Polygon(z.ring) for z in model.zones]
    tops = [b.height_m for b in model.buildings] + [z.ceiling_m for z in model.zones]
    highest = np.zeros(len(cells))
    if shapes:
        cell, shape = shapely.STRtree(shapes).query(
            cells, predicate='dwithin', distance=clearance_m + _SLACK_M
        )
        reach = np.minimum(np.array(tops) + clearance_m + _SLACK_M, _HIGHEST_M)
        np.maximum.at(highest, cell, reach[shape])
    return HeightLattice(
        west_m=west,
        south_m=south,
        cell_m=cell_m,
        clearance_m=clearance_m,
        free_above_dm=np.ceil(highest / _STEP_M).astype(np.uint16).reshape(rows, columns),
    )


def _cell_m(wide_m: float, high_m: float) -> float:
    """Return the side of a cell of a map: the usual one, or a multiple of it."""
    cell_m = CELL_M
    while _cells(wide_m, cell_m) * _cells(high_m, cell_m) > _MOST_CELLS:
        cell_m *= 2.0
    return cell_m


def _cells(length_m: float, cell_m: float) -> int:
    return max(1, int(np.ceil(length_m / cell_m)))
