# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Distances of a trace, by code of the campaign's own: what honest claims would say."""

from __future__ import annotations

from dataclasses import replace
from math import dist

from aurora_core.knowledge.world import WorldModel
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.trace import Trace

Point = tuple[float, float, float]

# Heights at which a person and a place are looked at (m); vehicles at half of theirs.
_PERSON_M = 1.0
_PLACE_M = 1.0


def reference(trace: Trace, world: WorldModel, name: str, tick: int) -> Point:
    """Return where a body or place is, ENU metres."""
    row = trace.roster.uav_index(name)
    if row is not None:
        x, y, z = trace.uav[tick, row, UavColumn.X : UavColumn.Z + 1].tolist()
        return x, y, z
    row = trace.roster.agent_index(name)
    if row is not None:
        x, y = trace.ground[tick, row, GroundColumn.X : GroundColumn.Y + 1].tolist()
        return x, y, 0.0
    place = next(place for place in world.places if place.name == name)
    return place.x_m, place.y_m, 0.0


def sight_point(trace: Trace, world: WorldModel, name: str, tick: int) -> Point:
    """Return where a body or place is looked at."""
    x, y, z = reference(trace, world, name, tick)
    row = trace.roster.agent_index(name)
    if row is None:
        return (x, y, z) if trace.roster.uav_index(name) is not None else (x, y, _PLACE_M)
    entry = trace.roster.agents[row]
    return x, y, _PERSON_M if entry.is_person else entry.height_m / 2.0


def distance_m(trace: Trace, world: WorldModel, a: str, b: str, tick: int) -> float:
    """Return the distance of two bodies."""
    return dist(reference(trace, world, a, tick), reference(trace, world, b, tick))


def retold(trace: Trace, world: WorldModel) -> Trace:
    """Return a trace whose claims state the distances that its states have."""
    last = trace.ticks - 1
    return replace(
        trace,
        links=tuple(
            replace(
                r, distance_m=distance_m(trace, world, r.sender, r.receiver, min(r.tick, last))
            )
            for r in trace.links
        ),
        sights=tuple(
            replace(
                r,
                slant_range_m=dist(
                    reference(trace, world, r.observer, min(r.tick, last)),
                    sight_point(trace, world, r.target, min(r.tick, last)),
                ),
            )
            for r in trace.sights
        ),
    )
