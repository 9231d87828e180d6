# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Trajectories of a run and the region of action, ready to be drawn."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.trace.layout import GroundColumn, UavColumn, UavCommandColumn, UavPhase
from aurora_core.trace.roster import RosterEntry
from aurora_core.trace.trace import Trace

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

_MARGIN_M = 22.0
_LEAST_SIDE_M = 140.0
# A ground agent that drives on and on shall not shrink the flights to a dot.
_NEAR_M = 70.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Track:
    """A body's path.

    Attributes:
        entry: Roster entry.
        is_uav: UAVs are drawn by altitude.
        position_m: (T, 3) ENU metres, NaN while the body is absent or a sample is missing.
        phase: (T,) UAV phase of the command that led to the sample, -1 for ground agents.
        airborne: (T,) a UAV flies.
    """

    entry: RosterEntry
    is_uav: bool
    position_m: FloatArray
    phase: FloatArray
    airborne: BoolArray

    @property
    def name(self) -> str:
        """Id of the body."""
        return self.entry.body_id

    @property
    def is_background(self) -> bool:
        """Background traffic is drawn thin and does not widen the region."""
        return self.entry.role == 'background'

    def at(self, tick: int) -> tuple[float, float] | None:
        """Return the position in the plane at a tick, None when there is none."""
        if not 0 <= tick < len(self.position_m):
            return None
        x, y = self.position_m[tick, :2]
        return (float(x), float(y)) if np.isfinite(x) and np.isfinite(y) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A rectangle of the map, ENU metres."""

    west: float
    south: float
    east: float
    north: float

    @property
    def width(self) -> float:
        """West to east."""
        return self.east - self.west

    @property
    def height(self) -> float:
        """South to north."""
        return self.north - self.south

    def holds(self, x: float, y: float) -> bool:
        """Tell whether a point is inside."""
        return self.west <= x <= self.east and self.south <= y <= self.north

    def with_places(self, places: Iterable[tuple[float, float]], most: float) -> Box:
        """Return the box with places in it, too, as far as no side grows beyond a multiple.

        Args:
            places: The nearest come first.
            most: Of the sides of this box.
        """
        box = self

        def off(place: tuple[float, float]) -> float:
            x, y = place
            east, north = max(self.west - x, x - self.east), max(self.south - y, y - self.north)
            return max(east, north)

        for x, y in sorted(places, key=off):
            wider = Box(
                west=min(box.west, x - _MARGIN_M),
                south=min(box.south, y - _MARGIN_M),
                east=max(box.east, x + _MARGIN_M),
                north=max(box.north, y + _MARGIN_M),
            )
            if not box.holds(x, y) and (
                wider.width <= most * self.width and wider.height <= most * self.height
            ):
                box = wider
        return box

    def with_aspect(self, aspect: float) -> Box:
        """Return the least box around this one with the aspect ratio width / height."""
        width = max(self.width, self.height * aspect)
        height = max(self.height, self.width / aspect)
        x, y = (self.west + self.east) / 2, (self.south + self.north) / 2
        return Box(
            west=x - width / 2, south=y - height / 2, east=x + width / 2, north=y + height / 2
        )


def tracks_of(trace: Trace) -> tuple[Track, ...]:
    """Return all tracks, ground agents first, in roster order."""
    ticks = trace.ticks
    found = []
    for row, entry in enumerate(trace.roster.agents):
        states = trace.ground[:, row, :]
        position = np.zeros((ticks, 3))
        position[:, :2] = states[:, [GroundColumn.X, GroundColumn.Y]]
        position[~(states[:, GroundColumn.PRESENT] > 0.5)] = np.nan
        found.append(
            Track(
                entry=entry,
                is_uav=False,
                position_m=position,
                phase=np.full(ticks, -1.0),
                airborne=np.zeros(ticks, dtype=np.bool_),
            )
        )
    for row, entry in enumerate(trace.roster.uavs):
        states = trace.uav[:, row, :]
        found.append(
            Track(
                entry=entry,
                is_uav=True,
                position_m=states[:, UavColumn.X : UavColumn.Z + 1].copy(),
                phase=trace.uav_commands[:, row, UavCommandColumn.PHASE],
                airborne=~(states[:, UavColumn.LANDED] > 0.5),
            )
        )
    return tuple(found)


def mission_end_tick(tracks: tuple[Track, ...]) -> int:
    """Return the tick at which the last UAV begins its landing, else the last tick."""
    ticks = len(tracks[0].position_m) if tracks else 0
    ends = []
    for track in tracks:
        if track.is_uav:
            landing = np.flatnonzero(track.phase >= UavPhase.LANDING)
            ends.append(int(landing[0]) if len(landing) else ticks - 1)
    return max(ends, default=max(ticks - 1, 0))


def ways_of(tracks: tuple[Track, ...]) -> FloatArray:
    """Return points of all tracks (K, 2), every 20th of each (m, ENU)."""
    points = np.concatenate([*(t.position_m[::20, :2] for t in tracks), np.empty((0, 2))])
    known: FloatArray = points[np.isfinite(points).all(axis=1)]
    return known


def region_of(tracks: tuple[Track, ...], least_side_m: float = _LEAST_SIDE_M) -> Box:
    """Return the region of action: every flight, and the agents near it while missions last.

    Args:
        tracks: All bodies.
        least_side_m: Neither side is shorter.
    """
    end = mission_end_tick(tracks)
    flights = [_finite(track.position_m[:, :2]) for track in tracks if track.is_uav]
    ground = [
        _finite(track.position_m[: end + 1, :2])
        for track in tracks
        if not track.is_uav and not track.is_background
    ]
    if flights and any(len(flight) for flight in flights):
        core = _around(flights, _NEAR_M)
        starts = [way[:1] for way in ground]
        near = [way[[core.holds(float(x), float(y)) for x, y in way]] for way in ground]
        parts = [*flights, *starts, *near]
    else:
        parts = ground or [_finite(track.position_m[:, :2]) for track in tracks]
    region = _around(parts, _MARGIN_M)
    grow_x = max(0.0, (least_side_m - region.width) / 2)
    grow_y = max(0.0, (least_side_m - region.height) / 2)
    return Box(
        west=region.west - grow_x,
        south=region.south - grow_y,
        east=region.east + grow_x,
        north=region.north + grow_y,
    )


def _finite(points: FloatArray) -> FloatArray:
    kept: FloatArray = points[np.isfinite(points).all(axis=1)]
    return kept


def _around(parts: list[FloatArray], margin_m: float) -> Box:
    """Return the box of all points with a margin; around the origin when there is none."""
    points = np.concatenate([*parts, np.empty((0, 2))])
    if len(points) == 0:
        points = np.zeros((1, 2))
    (west, south), (east, north) = points.min(axis=0), points.max(axis=0)
    return Box(
        west=float(west) - margin_m,
        south=float(south) - margin_m,
        east=float(east) + margin_m,
        north=float(north) + margin_m,
    )


def beside(way_m: FloatArray, left_m: float) -> FloatArray:
    """Return a way shifted to its left, (T, 2); where it stands still it keeps the direction."""
    shifted = way_m.copy()
    if left_m == 0.0:
        return shifted
    direction = np.zeros(2)
    anchor: FloatArray | None = None
    normals = np.zeros_like(way_m)
    for k, point in enumerate(way_m):
        if not np.isfinite(point).all():
            continue
        if anchor is None:
            anchor = point
        step = point - anchor
        length = float(np.sqrt((step**2).sum()))
        if length > 2.0:
            direction, anchor = step / length, point
        normals[k] = (-direction[1], direction[0])
    moving = np.flatnonzero((normals != 0.0).any(axis=1))
    if len(moving):
        normals[: moving[0]] = normals[moving[0]]
    # A running mean, so that the line bends as smoothly as the way.
    kernel = np.ones(21) / 21.0
    padded = np.pad(normals, ((10, 10), (0, 0)), mode='edge')
    for axis in range(2):
        shifted[:, axis] += left_m * np.convolve(padded[:, axis], kernel, mode='valid')
    return shifted
