# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Traffic by density: cars that circulate around the scene, at first off its actors' streets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count

import numpy as np

from aurora_core.errors import MapError
from aurora_core.geometry.box import chord_pose
from aurora_core.geometry.kernel import norm2
from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.lane_changers import ORDERED_CHANGES
from aurora_core.grounding.routes import route_finder
from aurora_core.grounding.sites import line_from
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable, may_stand
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.route_path import arc_at
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.knowledge.street_length import street_length_m
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.spec.prohibitions import ForbiddenAgent
from aurora_core.spec.requirements import types_counted
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, Role, TrafficDensity

_TYPE = AgentType.CAR
# Streets of an actor's route that are kept free: it gets no farther in most runs.
_CORRIDOR_EDGES = 8
# So many more vehicles than are due: some leave the surroundings.
_SPARE = 1.05
# Traffic stays near on this share of so much of its way (m), looked at in such steps (m); on less
# where there is no room for all of it.
_STAYS_SHARES = (0.8, 0.4)
_WAY_M = 800.0
_STEP_M = 20.0
# Tries at random places before they count as full.
_TRIES = 6000

Point2 = tuple[float, float]


def has_room_for_traffic(spec: ScenarioSpec) -> bool:
    """Tell whether cars may be added: nobody says how many there are in the whole scene."""
    counted = any(_TYPE.value in types_counted(c.kind) for c in spec.counts)
    forbidden = any(isinstance(p, ForbiddenAgent) and p.type is _TYPE for p in spec.prohibitions)
    return not counted and not forbidden


