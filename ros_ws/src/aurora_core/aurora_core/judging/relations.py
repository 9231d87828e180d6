# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""By how much a relation between an agent and another one, or a place, holds."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.geometry.polyline import Polyline
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.angle import bearing_error_deg, compass_bearing_deg
from aurora_core.quantities.lanes import edge_of, edges_with_several_lanes, inside_lanes_m
from aurora_core.quantities.routes import planned_route
from aurora_core.quantities.view import RunView
from aurora_core.spec.vocabulary import Place, Relation
from aurora_core.trace.layout import GroundColumn

# Relations of two agents with a slack in metres (`oncoming`: cosine) at every sample.
RELATION_WORDS = {
    Relation.AHEAD: 'ahead of',
    Relation.BEHIND: 'behind',
    Relation.SAME_LANE: 'in the lane of',
    Relation.LEFT: 'to the left of',
    Relation.RIGHT: 'to the right of',
    Relation.BESIDE: 'beside',
    Relation.ONCOMING: 'oncoming to',
    Relation.NEAR: 'near',
    Relation.AT: 'at',
    Relation.ADJACENT_LANE: 'in a lane next to that of',
    Relation.BEFORE: 'before',
    Relation.ON: 'on',
    Relation.PARKED_AT: 'parked at',
}

# Farther than this from what is meant, the distance is not told apart (m).
_CUTOFF_M = 200.0
# A route passes a place where it comes so nearly as near (m) as it ever does; it is looked for in
# pieces of such a length (m). Part of what "before" means: no tolerance of a site.
_PASS_M = 10.0
_PASS_WINDOW_M = 50.0

# Kinds of ground, which have no point: at them is on them.
_GROUNDS = (Place.SIDEWALK, Place.ROADSIDE)

_SURFACES = {Place.CROSSWALK: SurfaceKind.CROSSING, Place.SIDEWALK: SurfaceKind.SIDEWALK}


class Related(Protocol):
    """A relation as a condition asks for it."""

    @property
    def relation(self) -> Relation:
        """Which one."""

    @property
    def offset_m(self) -> float:
        """How far from a route a body may be."""

    @property
    def near_m(self) -> float:
        """How far apart is still near, or at."""


def relation_slack(context: Context, condition: Condition, asked: Related) -> FloatArray:
    """Return by how much a relation of two agents holds, (T,) metres; negative where it does not.

    Ahead, behind: along the route of the one that follows, on that route; of a person and a
    vehicle, along that of the vehicle. Same lane: what is left of the lane to the offset. Left,
    right, beside: in the frame of the other one's heading. Oncoming: minus the cosine of the
    headings. Near, at: what is left of the distance. Adjacent lane: what is left of the lane next
    to the route of the other one, in its direction. For
    places see `_place_slack`.
    """
    view = context.view
    a, b = condition.of
    relation = asked.relation
    if not view.has(b):
        return _place_slack(context, condition, asked)
    if relation in (Relation.AHEAD, Relation.BEHIND, Relation.BEFORE):
        lead_m, offset_m = lead_of(context, a, b, ahead=relation is Relation.AHEAD)
        left = asked.offset_m - offset_m
        return np.where(left >= 0.0, lead_m, np.minimum(lead_m, left))
    if relation is Relation.SAME_LANE:
        return asked.offset_m - context.along(b, a).offset_m
    if relation in (Relation.NEAR, Relation.AT):
        return asked.near_m - motion.horizontal_distance(view, a, b)
    own, other = view.rows(view.body(a)), view.rows(view.body(b))
    hx, hy = other[:, GroundColumn.HEADING_X], other[:, GroundColumn.HEADING_Y]
    if relation is Relation.ONCOMING:
        gx, gy = own[:, GroundColumn.HEADING_X], own[:, GroundColumn.HEADING_Y]
        return -(gx * hx + gy * hy)
    if relation is Relation.ADJACENT_LANE:
        offset = context.along(b, a).offset_m
        beside = asked.offset_m - np.abs(offset - 2.0 * asked.offset_m)
        same_way = own[:, GroundColumn.HEADING_X] * hx + own[:, GroundColumn.HEADING_Y] * hy > 0.0
        return np.where(same_way, beside, np.minimum(beside, -offset))
    along_m, left_m = _in_frame_of(own, other)
    # Who is right behind somebody is on neither side: one is beyond its flank.
    flank_m = view.body(b).entry.width_m / 2.0
    if relation is Relation.LEFT:
        return left_m - flank_m
    if relation is Relation.RIGHT:
        return -left_m - flank_m
    if relation is Relation.BESIDE:
        return _half_lengths_m(view, a, b) - np.abs(along_m)
    raise VerificationError(f'condition {condition.id}: no signal for relation {relation}')


def abreast_slack(context: Context, condition: Condition) -> FloatArray:
    """Return by how much one agent is level with another one or within 45° of that, (T,) m."""
    a, b = condition.of
    view = context.view
    along_m, left_m = _in_frame_of(view.rows(view.body(a)), view.rows(view.body(b)))
    return np.maximum(_half_lengths_m(view, a, b), np.abs(left_m)) - np.abs(along_m)


