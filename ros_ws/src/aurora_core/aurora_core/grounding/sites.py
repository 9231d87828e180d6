# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Candidate sites: where on the road network a convoy could stand, and the road ahead of it."""

from __future__ import annotations

import contextlib
import itertools
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Self

import numpy as np
import numpy.typing as npt

from aurora_core.errors import MapError
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.convoy import ConvoyMember
from aurora_core.grounding.kerb import parked_pose
from aurora_core.grounding.places import MapPlaces, has_point, nearest_to
from aurora_core.grounding.routes import route_finder
from aurora_core.grounding.ties import BeforePlace
from aurora_core.grounding.way_limits import kept_lane, limits_mps
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable, may_stand
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.route_path import RoutePath, arc_at
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.knowledge.walk_path import WalkPath
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Place

FloatArray = npt.NDArray[np.float64]

_SIDES = {BehaviorKind.TURN_LEFT: 'l', BehaviorKind.TURN_RIGHT: 'r'}

# Class of a site without vehicles (a mission over a place needs a road only as an anchor).
ANY_CLASS = 'passenger'

# Class of who may ride in a lane of its own.
BICYCLES = 'bicycle'

# The route of who stands before a place passes its middle at most this far off (m): inside
# the tolerance of that placement.
_ASIDE_M = 8.0

# Clear road in front of the first and behind the last bumper at t = 0.
_END_GAP_M = 2.0
# So far along the way from its place a member is looked for beside it (m): wider than any box.
_ABREAST_M = 30.0

# A limit of 13.89 m/s is meant where 50 km/h are asked (m/s).
LIMIT_SLACK_MPS = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class SeatedAgent:
    """A convoy member at its place: on `path` at `arc_m` (its reference point)."""

    member: ConvoyMember
    path: RoutePath
    arc_m: float
    lane_id: str
    lane_position_m: float

    @property
    def agent(self) -> GroundAgent:
        """Who it is."""
        return self.member.agent


@dataclass(frozen=True, slots=True, kw_only=True)
class SeatedPerson:
    """A person on the walk `path` at `arc_m`, so far left of its middle; it rests at `rest_m`."""

    agent: GroundAgent
    path: WalkPath
    arc_m: float
    lateral_m: float = 0.0
    rest_m: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TriedSite:
    """A place that was looked at.

    Attributes:
        x_m: Of its origin, east.
        y_m: North.
        joint: Its score, in [0, 1]; None where it is not fit.
        why: What it lacks then.
    """

    x_m: float
    y_m: float
    joint: float | None = None
    why: str = ''

    @classmethod
    def of(cls, site: Site, joint: float | None = None, why: str = '') -> Self:
        """Return what became of a site."""
        x_m, y_m, *_ = site.origin_path.position_at(site.origin_arc_m)
        return cls(x_m=x_m, y_m=y_m, joint=joint, why=why)


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    """A place for the convoy.

    Attributes:
        origin_path: Route of the convoy's origin.
        origin_arc_m: Where the origin stands on it.
        seated: All members.
        free_run_m: Way of the front member to the first signal (or the length of the route).
        steady: No member needs a lane change.
        walkers: Persons, once they are placed.
        others: Vehicles with ways of their own, once they are placed.
    """

    origin_path: RoutePath
    origin_arc_m: float
    seated: tuple[SeatedAgent, ...]
    free_run_m: float
    steady: bool
    walkers: tuple[SeatedPerson, ...] = ()
    others: tuple[SeatedAgent, ...] = ()

    def seat(self, agent_id: str) -> SeatedAgent | SeatedPerson | None:
        """Return the place of a member or a person, None of anybody else."""
        seats: tuple[SeatedAgent | SeatedPerson, ...] = (
            *self.seated,
            *self.others,
            *self.walkers,
        )
        for seat in seats:
            if seat.agent.id == agent_id:
                return seat
        return None

    def origin(self) -> tuple[float, float, float, float]:
        """Return x, y (m) and the unit heading of the origin."""
        return self.origin_path.position_at(self.origin_arc_m)

    def fastest_mps(self, network: RoadNetwork, way_m: float) -> float:
        """Return the highest speed limit on the first `way_m` of the origin's way."""
        return max(limits_mps(network, self.origin_path, self.origin_arc_m, way_m))

    def turns(self, way_m: float, settings: GroundingSettings) -> int:
        """Count the turns on the first `way_m` of the origin's way."""
        path = self.origin_path
        arcs_m = _arcs_along(path, self.origin_arc_m, way_m, settings.turn_sample_m)
        headings = path.headings_at(arcs_m.tolist())
        count, turns = 0, False
        for before, after in itertools.pairwise(headings):
            # A turn may spread over two samples: count where turning begins.
            turned = turns
            turns = after[0] * before[0] + after[1] * before[1] < settings.turn_cosine
            count += turns and not turned
        return count


