# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Positions of the places that a scenario names, on the grounded map."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

import shapely

from aurora_core.geometry.kernel import norm2
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Building
from aurora_core.knowledge.net_types import Crossing
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.reference import LANDMARK, is_landmark, is_place
from aurora_core.spec.scenario import ArrivalTrigger, DistanceTrigger, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, Place

Point2 = tuple[float, float]

# A point of the road is looked at where no vehicle stands on it at t = 0: this far from the centre
# of any. Half of the longest vehicle and room to look past it.
_CLEAR_M = 12.0

# The point is looked for along the way of the first vehicle, in such steps and so far (m).
ROAD_STEP_M = 5.0
ROAD_WAY_M = 200.0

# Who does not drive.
_ON_FOOT = (AgentType.PEDESTRIAN, AgentType.RSU)

# Places that are the road itself, wherever the scenario is.
ROADS = frozenset({Place.MAIN_ROAD, Place.ROADSIDE})

# Places that the anchor of a scenario decides: the nearest one is meant.
POINTS = (Place.INTERSECTION, Place.CROSSWALK)

# A landmark farther than this from the street that leads to it is come to on that street (m).
_OFF_STREET_M = 50.0

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
    names |= {place for m in spec.missions for place in (m.target, m.start)}
    names |= {name for c in spec.conditions for name in c.of if is_place(name)}
    for event in spec.events:
        names |= {getattr(event.trigger, name, None) for name in ('b', 'place', 'target')}
    bodies = {a.id for a in spec.agents} | {u.id for u in spec.uavs}
    road = (x, y)
    if names & ROADS:
        road = road_point(_way_on(grounded, road), [(a.x_m, a.y_m) for a in grounded.agents])
    places = MapPlaces(map_model)
    return {
        name: road if name in ROADS else places.point(name, (x, y))
        for name in sorted(n for n in names if n is not None and n not in bodies)
    }


def has_point(place: str | None) -> bool:
    """Tell whether a place is a point that one can be near, not a kind of ground."""
    return place in POINTS or is_landmark(place)


def arrivals(spec: ScenarioSpec, agent: GroundAgent) -> Iterator[ArrivalTrigger]:
    """Yield the triggers that wait for an agent to arrive somewhere.

    A vehicle that is to come near a roadside unit, or a person, at a landmark arrives at that.
    """
    units = {a.id: a for a in spec.agents if a.type in _ON_FOOT}
    for trigger in (event.trigger for event in spec.events):
        if isinstance(trigger, ArrivalTrigger) and trigger.who == agent.id:
            yield trigger
        elif isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_below':
            pair = (trigger.a, trigger.b)
            placements = [p for name in pair if name in units for p in units[name].placements]
            places = [p.of for p in placements if is_landmark(p.of)]
            if agent.id in pair and agent.type not in _ON_FOOT and places:
                yield ArrivalTrigger(on='arrives', who=agent.id, place=str(places[0]))


def road_point(way: Sequence[Point2], bodies: Sequence[Point2]) -> Point2:
    """Return the point that stands for the road: the first one on which no vehicle stands.

    Nobody can look at a point inside a vehicle, so the road is looked at before it.

    Args:
        way: Points along the road from the anchor on (x, y in m, ENU), at least one.
        bodies: Where the vehicles stand at t = 0.

    Returns:
        The last point where all are taken.
    """
    for x, y in way:
        if all(norm2(x - b[0], y - b[1]) >= _CLEAR_M for b in bodies):
            return x, y
    return way[-1]


def _way_on(grounded: GroundedScenario, anchor: Point2) -> tuple[Point2, ...]:
    """Return the points of the road from the anchor on, as far as somebody's route leads."""
    for agent in grounded.agents:
        if norm2(agent.x_m - anchor[0], agent.y_m - anchor[1]) < ROAD_STEP_M:
            line = Polyline(agent.route_xy_m)
            count = int(min(ROAD_WAY_M, line.length_m) / ROAD_STEP_M) + 1
            return tuple(line.at(k * ROAD_STEP_M)[:2] for k in range(count))
    return (anchor,)