class TrafficPlacer:
    """Places the traffic of one map.

    Args:
        map_model: Map.
        types: Agent sizes.
        settings: How far traffic spreads.
        limits: How many agents there may be.
        tolerances: How much traffic a density is, and how near.
        spawns: Where vehicle types were measured to stand.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        settings: GroundingSettings,
        limits: Limits,
        tolerances: Tolerances,
        spawns: SpawnTable | None = None,
    ) -> None:
        self._spawns = spawns
        self._limits = limits
        self._tolerances = tolerances
        self._network = map_model.network
        self._record = types[_TYPE.value]
        self._settings = settings
        self._reach_m = settings.traffic_reach_share * tolerances.traffic_radius_m
        self._finder = route_finder(self._network, self._record.vclass)

    def placed(
        self,
        spec: ScenarioSpec,
        actors: Sequence[GroundedAgent],
        homes: Sequence[Point2],
        run_m: float,
        generator: np.random.Generator,
    ) -> tuple[GroundedAgent, ...]:
        """Return the traffic that a request asks for.

        Args:
            spec: The request.
            actors: Everybody else.
            homes: Of the UAVs (x, y in m, ENU): the scene, where nobody else is asked for.
            run_m: Longest way that is driven in the run.
            generator: Of the traffic alone.
        """
        density = spec.world.traffic_density
        if density is None or not has_room_for_traffic(spec):
            return ()
        scene = [(a.x_m, a.y_m) for a in actors if a.role != Role.BACKGROUND.value] or homes
        if not scene:
            return ()
        centre = (sum(x for x, _ in scene) / len(scene), sum(y for _, y in scene) / len(scene))
        streets = frozenset(edge for a in actors for edge in a.edges[:_CORRIDOR_EDGES])
        taken = [(a.x_m, a.y_m) for a in actors]
        found: list[GroundedAgent] = []
        names = _free_names(spec)
        wanted, staying = self._number(density, centre), 0.0
        for lane, position_m, least in self._places(centre, streets, generator):
            if staying >= wanted or len(actors) + len(found) >= self._limits.agents_max:
                break
            x, y, hx, hy = self._pose(lane, arc_at(lane, position_m))
            gap_m = self._settings.background_gap_m
            if any(norm2(x - u, y - v) < gap_m for u, v in taken):
                continue
            if not may_stand(self._spawns, _TYPE.value, lane.id, arc_at(lane, position_m)):
                continue
            way = self._way(lane, position_m, centre, streets, run_m, generator)
            share = 0.0 if way is None else self._share_near(way[1], centre)
            if way is None or share < least:
                continue
            taken.append((x, y))
            staying += share
            found.append(
                GroundedAgent(
                    id=next(names),
                    type_name=_TYPE.value,
                    is_person=False,
                    length_m=self._record.length_m,
                    width_m=self._record.width_m,
                    height_m=self._record.height_m,
                    role=Role.BACKGROUND.value,
                    edges=way[0],
                    route_xy_m=way[1],
                    lane_id=lane.id,
                    lane_position_m=arc_at(lane, position_m),
                    x_m=x,
                    y_m=y,
                    heading_x=hx,
                    heading_y=hy,
                    # Who stops in the middle of a change of lane stands across two lanes.
                    lane_change_mode=ORDERED_CHANGES,
                    acceleration_mps2=self._record.accel_mps2,
                    deceleration_mps2=self._record.decel_mps2,
                )
            )
        return tuple(found)

    def _share_near(self, way: Sequence[Point2], centre: Point2) -> float:
        """Return the share of the first part of a way that is near the centre."""
        line = Polyline(way)
        points = [line.at(k * _STEP_M) for k in range(int(min(_WAY_M, line.length_m) / _STEP_M))]
        radius_m = self._tolerances.traffic_radius_m
        near = [norm2(p[0] - centre[0], p[1] - centre[1]) <= radius_m for p in points]
        return sum(near) / max(len(near), 1)

    def _number(self, density: TrafficDensity, centre: Point2) -> float:
        """Return how many vehicles a density is, and some for those that do not stay near."""
        lanes = (
            (self._network.edge(lane.edge_id).street_name, lane.polyline)
            for lane in self._network.driving_lanes(self._record.vclass)
        )
        length_km = street_length_m(lanes, centre, self._tolerances.traffic_radius_m) / 1000.0
        number = self._tolerances.traffic_per_km[density.value] * length_km
        return _SPARE * max(number, self._tolerances.traffic_least)

    def _pose(self, lane: Lane, arc_m: float) -> tuple[float, float, float, float]:
        """Return centre (m) and unit heading of a car with its ends on a lane."""
        half_m = 0.5 * self._record.length_m
        front, back = (lane.line.at(arc_m + end_m)[:2] for end_m in (half_m, -half_m))
        return chord_pose(front, back, 2.0 * half_m)

    def _places(
        self, centre: Point2, streets: frozenset[str], generator: np.random.Generator
    ) -> Iterator[tuple[Lane, float, float]]:
        """Yield places on lanes near the centre, at random, off some streets.

        Each with the share of its way on which a car that begins there has to stay near.
        """
        margin_m = self._record.length_m / 2.0 + 1.0
        lanes = [
            lane
            for lane in self._network.driving_lanes(self._record.vclass)
            if self._finder.goes_through(lane.edge_id)
            and lane.edge_id not in streets
            and lane.length_m > 4.0 * margin_m
        ]
        weights = np.array([lane.length_m for lane in lanes])
        if not lanes:
            return
        share = weights / weights.sum()
        for k in range(len(_STAYS_SHARES) * _TRIES):
            lane = lanes[int(generator.choice(len(lanes), p=share))]
            position_m = float(generator.uniform(margin_m, lane.length_m - margin_m))
            x, y, _, _ = self._network.position_on_lane(lane.id, position_m)
            if norm2(x - centre[0], y - centre[1]) <= self._reach_m:
                yield lane, position_m, _STAYS_SHARES[k // _TRIES]

    def _way(
        self,
        lane: Lane,
        position_m: float,
        centre: Point2,
        streets: frozenset[str],
        run_m: float,
        generator: np.random.Generator,
    ) -> tuple[tuple[str, ...], tuple[Point2, ...]] | None:
        """Return a route that stays near and off some streets where it can, with its points."""

        def liked(edge: str) -> bool:
            first = self._network.lane(self._network.edge(edge).lane_ids[0])
            x, y, _, _ = self._network.position_on_lane(first.id, first.length_m)
            near = norm2(x - centre[0], y - centre[1]) <= self._reach_m
            return near and edge not in streets

        edges = self._finder.circulating_route(lane.id, run_m, generator, liked)
        if not edges:
            return None
        start_m = min(position_m + self._record.length_m, lane.length_m)
        try:
            path = self._network.route_path(
                edges, self._record.vclass, start_lane_id=lane.id, start_pos_m=start_m
            )
        except MapError:
            return None
        first = path.edge_ids.index(lane.edge_id)
        return path.edge_ids[first:], line_from(path, path.arc_of(lane.id, position_m))


def _free_names(spec: ScenarioSpec) -> Iterator[str]:
    taken = {a.id for a in spec.agents} | {u.id for u in spec.uavs}
    return (name for k in count(1) if (name := f'traffic{k}') not in taken)