def tied_way_m(spec: ScenarioSpec, settings: GroundingSettings) -> float:
    """Return how far a convoy gets while it is tracked or has to stay together (metres)."""
    tracked: dict[str | None, float] = {}  # by who is tracked, one UAV after the other
    for m in spec.missions:
        if m.mode is MissionMode.TRACK and m.duration_s is not None:
            tracked[m.target] = tracked.get(m.target, 0.0) + m.duration_s.value
    return (max([30.0, *tracked.values()]) + 10.0) * settings.target_speed_mps


def on_main_roads(lanes: Sequence[Lane]) -> list[Lane]:
    """Return the lanes of streets that have several lanes per direction."""
    count = Counter(lane.edge_id for lane in lanes)
    return [lane for lane in lanes if count[lane.edge_id] > 1]


def with_another_lane(lanes: Sequence[Lane]) -> list[Lane]:
    """Return the lanes for cars that have another one of these beside them."""
    return on_main_roads([lane for lane in lanes if ANY_CLASS in lane.allows])


def sites(
    map_model: MapModel,
    convoy: tuple[ConvoyMember, ...],
    types: Mapping[str, AgentTypeRecord],
    settings: GroundingSettings,
    route_length_m: float,
    spacing_m: float,
    before: BeforePlace | None = None,
    least_limit_mps: float = 0.0,
    *,
    spawns: SpawnTable,
    several_lanes: bool = False,
    goals: Sequence[frozenset[str]] = (),
) -> Iterator[Site]:
    """Yield every site of the map in a fixed order.

    Args:
        map_model: Map.
        convoy: Who is to be placed.
        types: Agent sizes.
        settings: How places are searched.
        route_length_m: Of the routes.
        spacing_m: How far apart they are.
        before: A member that stands before a place; only such sites are yielded.
        least_limit_mps: Streets have this speed limit, or the highest one that the map has.
        spawns: What is beside each lane, and where vehicle types were measured to stand.
        several_lanes: Only on streets with several lanes for cars per direction.
        goals: Edges of the places that the routes are to come through, in this order.
    """
    centres: Sequence[tuple[float, float]] = ()
    if before is not None:
        known = MapPlaces(map_model)
        centres = known.crosswalks if before.place is Place.CROSSWALK else known.intersections
    network = map_model.network
    beside = any(m.bike_lane for m in convoy)
    driving = [m for m in convoy if not m.bike_lane]
    classes = sorted({types[m.agent.type.value].vclass for m in driving}) or [ANY_CLASS]
    lanes = [
        lane
        for lane in network.driving_lanes(classes[0])
        if all(c in lane.allows for c in classes)
    ]
    if any(p.of == Place.MAIN_ROAD for m in convoy for p in m.agent.placements):
        lanes = on_main_roads(lanes)
    if several_lanes:
        lanes = with_another_lane(lanes)
    if beside:
        lanes = [lane for lane in lanes if _has_bike_lane(network, spawns, lane)]
    lanes, least_mps = brisk_lanes(lanes, least_limit_mps)
    vclass = min(classes, key=lambda c: (len(network.driving_lanes(c)), c))
    finder = route_finder(network, vclass, least_mps)
    # Who begins where the road only ends would turn round before long.
    lanes = [lane for lane in lanes if finder.goes_through(lane.edge_id)] or lanes
    side = _turn(convoy)
    back_m = max(
        (types[m.agent.type.value].length_m / 2.0 - m.offset_m for m in convoy), default=0.0
    )
    for lane in lanes:
        right = spawns.samples.right_of(lane.id)
        has_right = right is not None and all(c in network.lane(right).allows for c in classes)
        shifted = any(m.lane_shift < 0 for m in convoy)
        # The right lane is where one drives; another only when a member has to be right of it.
        if has_right and not shifted:
            continue
        if goals:
            longest_m = settings.longest_way_m
            edges = finder.leading_route(lane.edge_id, route_length_m, goals, longest_m)
        elif side:
            edges = finder.turning_route(lane.edge_id, route_length_m, side)
        else:
            edges = finder.straight_route(lane.edge_id, route_length_m)
        if not edges:
            continue
        # Who lets others pass stays in its lane: it goes straight on where they turn.
        aside = finder.straight_route(lane.edge_id, route_length_m) if goals else ()
        seated = partial(
            _site, map_model, convoy, types, (edges, aside), lane.id, settings.passing_m, {}
        )
        arc_m = back_m + _END_GAP_M
        end_m = lane.arc_length_m + max(0.0, back_m)
        while arc_m < end_m:
            site = seated(arc_m)
            if site is not None and before is not None:
                exact_m = _exact_arc_m(site, before, centres, spacing_m)
                site = None
                if exact_m is not None:
                    site = seated(exact_m)
            if site is not None and _stands(network, site, spawns):
                yield site
            arc_m += spacing_m