class MapPlaces:
    """Where the places of a map are; what is looked up twice is worked out once.

    Args:
        map_model: Map.
    """

    def __init__(self, map_model: MapModel) -> None:
        self._map = map_model
        self._approaches: dict[str, Point2] = {}

    def itself(self, name: str, anchor: Point2) -> Point2:
        """Return where a place is (x, y in m, ENU), a landmark inside of its building, too.

        Whatever flies is at this point; arguments and errors as those of `point`.
        """
        if is_landmark(name):
            mark = self._map.landmark(name.removeprefix(LANDMARK))
            return mark.x_m, mark.y_m
        return self.point(name, anchor)

    def point(self, name: str, anchor: Point2) -> Point2:
        """Return where one is at a place on the ground (x, y in m, ENU).

        A place without a point is where the anchor is. To a landmark in a building one comes on
        the street before it.

        Args:
            name: Reference of the place.
            anchor: Of the scenario; of several intersections or crosswalks the nearest one counts.

        Raises:
            MapError: The map has no such landmark.
        """
        if is_landmark(name):
            return self._approach(name.removeprefix(LANDMARK))
        centres = {Place.INTERSECTION: self.intersections, Place.CROSSWALK: self.crosswalks}
        known = centres[Place(name)] if name in POINTS else ()
        return nearest_to(anchor, known) if known else anchor

    def building(self, name: str) -> Building | None:
        """Return the building that a landmark is, None for all other places."""
        if not is_landmark(name):
            return None
        plain = name.removeprefix(LANDMARK)
        return next((b for b in self._map.buildings if b.name == plain), None)

    def crossing_near(self, anchor: Point2) -> Crossing | None:
        """Return the crosswalk nearest to the anchor, None where the map has none."""
        if not self.crosswalks:
            return None
        nearest = self.crosswalks.index(nearest_to(anchor, self.crosswalks))
        return self._map.network.crossings[nearest]

    @cached_property
    def intersections(self) -> tuple[Point2, ...]:
        """Centres of all intersections (x, y in m, ENU), by their ids."""
        ways: dict[str, set[str]] = {}
        for edge in self._map.network.edges.values():
            if not edge.is_internal:
                ways.setdefault(edge.from_junction, set()).add(edge.to_junction)
                ways.setdefault(edge.to_junction, set()).add(edge.from_junction)
        crossing = [name for name, onward in ways.items() if len(onward) >= _CROSSING_WAYS]
        junctions = [self._map.network.junction(name) for name in sorted(crossing)]
        return tuple((j.x_m, j.y_m) for j in junctions)

    @cached_property
    def crosswalks(self) -> tuple[Point2, ...]:
        """Middles of all crosswalks (x, y in m, ENU), by their ids."""
        lines = [crossing.centre_line for crossing in self._map.network.crossings]
        ends = [(line[0], line[-1]) for line in lines]
        return tuple(((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0) for a, b in ends)

    def _approach(self, name: str) -> Point2:
        if name not in self._approaches:
            self._approaches[name] = approach_point(self._map, name)
        return self._approaches[name]


def approach_point(map_model: MapModel, name: str) -> Point2:
    """Return where one is at a landmark on the ground: itself, or the street that leads to it.

    That is so where it is a building, or so wide (a park) that no street comes near its middle.

    Raises:
        MapError: The map has no such landmark.
    """
    mark = map_model.landmark(name)
    x, y, _, _ = map_model.network.position_on_lane(mark.approach_lane_id, mark.approach_pos_m)
    if norm2(x - mark.x_m, y - mark.y_m) > _OFF_STREET_M:
        return x, y
    point = shapely.Point(mark.x_m, mark.y_m)
    around = (b for b in map_model.buildings if b.has_in_box(mark.x_m, mark.y_m))
    if any(shapely.Polygon(b.ring).contains(point) for b in around):
        return x, y
    return mark.x_m, mark.y_m


def nearest_to(anchor: Point2, centres: Sequence[Point2]) -> Point2:
    """Return the centre nearest to a point; of equally near ones the first."""
    return min(centres, key=lambda c: norm2(c[0] - anchor[0], c[1] - anchor[1]))