def _in_frame_of(own: FloatArray, other: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how far one is ahead of another one, and to its left, by its heading (m)."""
    hx, hy = other[:, GroundColumn.HEADING_X], other[:, GroundColumn.HEADING_Y]
    dx = own[:, GroundColumn.X] - other[:, GroundColumn.X]
    dy = own[:, GroundColumn.Y] - other[:, GroundColumn.Y]
    return dx * hx + dy * hy, dy * hx - dx * hy


def _half_lengths_m(view: RunView, a: str, b: str) -> float:
    return (view.body(a).entry.length_m + view.body(b).entry.length_m) / 2.0


def lead_of(context: Context, a: str, b: str, *, ahead: bool) -> tuple[FloatArray, FloatArray]:
    """Return how far `a` is ahead of `b`, or behind it, and how far off the route, (T,) metres.

    A person's own way may lead over the street: then it says nothing of ahead and behind.
    """
    walks = {name: context.view.body(name).entry.is_person for name in (a, b)}
    if ahead or (walks[a] and not walks[b]):
        along = context.along(b, a)
        return (along.lead_m if ahead else -along.lead_m), along.offset_m
    along = context.along(a, b)
    return along.lead_m, along.offset_m


def _place_slack(context: Context, condition: Condition, asked: Related) -> FloatArray:
    """Return by how much an agent is where a placement says, (T,) metres; negative outside.

    Near, at, beside: what is left of the distance to the place. On, parked at, and at a kind of
    ground: depth in the crosswalk or the sidewalk, what is left of a lane of a street with
    several lanes (main road) or of the strip along the carriageway (roadside); other places have
    a point, as with `at`. Before: see `before_place`.
    """
    view = context.view
    name, place = condition.of
    if asked.relation is Relation.BEFORE:
        lead_m, offset_m = before_place(context, condition)
        left = asked.offset_m - offset_m
        slack = lead_m if left >= 0.0 else min(lead_m, left)
        return np.full(view.ticks, slack)
    on = asked.relation in (Relation.ON, Relation.PARKED_AT) or place in _GROUNDS
    point = view.reference(name)[:, :2]
    if on and place == Place.MAIN_ROAD:
        return _main_road(context, point)
    if on and place == Place.ROADSIDE:
        edge = view.geometry.surfaces(SurfaceKind.DRIVING).signed_distance(point, _CUTOFF_M)
        return asked.near_m - np.abs(edge)
    if on and place in _SURFACES:
        surface = view.geometry.surfaces(_SURFACES[Place(place)])
        return -surface.signed_distance(point, _CUTOFF_M)
    return asked.near_m - motion.horizontal_distance(view, name, place, on_road=True)


def before_place(context: Context, condition: Condition) -> tuple[float, float]:
    """Return how far a place is ahead on the route of an agent at t = 0, and how far off it, m.

    A route that goes round comes by several times, and the first time counts.
    """
    view = context.view
    name, place = condition.of
    route = planned_route(view, view.body(name))
    own = view.reference(name)[0].tolist()
    other = (view.reference(name) - view.between(name, place, on_road=True))[0].tolist()
    own_s, _ = route.project(own[0], own[1], 0.0, _CUTOFF_M, extend=True)
    place_s, offset_m = route.project(other[0], other[1], extend=True)
    low = own_s
    while low + _PASS_WINDOW_M < place_s:
        found_s, off_m = _nearest_between(route, other, low, low + _PASS_WINDOW_M)
        if abs(off_m) <= abs(offset_m) + _PASS_M:
            found_s, off_m = _nearest_between(route, other, found_s, found_s + _PASS_WINDOW_M)
            return found_s - own_s, abs(off_m)
        low += _PASS_WINDOW_M
    return place_s - own_s, abs(offset_m)


def _nearest_between(
    route: Polyline, point: list[float], low_s: float, high_s: float
) -> tuple[float, float]:
    """Return the place of a route between two arc lengths that is nearest to a point."""
    middle_s, reach_m = (low_s + high_s) / 2.0, (high_s - low_s) / 2.0
    return route.project(point[0], point[1], middle_s, reach_m)


def _main_road(context: Context, point: FloatArray) -> FloatArray:
    """Return what is left of the nearest lane of a street with several lanes per direction."""
    world = context.view.world
    wide = edges_with_several_lanes(world)
    lanes = [lane for lane in world.lanes if edge_of(lane) in wide]
    if not lanes:
        return np.full(len(point), -_CUTOFF_M)
    return np.maximum(inside_lanes_m(lanes, point), -_CUTOFF_M)


def bearing_error(context: Context, condition: Condition, bearing_deg: float) -> FloatArray:
    """Return how far the bearing of the first body from the second one is off, (T,) degrees."""
    a, b = condition.of
    delta = context.view.between(a, b)
    bearing = compass_bearing_deg(delta[:, 0], delta[:, 1])
    return bearing_error_deg(bearing, bearing_deg)


def lead_on_route(context: Context, follower: str, leader: str, offset_m: float) -> FloatArray:
    """Return by how much one body is ahead on the way of another one, (T,) metres.

    Where it is farther than `offset_m` off that way, at most by how much it is too far off,
    negative.
    """
    along = context.along(follower, leader)
    left = offset_m - along.offset_m
    ahead: FloatArray = np.where(left >= 0.0, along.lead_m, np.minimum(along.lead_m, left))
    return ahead
