# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places that vehicles stand at, pass, or stop at: what they ask of a site.

A place with a point (a landmark, the intersection, the crosswalk) binds a vehicle in two ways: a
placement says where it stands at t = 0, a behaviour or a trigger where its way has to lead.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import shapely

from aurora_core.geometry.frames import heading_to_sumo_angle
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.awaited import awaited_at, leaving
from aurora_core.grounding.entries import stops_for
from aurora_core.grounding.pace import own_speed_mps
from aurora_core.grounding.places import MapPlaces, arrivals, has_point
from aurora_core.grounding.sites import SeatedAgent, Site
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.route_path import RoutePath
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.parking import parks_after
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Relation

# Who stands somewhere all along is there from t = 0.
_STAYS = (BehaviorKind.WAIT, BehaviorKind.PARK)

# These lead to a place, others (circulate) go round it or nowhere.
_LEADS = (
    BehaviorKind.STOP,
    BehaviorKind.APPROACH,
    BehaviorKind.DRIVE,
    BehaviorKind.EMERGENCY_RUN,
    BehaviorKind.TURN_LEFT,
    BehaviorKind.TURN_RIGHT,
)

# A vehicle has at least this way to a place that it goes to, and at most that (m).
_WAY_M = (40.0, 260.0)

# Who stops where no place is named does so after this way (m), or before the way ends.
_STOP_AFTER_M = 60.0

# Who stops for somebody who crosses stands so far before the middle of the crosswalk (m, bumper).
_BEFORE_CROSSWALK_M = 4.0

# What a stated speed takes to be reached, to show and to be lost again (m/s^2, s, m/s^2).
_GAINS_MPS2, _SHOWS_S, _LOSES_MPS2 = 1.5, 8.0, 2.0

# Who is awaited within a distance comes at least this much nearer (m): ticks are that far apart.
_NEARER_M = 0.5

# Sites are so far apart where a place says exactly where a vehicle stands (m).
_NARROW_M = 2.5

# Who is to get farther than a distance from a place starts within this share of it.
_NEAR_SHARE = 0.8

# Where one stands at t = 0 is exact to less than this (m).
_AT_START_M = 0.5

# Share of a tolerance inside which a place is aimed at.
_SAFE = 0.8

# Steps in which a spot to stop at is looked for (m).
_STEP_M = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Bound:
    """What binds a vehicle to a place: within a distance, from t = 0 on or later.

    Attributes:
        place: Which place.
        within_m: At most so far from it.
        at_start: At t = 0; else on its way.
        beyond_m: At least so far from it.
        bearing_deg: Compass bearing from it, None: any.
        stops: It comes to a stop there.
        stated: The distance is stated: it counts from where a landmark stands, to the middle of a
            vehicle, not from the street before it.
    """

    place: str
    within_m: float
    at_start: bool
    beyond_m: float = 0.0
    bearing_deg: float | None = None
    stops: bool = False
    stated: bool = False


def stops(agent: GroundAgent) -> bool:
    """Tell whether a vehicle is to come to a stop by itself, not by an event."""
    return any(b.kind is BehaviorKind.STOP for b in agent.behaviors)


def _told(value: Parameter | None) -> Parameter | None:
    """Return a value that the prompt states, None for defaults."""
    return value if value is not None and value.provenance is Provenance.EXPLICIT else None


def stop_after_m(agent: GroundAgent) -> float:
    """Return how far a vehicle drives that stops at no place that is named, metres.

    A stated speed shows before that.
    """
    speed_mps = own_speed_mps(agent) or 0.0
    way_m = speed_mps * speed_mps / 2.0 * (1.0 / _GAINS_MPS2 + 1.0 / _LOSES_MPS2)
    return max(_STOP_AFTER_M, way_m + _SHOWS_S * speed_mps)


