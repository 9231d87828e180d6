# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Positions of the places that a scenario names, on the grounded map."""

from __future__ import annotations

import shapely

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.grounded import GroundedScenario
from aurora_core.knowledge.map_model import MapModel
from aurora_core.spec.scenario import ScenarioSpec

# Streets cross where at least this many ways lead on; the end of a street is no intersection.
_CROSSING_WAYS = 3


def place_positions(
    spec: ScenarioSpec, map_model: MapModel, grounded: GroundedScenario
) -> dict[str, tuple[float, float]]:
    """Return x, y (m, ENU) of every place that a placement, mission or trigger refers to."""
    x, y, _, _ = map_model.network.position_on_lane(
        grounded.anchor_lane, grounded.anchor_position_m
    )
    names = {p.of for a in spec.agents for p in a.placements}
    names |= {b.target for a in spec.agents for b in a.behaviors}
    names |= {m.target for m in spec.missions}
    for event in spec.events:
        names |= {getattr(event.trigger, name, None) for name in ('b', 'place', 'target')}
    bodies = {a.id for a in spec.agents} | {u.id for u in spec.uavs}
    return {
        name: _position(name, map_model, (x, y))
        for name in sorted(n for n in names if n is not None and n not in bodies)
    }


def landmark_point(map_model: MapModel, name: str) -> tuple[float, float]:
    """Return where a landmark is on the ground: itself, or the street before its building.

    Nobody can look at a point inside a building, so a landmark that is one stands for the place in
    front of it.

    Raises:
        MapError: The map has no such landmark.
    """
    mark = map_model.landmark(name)
    point = shapely.Point(mark.x_m, mark.y_m)
    if any(shapely.Polygon(b.ring).contains(point) for b in map_model.buildings):
        x, y, _, _ = map_model.network.position_on_lane(mark.approach_lane_id, mark.approach_pos_m)
        return x, y
    return mark.x_m, mark.y_m


def intersection_point(map_model: MapModel, anchor: tuple[float, float]) -> tuple[float, float]:
    """Return the centre of the intersection nearest to the anchor (x, y in m, ENU)."""
    ways: dict[str, set[str]] = {}
    for edge in map_model.network.edges.values():
        if not edge.is_internal:
            ways.setdefault(edge.from_junction, set()).add(edge.to_junction)
            ways.setdefault(edge.to_junction, set()).add(edge.from_junction)
    crossing = [name for name, onward in ways.items() if len(onward) >= _CROSSING_WAYS]
    junctions = [map_model.network.junction(name) for name in crossing]
    near = min(junctions, key=lambda j: (norm2(j.x_m - anchor[0], j.y_m - anchor[1]), j.id))
    return near.x_m, near.y_m


def _position(name: str, map_model: MapModel, anchor: tuple[float, float]) -> tuple[float, float]:
    if name.startswith('landmark:'):
        return landmark_point(map_model, name.removeprefix('landmark:'))
    if name == 'intersection':
        return intersection_point(map_model, anchor)
    return anchor
