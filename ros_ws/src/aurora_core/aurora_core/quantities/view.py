# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recorded run seen body by body: positions, presence, sight points, completeness."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.errors import VerificationError
from aurora_core.knowledge.world import WorldModel
from aurora_core.quantities.kernels import SightEnd, eye_height, sight_height
from aurora_core.quantities.ticks import TICK_GUARD
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.records import ScenarioEventKind
from aurora_core.trace.roster import RosterEntry
from aurora_core.trace.trace import Trace

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Series = tuple[npt.NDArray[Any], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """A body of the run: its roster entry and its row."""

    body_id: str
    row: int
    is_uav: bool
    entry: RosterEntry

    @property
    def sight_end(self) -> SightEnd:
        """What the body is as the end of a sight line."""
        if self.is_uav:
            return SightEnd.UAV
        return SightEnd.PERSON if self.entry.is_person else SightEnd.VEHICLE

    @property
    def looks_ahead(self) -> bool:
        """Whether it sees what is ahead of it alone, as a driver does."""
        return not self.is_uav and self.entry.has_driver


class RunView:
    """States of a run and the world they happened in.

    Args:
        trace: The run.
        world: Its world.
        geometry: Solids of that world if they are built already.
    """

    def __init__(
        self, trace: Trace, world: WorldModel, geometry: WorldGeometry | None = None
    ) -> None:
        self.trace = trace
        self.world = world
        self.geometry = geometry if geometry is not None else WorldGeometry(world)
        self._bodies = {
            entry.body_id: Body(body_id=entry.body_id, row=row, is_uav=is_uav, entry=entry)
            for entries, is_uav in ((trace.roster.agents, False), (trace.roster.uavs, True))
            for row, entry in enumerate(entries)
        }
        self._series: dict[tuple[str, ...], Series] = {}

    def series(
        self, key: tuple[str, ...], compute: Callable[[RunView], Series], *, before: int = 0
    ) -> Series:
        """Return series that are costly, worked out once however many signals ask for them.

        Args:
            key: Names the series.
            compute: Works them out, (T,) each, sample by sample: what it returns for a run that
                goes on begins with what it returns for the run so far.
            before: Samples before one on which its values depend.
        """
        if key not in self._series:
            self._series[key] = compute(self)
        return self._series[key]

    @property
    def dt_s(self) -> float:
        """Time step."""
        return self.trace.roster.dt_s

    @property
    def ticks(self) -> int:
        """Number of samples T."""
        return self.trace.ticks

    @property
    def agents(self) -> tuple[Body, ...]:
        """Ground bodies in row order."""
        return tuple(self._bodies[entry.body_id] for entry in self.trace.roster.agents)

    @property
    def uavs(self) -> tuple[Body, ...]:
        """UAVs in row order."""
        return tuple(self._bodies[entry.body_id] for entry in self.trace.roster.uavs)

    def has(self, body_id: str) -> bool:
        """Tell whether a body takes part."""
        return body_id in self._bodies

    def body(self, body_id: str) -> Body:
        """Return a body.

        Raises:
            VerificationError: It does not take part.
        """
        body = self._bodies.get(body_id)
        if body is None:
            raise VerificationError(
                f'the roster has no body {body_id!r}; it has {", ".join(sorted(self._bodies))}'
            )
        return body

    def rows(self, body: Body) -> FloatArray:
        """Return the state rows of a body, (T, GROUND_WIDTH) or (T, UAV_WIDTH)."""
        array = self.trace.uav if body.is_uav else self.trace.ground
        rows: FloatArray = array[:, body.row, :]
        return rows

    def commands(self, body: Body) -> FloatArray:
        """Return the command rows of a UAV, (T, UAV_COMMAND_WIDTH)."""
        rows: FloatArray = self.trace.uav_commands[:, body.row, :]
        return rows

    def between(self, a: str, b: str, *, on_road: bool = False) -> FloatArray:
        """Return the vectors from b to a, bodies or places, (T, 3) ENU metres.

        Args:
            a: Body or place.
            b: Body or place.
            on_road: Measure a body on the ground from where the road leads to a landmark, not
                from where it stands: to arrive there, or to be at it or near it, is to be there.
        """
        ends = {name: self.reference(name) for name in (a, b)}
        for place, body in ((a, b), (b, a)) if on_road else ():
            if self.has(body) and not self.has(place) and not self.body(body).is_uav:
                point = self.geometry.approach_point(place)
                assert point is not None  # it has a reference point
                ends[place][:, :2] = point
        return ends[a] - ends[b]

    def reference(self, name: str) -> FloatArray:
        """Return the reference point of a body or a place, (T, 3) ENU metres.

        Raises:
            VerificationError: There is no such body, and no place of that name either.
        """
        if not self.has(name):
            point = self.geometry.place_point(name)
            if point is not None:
                return np.tile(np.array([point[0], point[1], 0.0]), (self.ticks, 1))
        body = self.body(name)
        rows = self.rows(body)
        if body.is_uav:
            return np.ascontiguousarray(rows[:, UavColumn.X : UavColumn.Z + 1])
        flat = rows[:, GroundColumn.X : GroundColumn.Y + 1]
        return np.concatenate((flat, np.zeros((self.ticks, 1))), axis=1)

    def sight_point(self, name: str) -> FloatArray:
        """Return where a body or place is looked at, (T, 3) ENU metres."""
        point = self.reference(name)
        if not self.has(name):
            point[:, 2] = sight_height(SightEnd.PLACE, 0.0)
            return point
        body = self.body(name)
        if not body.is_uav:
            point[:, 2] = sight_height(body.sight_end, body.entry.height_m)
        return point

    def eye_point(self, name: str) -> FloatArray:
        """Return where a body looks from, (T, 3) ENU metres."""
        point, body = self.reference(name), self.body(name)
        if not body.is_uav:
            point[:, 2] = eye_height(body.sight_end, body.entry.height_m)
        return point

    def present(self, name: str) -> BoolArray:
        """Return where a body exists, (T,); UAVs and places always do."""
        if not self.has(name) or self.body(name).is_uav:
            return np.ones(self.ticks, dtype=np.bool_)
        present: BoolArray = self.rows(self.body(name))[:, GroundColumn.PRESENT] > 0.5
        return present

    @cached_property
    def first_missing_tick(self) -> int | None:
        """The first tick without a complete set of states or commands, None if all are there."""
        trace = self.trace
        bad = np.zeros(self.ticks, dtype=np.bool_)
        for array in (trace.ground, trace.uav, trace.uav_commands):
            bad |= ~np.isfinite(array).reshape(self.ticks, -1).all(axis=1)
        named = [tick for tick in trace.missing_ticks if 0 <= tick < self.ticks]
        bad[named] = True
        found = np.flatnonzero(bad)
        return int(found[0]) if len(found) else None

    def up_to(self, stop: int) -> RunView:
        """Return the run cut before tick `stop`, as if nothing had been recorded after it."""
        trace = self.trace
        cut = replace(
            trace.states(0, stop),
            links=tuple(record for record in trace.links if record.tick < stop),
            sights=tuple(record for record in trace.sights if record.tick < stop),
            events=tuple(record for record in trace.events if record.tick < stop),
            missing_ticks=(),
        )
        return RunView(cut, self.world, self.geometry)

    def complete(self, horizon_s: float) -> bool:
        """Tell whether the run went on to its horizon or was finished by the executor before."""
        reached = (self.ticks - 1) * self.dt_s >= horizon_s - TICK_GUARD
        return reached or any(
            record.kind is ScenarioEventKind.FINISHED for record in self.trace.events
        )