class GoalFinder:
    """Asks of sites what places mean for the vehicles on them.

    Args:
        map_model: Map.
        types: Agent sizes.
        tolerances: How near is near, and at.
        settings: How far inside that one stops, and how long a way may be.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        tolerances: Tolerances,
        settings: GroundingSettings,
    ) -> None:
        self._map = map_model
        self._places = MapPlaces(map_model)
        self._types = types
        self._tolerances = tolerances
        self._arrival_m = tolerances.arrival_m - settings.inside_bound_m
        self._start_m = tolerances.arrival_m - _AT_START_M
        # Where no street leads straight on to a place.
        self._wide_m = (_WAY_M[0], settings.longest_way_m)

    def fits(
        self,
        spec: ScenarioSpec,
        site: Site,
        anchor: tuple[float, float] | None = None,
        *,
        wide: bool = False,
    ) -> bool:
        """Tell whether every vehicle of a site stands at, and comes to, its places.

        Args:
            spec: The request.
            site: Where the vehicles stand.
            anchor: Of the scene, x and y in m; the origin of the site when not given.
            wide: A long way does, too.
        """
        x, y = site.origin()[:2] if anchor is None else anchor
        for seat in site.seated:
            for bound in self._bounds(spec, seat.agent):
                point = self._point(bound, (x, y))
                if bound.at_start:
                    if not self._stands(seat, point, bound):
                        return False
                elif self._arc_near(seat, point, bound, wide=wide) is None:
                    return False
        return True

    def points(
        self, spec: ScenarioSpec, agents: Iterable[GroundAgent], anchor: tuple[float, float]
    ) -> tuple[tuple[float, float], ...]:
        """Return the points that the places of vehicles count from, x and y in m.

        All that `fits` knows of an anchor: with the same points, it gives the same answer.
        """
        bounds = (bound for agent in agents for bound in self._bounds(spec, agent))
        return tuple(self._point(bound, anchor) for bound in bounds)

    def leads(
        self,
        spec: ScenarioSpec,
        site: Site,
        anchor: tuple[float, float] | None = None,
        *,
        wide: bool = False,
    ) -> bool:
        """Tell whether everybody on a site comes to where an event waits for it.

        Args:
            spec: The request.
            site: Where the vehicles stand.
            anchor: Of the scene, x and y in m; the origin of the site when not given.
            wide: A long way does, too.
        """
        at = site.origin()[:2] if anchor is None else anchor
        for awaited in awaited_at(spec):
            seat = next((s for s in site.seated if s.agent.id == awaited.agent), None)
            if seat is None:
                continue
            within_m, stated = self._arrival_m, awaited.within_m is not None
            point = self._places.itself(awaited.place, at)
            if awaited.within_m is None:
                point = self._places.point(awaited.place, at)
            else:
                here = seat.path.position_at(seat.arc_m)
                if norm2(here[0] - point[0], here[1] - point[1]) <= awaited.within_m:
                    return False  # it would hold from the start on
                within_m = awaited.within_m - _NEARER_M
            bound = _Bound(place=awaited.place, within_m=within_m, at_start=False, stated=stated)
            if self._arc_near(seat, point, bound, wide=wide) is None:
                return False
        return True

    def edges_on_the_way(
        self, spec: ScenarioSpec, agents: Sequence[GroundAgent]
    ) -> tuple[frozenset[str], ...]:
        """Return the edges at each landmark that agents come to, in the order of the request.

        Of an intersection or a crosswalk there is one on every way.
        """
        names = {agent.id for agent in agents}
        bounds = (b for agent in agents for b in self._bounds(spec, agent))
        wanted = {b.place: b.within_m for b in bounds if not b.at_start and is_landmark(b.place)}
        for awaited in awaited_at(spec):
            if awaited.agent in names and is_landmark(awaited.place):
                within_m = (
                    self._tolerances.arrival_m if awaited.within_m is None else (awaited.within_m)
                )
                wanted.setdefault(awaited.place, within_m)
        vclasses = {self._types[agent.type.value].vclass for agent in agents}
        found = []
        for place, within_m in wanted.items():
            x, y = self._places.point(place, (0.0, 0.0))
            lanes = (
                lane
                for vclass in sorted(vclasses)
                for lane in self._map.network.driving_lanes(vclass)
            )
            found.append(
                frozenset(
                    lane.edge_id
                    for lane in lanes
                    if shapely.LineString(lane.polyline).distance(shapely.Point(x, y)) <= within_m
                )
            )
        return tuple(edges for edges in found if edges)

    def spacing_m(self, spec: ScenarioSpec, default_m: float) -> float:
        """Return how far apart sites may be, so that some of them is where a place asks."""
        bounds = (b for agent in spec.agents for b in self._bounds(spec, agent))
        widths = [b.within_m - b.beyond_m for b in bounds if b.at_start]
        narrow = _NARROW_M if any(width_m < default_m for width_m in widths) else default_m
        return min([narrow, *(width_m for width_m in widths if width_m > 0.0)])

    def places_of(self, spec: ScenarioSpec, name: str) -> tuple[str, ...]:
        """Return the places with a point that a vehicle is bound to."""
        agents = (agent for agent in spec.agents if agent.id == name)
        bounds = (bound.place for agent in agents for bound in self._bounds(spec, agent))
        return tuple(dict.fromkeys(bounds))

    def stop_arc_m(self, spec: ScenarioSpec, site: Site, seat: SeatedAgent) -> float | None:
        """Return where on its way a vehicle stops (m), None when it does not by itself."""
        x, y, _, _ = site.origin()
        if not stops(seat.agent) and parks_after(spec, seat.agent) is None:
            return self._met_arc_m(spec, (x, y), seat)
        for bound in self._bounds(spec, seat.agent):
            if bound.stops:
                point = self._point(bound, (x, y))
                near = self._arc_near(seat, point, bound)
                return near or self._arc_near(seat, point, bound, wide=True)
        after_m = seat.arc_m + stop_after_m(seat.agent)
        if stops_for(spec, seat.agent):
            after_m = min([after_m, *self._crossed_m(site, seat)])
        return self.open_arc_m(seat.agent, seat.path, after_m)

    def _crossed_m(self, site: Site, seat: SeatedAgent) -> Iterator[float]:
        """Yield where on its way a vehicle stops before those who cross it (m)."""
        half_m = self._types[seat.agent.type.value].length_m / 2.0
        for walker in site.walkers:
            if walker.path.crossing_id is None:
                continue
            kerb_m = self._map.network.lane(walker.path.lane_id).arc_length_m
            arc_m, _ = seat.path.line.project(*walker.path.line.at(kerb_m)[:2])
            arc_m -= half_m + _BEFORE_CROSSWALK_M
            while arc_m > seat.arc_m and not self._is_open(seat.agent, seat.path, arc_m):
                arc_m -= _STEP_M
            if arc_m > seat.arc_m:
                yield arc_m

    def _met_arc_m(
        self, spec: ScenarioSpec, anchor: tuple[float, float], seat: SeatedAgent
    ) -> float | None:
        """Return where a vehicle waits to be met by a UAV on its route (m), None for all others.

        Of whom nothing else is said waits where its way is nearest to what the route is over.
        """
        for awaited in awaited_at(spec):
            patrol = awaited.mission
            if awaited.agent != seat.agent.id or seat.agent.behaviors or patrol is None:
                continue
            if patrol.mode is MissionMode.NAVIGATE and awaited.within_m is not None:
                point = self._places.itself(awaited.place, anchor)
                bound = _Bound(
                    place=awaited.place, within_m=awaited.within_m, at_start=False, stated=True
                )
                arc_m = self._arc_near(seat, point, bound, wide=True)
                if arc_m is None:
                    return None
                return self.open_arc_m(seat.agent, seat.path, arc_m)
        return None

    def _bounds(self, spec: ScenarioSpec, agent: GroundAgent) -> Iterator[_Bound]:
        arrival_m = self._arrival_m
        for placement in agent.placements:
            of, relation = placement.of, placement.relation
            if of is None or not has_point(of) or relation is Relation.BEFORE:
                continue
            near_m = self._tolerances.near_m if relation is Relation.NEAR else self._start_m
            distance, bearing = _told(placement.distance_m), _told(placement.bearing_deg)
            if distance is None and bearing is None:
                yield _Bound(place=of, within_m=near_m, at_start=True)
            else:
                parked = relation is Relation.PARKED_AT
                yield self._stated(of, distance, bearing, near_m, parked=parked)
        for behavior in agent.behaviors:
            if behavior.target is not None and has_point(behavior.target):
                later = behavior.kind is BehaviorKind.PARK and parks_after(spec, agent) is not None
                stays = behavior.kind in _STAYS and not later
                if stays or later or behavior.kind in _LEADS:
                    yield _Bound(
                        place=behavior.target,
                        within_m=self._start_m if stays else arrival_m,
                        at_start=stays,
                        stops=later or behavior.kind is BehaviorKind.STOP,
                    )
        for trigger in arrivals(spec, agent):
            if has_point(trigger.place):
                yield _Bound(place=trigger.place, within_m=arrival_m, at_start=False)

        for one in leaving(spec):
            if one.agent == agent.id:
                near_m = _NEAR_SHARE * one.beyond_m
                yield _Bound(place=one.place, within_m=near_m, at_start=True, stated=True)

    def _stated(
        self,
        place: str,
        distance: Parameter | None,
        bearing: Parameter | None,
        near_m: float,
        *,
        parked: bool,
    ) -> _Bound:
        """Return where a stated distance or bearing from a place puts a vehicle."""
        low_m, high_m, t = 0.0, near_m, self._tolerances
        if distance is not None:
            allowed = t.placement_other_m if parked else t.placement_vehicle_m
            slack_m = _SAFE * allowed.of(distance.value, approximate=distance.approximate)
            low_m, high_m = distance.value - slack_m, distance.value + slack_m
            if distance.bound is Bound.AT_MOST:
                low_m, high_m = 0.0, distance.value - slack_m
            elif distance.bound is Bound.AT_LEAST:
                low_m, high_m = distance.value + slack_m, distance.value + near_m
        return _Bound(
            place=place,
            within_m=high_m,
            at_start=True,
            beyond_m=low_m,
            bearing_deg=None if bearing is None else bearing.value,
            stated=True,
        )

    def _point(self, bound: _Bound, anchor: tuple[float, float]) -> tuple[float, float]:
        """Return the point that a bound counts from (x, y in m, ENU)."""
        if bound.stated:
            return self._places.itself(bound.place, anchor)
        return self._places.point(bound.place, anchor)

    def _stands(self, seat: SeatedAgent, point: tuple[float, float], bound: _Bound) -> bool:
        """Tell whether a vehicle stands where a bound wants it at t = 0."""
        here = seat.path.position_at(seat.arc_m)
        east_m, north_m = here[0] - point[0], here[1] - point[1]
        if not bound.beyond_m <= norm2(east_m, north_m) <= bound.within_m:
            return False
        if bound.bearing_deg is None:
            return True
        off_deg = heading_to_sumo_angle(east_m, north_m) - bound.bearing_deg
        return abs((off_deg + 180.0) % 360.0 - 180.0) <= _SAFE * self._tolerances.bearing_deg

    def _arc_near(
        self,
        seat: SeatedAgent,
        point: tuple[float, float],
        bound: _Bound,
        *,
        wide: bool = False,
    ) -> float | None:
        """Return where a way comes near a point at a fair distance (m along it), else None."""
        low, high = (seat.arc_m + way_m for way_m in (self._wide_m if wide else _WAY_M))
        arc_m, _ = seat.path.line.project(
            *point, near_s=(low + high) / 2.0, window_m=(high - low) / 2.0
        )
        half_m = self._types[seat.agent.type.value].length_m / 2.0
        reach_m = bound.within_m + (0.0 if bound.stated else half_m)
        # Who stops stands neither on the place nor inside a junction: back along the way.
        while low <= arc_m <= high:
            x, y, _, _ = seat.path.position_at(arc_m)
            away_m = norm2(x - point[0], y - point[1])
            if away_m > reach_m:
                return None
            if not bound.stops:
                return arc_m
            if away_m > half_m + _STEP_M and self._is_open(seat.agent, seat.path, arc_m):
                return arc_m
            arc_m -= _STEP_M
        return None

    def open_arc_m(self, agent: GroundAgent, path: RoutePath, arc_m: float) -> float:
        """Return the first place from `arc_m` on (m) that is not inside a junction."""
        while arc_m < path.length_m and not self._is_open(agent, path, arc_m):
            arc_m += _STEP_M
        return arc_m

    def _is_open(self, agent: GroundAgent, path: RoutePath, arc_m: float) -> bool:
        """Tell whether a vehicle that stands there with its centre is on one street alone."""
        room_m = self._types[agent.type.value].length_m / 2.0 + _STEP_M
        ends = (max(0.0, arc_m - room_m), min(path.length_m, arc_m + room_m))
        lanes = {path.lane_position_at(end)[0] for end in ends}
        return len(lanes) == 1 and not self._map.network.lane(next(iter(lanes))).is_internal