def _has_bike_lane(network: RoadNetwork, spawns: SpawnTable, lane: Lane) -> bool:
    """Tell whether the next lane to the right is one for bicycles alone."""
    right = spawns.samples.right_of(lane.id)
    allows = frozenset() if right is None else network.lane(right).allows
    return BICYCLES in allows and ANY_CLASS not in allows


def _stands(network: RoadNetwork, site: Site, spawns: SpawnTable) -> bool:
    """Tell whether every member can be put where it is to be."""
    return all(
        may_stand(
            spawns,
            seat.agent.type.value,
            seat.lane_id,
            arc_at(network.lane(seat.lane_id), seat.lane_position_m),
        )
        for seat in site.seated
    )


def brisk_lanes(lanes: list[Lane], stated_mps: float) -> tuple[list[Lane], float]:
    """Return the lanes that allow a stated speed, else the fastest ones, and their least limit."""
    fastest_mps = max((lane.speed_limit_mps for lane in lanes), default=0.0)
    least_mps = max(0.0, min(stated_mps, fastest_mps) - LIMIT_SLACK_MPS)
    return [lane for lane in lanes if lane.speed_limit_mps >= least_mps], least_mps


def _turn(convoy: tuple[ConvoyMember, ...]) -> str:
    """Return to which side the convoy is to turn: as its first member that is to, '' if none."""
    kinds = [b.kind for member in convoy for b in member.agent.behaviors]
    return next((_SIDES[kind] for kind in kinds if kind in _SIDES), '')


def _exact_arc_m(
    site: Site,
    before: BeforePlace,
    centres: Sequence[tuple[float, float]],
    spacing_m: float,
) -> float | None:
    """Return where the origin stands when a member is exactly before a place.

    None where no such place is near enough: sites are `spacing_m` apart, so that one half of it
    in each direction is looked through.
    """
    seat = site.seat(before.agent)
    assert seat is not None  # it is a member of the convoy
    ahead_m = seat.arc_m + before.distance_m
    if ahead_m > seat.path.length_m:
        return None
    x, y, _, _ = seat.path.position_at(ahead_m)
    centre = nearest_to((x, y), centres)
    along_m, aside_m = seat.path.line.project(
        *centre, near_s=ahead_m, window_m=spacing_m / 2.0 + _ASIDE_M
    )
    shift_m = along_m - ahead_m
    if abs(aside_m) > _ASIDE_M or abs(shift_m) > spacing_m / 2.0:
        return None
    exact_m = site.origin_arc_m + shift_m
    here = site.origin_path.position_at(max(0.0, exact_m))
    # A scenario has one intersection and one crosswalk: the nearest ones to its origin.
    return exact_m if nearest_to((here[0], here[1]), centres) == centre else None


def _site(
    map_model: MapModel,
    convoy: tuple[ConvoyMember, ...],
    types: Mapping[str, AgentTypeRecord],
    ways: tuple[tuple[str, ...], tuple[str, ...]],
    lane_id: str,
    passing_m: float,
    paths: dict[tuple[str, int, bool], RoutePath | None],
    origin_arc_m: float,
) -> Site | None:
    network = map_model.network
    index = network.lane(lane_id).index
    edges, aside = ways
    lane_ids = network.edge(edges[0]).lane_ids

    def path_of(vclass: str, shift: int, *, lets_pass: bool = False) -> RoutePath | None:
        # The paths of a lane serve all positions on it: `paths` outlives this call.
        key = (vclass, shift, lets_pass)
        if key not in paths:
            paths[key] = None
            if 0 <= index + shift < len(lane_ids):
                with contextlib.suppress(MapError):
                    paths[key] = network.route_path(
                        aside if lets_pass else edges,
                        vclass,
                        start_lane_id=lane_ids[index + shift],
                    )
        return paths[key]

    seated = []
    for member in convoy:
        record = types[member.agent.type.value]
        path = path_of(record.vclass, -1 if member.bike_lane else member.lane_shift)
        arc_m = origin_arc_m + member.offset_m
        if aside and _lets_pass(member.agent):
            own = path_of(record.vclass, member.lane_shift, lets_pass=True)
            shared_m = _shared_m(network, edges, aside)
            if shared_m < arc_m + passing_m:
                return None  # nobody could pass before they part
            path = own
        if path is None:
            return None
        half_m = record.length_m / 2.0
        if arc_m - half_m < 0.0 or arc_m + half_m > path.length_m:
            return None
        if member.lane_shift != 0:
            path = kept_lane(network, path, arc_m + half_m, record.vclass)
        places = [path.lane_position_at(a) for a in (arc_m - half_m, arc_m, arc_m + half_m)]
        if any(network.lane(place[0]).is_internal for place in places):
            return None  # nobody starts inside a junction
        if any(c.start_m < arc_m + half_m and arc_m - half_m < c.end_m for c in path.lane_changes):
            return None  # nor between two lanes
        seated.append(
            SeatedAgent(
                member=member,
                path=path,
                arc_m=arc_m,
                lane_id=places[1][0],
                lane_position_m=places[1][1],
            )
        )
    if _overlap(network, seated, types):
        return None
    leads = convoy and not convoy[0].bike_lane
    origin = path_of(types[convoy[0].agent.type.value].vclass if leads else ANY_CLASS, 0)
    if origin is None or origin_arc_m > origin.length_m:
        return None
    if any(m.lane_shift != 0 for m in convoy) and not _abreast(network, origin, seated):
        return None
    rear = min((s.arc_m for s in seated), default=origin_arc_m)
    front = max((s.arc_m for s in seated), default=origin_arc_m)
    signals = [s[0] for s in origin.signals if s[0] >= rear]
    return Site(
        origin_path=origin,
        origin_arc_m=origin_arc_m,
        seated=tuple(seated),
        free_run_m=(signals[0] if signals else origin.length_m) - front,
        steady=not any(s.path.has_lane_change for s in seated),
    )


