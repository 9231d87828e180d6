# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""By how much an agent is at, on or before a place."""

from __future__ import annotations

import numpy as np

from aurora_core.knowledge.world import SurfaceKind
from aurora_core.monitor.evaluation import Context, FloatArray
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.lanes import edge_of, edges_with_several_lanes, inside_lanes_m
from aurora_core.quantities.routes import planned_route
from aurora_core.spec.vocabulary import Place, Relation

# Farther than this from what is meant, the distance is not told apart (m).
_CUTOFF_M = 200.0

_SURFACES = {Place.CROSSWALK: SurfaceKind.CROSSING}


def place_slack(context: Context, condition: Condition) -> FloatArray:
    """Return by how much an agent is where a placement says, (T,) metres; negative outside.

    Near, at: what is left of the distance to the place. On, parked at: depth in the crosswalk,
    what is left of a lane of a street with several lanes (main road) or of the strip along the
    carriageway (roadside); other places have a point, as with `at`. Before: see `before_place`.
    """
    view, arguments = context.view, condition.arguments
    name, place = condition.of
    if arguments.relation is Relation.BEFORE:
        lead_m, offset_m = before_place(context, condition)
        left = arguments.offset_m - offset_m
        slack = lead_m if left >= 0.0 else min(lead_m, left)
        return np.full(view.ticks, slack)
    on = arguments.relation in (Relation.ON, Relation.PARKED_AT)
    point = view.reference(name)[:, :2]
    if on and place == Place.MAIN_ROAD:
        return _main_road(context, point)
    if on and place == Place.ROADSIDE:
        edge = view.geometry.surfaces(SurfaceKind.DRIVING).signed_distance(point, _CUTOFF_M)
        return arguments.high - np.abs(edge)
    if on and place in _SURFACES:
        surface = view.geometry.surfaces(_SURFACES[Place(place)])
        return -surface.signed_distance(point, _CUTOFF_M)
    return arguments.high - motion.horizontal_distance(view, name, place)


def before_place(context: Context, condition: Condition) -> tuple[float, float]:
    """Return how far a place is ahead on the route of an agent at t = 0, and how far off it, m."""
    view = context.view
    name, place = condition.of
    route = planned_route(view, view.body(name))
    own, other = view.reference(name)[0].tolist(), view.reference(place)[0].tolist()
    own_s, _ = route.project(own[0], own[1], 0.0, _CUTOFF_M, extend=True)
    place_s, offset_m = route.project(other[0], other[1], extend=True)
    return place_s - own_s, abs(offset_m)


def _main_road(context: Context, point: FloatArray) -> FloatArray:
    """Return what is left of the nearest lane of a street with several lanes per direction."""
    world = context.view.world
    wide = edges_with_several_lanes(world)
    lanes = [lane for lane in world.lanes if edge_of(lane) in wide]
    if not lanes:
        return np.full(len(point), -_CUTOFF_M)
    return np.maximum(inside_lanes_m(lanes, point), -_CUTOFF_M)