def _shared_m(network: RoadNetwork, one: tuple[str, ...], other: tuple[str, ...]) -> float:
    """Return how long two routes are the same from their beginning on, metres of their edges."""
    pairs = itertools.takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False))
    return sum(network.edge(edge).length_m for edge, _ in pairs)


def _lets_pass(agent: GroundAgent) -> bool:
    """Tell whether a vehicle lets others pass and goes to no place of its own."""
    kinds = {b.kind for b in agent.behaviors}
    to_places = any(has_point(b.target) for b in agent.behaviors)
    return BehaviorKind.YIELD in kinds and not to_places


def _abreast(network: RoadNetwork, origin: RoutePath, seated: Sequence[SeatedAgent]) -> bool:
    """Tell whether members are as many lanes beside the origin's way as they are to be.

    They begin so on the first edge; where lanes join before their places, they no longer are.
    """
    for seat in seated:
        x, y, _, _ = seat.path.position_at(seat.arc_m)
        _, aside_m = origin.line.project(x, y, near_s=seat.arc_m, window_m=_ABREAST_M)
        width_m = network.lane(seat.lane_id).width_m
        if not seat.member.bike_lane and (
            abs(aside_m - seat.member.lane_shift * width_m) > width_m / 2.0
        ):
            return False
    return True


def _overlap(
    network: RoadNetwork, seated: Sequence[SeatedAgent], types: Mapping[str, AgentTypeRecord]
) -> bool:
    """Tell whether two boxes touch; lanes may join between the first edge and a place."""
    boxes = []
    for seat in seated:
        record, pose = types[seat.agent.type.value], seat.path.position_at(seat.arc_m)
        if seat.member.parked:
            pose = parked_pose(pose, network.lane(seat.lane_id), record)
        boxes.append((pose, record))
    for ((x, y, hx, hy), first), ((other_x, other_y, _, _), second) in itertools.combinations(
        boxes, 2
    ):
        dx, dy = other_x - x, other_y - y
        along, across = abs(dx * hx + dy * hy), abs(dy * hx - dx * hy)
        if (
            along < (first.length_m + second.length_m) / 2.0
            and across < (first.width_m + second.width_m) / 2.0
        ):
            return True
    return False


def samples_along(
    path: RoutePath | WalkPath, start_m: float, way_m: float, spacing_m: float
) -> FloatArray:
    """Return points (K, 4) x, y and unit heading along a path, from `start_m` on."""
    return path.positions_at(_arcs_along(path, start_m, way_m, spacing_m))


def _arcs_along(
    path: RoutePath | WalkPath, start_m: float, way_m: float, spacing_m: float
) -> FloatArray:
    end_m = min(path.length_m, start_m + way_m)
    count = max(2, int((end_m - start_m) / spacing_m) + 1)
    step = (end_m - start_m) / (count - 1)
    arcs_m: FloatArray = np.minimum(end_m, start_m + np.arange(count) * step)
    return arcs_m


def line_from(path: RoutePath | WalkPath, arc_m: float) -> tuple[tuple[float, float], ...]:
    """Return the path from `arc_m` on as points (x, y), metres."""
    x, y, _, _ = path.position_at(arc_m)
    points = [(x, y)]
    passed_m = 0.0
    for a, b in zip(path.polyline[:-1], path.polyline[1:], strict=True):
        passed_m += norm2(b[0] - a[0], b[1] - a[1])
        if passed_m > arc_m + 0.01:
            points.append(b)
    return tuple(points)
