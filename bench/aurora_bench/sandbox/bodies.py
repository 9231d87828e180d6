# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bodies that a program places: what the simulators are given, and the roster of the run."""

from __future__ import annotations

from collections.abc import Mapping

from aurora_bench.sandbox.requests import SceneRefusal, Spawn, SpawnUav
from aurora_core.errors import AuroraError
from aurora_core.execution.plan import UAV_SIZE_M
from aurora_core.grounding.routes import route_finder
from aurora_core.grounding.sites import line_from
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.walk_path import walk_along
from aurora_core.ports.simulators import GroundAgentLoad, UavHome
from aurora_core.spec.vocabulary import AgentType
from aurora_core.trace.roster import Roster, RosterEntry

MOST_AGENTS, MOST_UAVS = 200, 20
# Who is told no route drives so far (m): farther than the longest run at the highest speed.
_ON_AND_ON_M = 20_000.0
# Who walks to the end of a sidewalk stands so far before it (m).
_BEFORE_END_M = 1.0


class Bodies:
    """Everybody in a scene, in the order in which they were placed.

    Args:
        map_model: Of the run.
        types: Ground agents by type, as measured.
    """

    def __init__(self, map_model: MapModel, types: Mapping[str, AgentTypeRecord]) -> None:
        self._map = map_model
        self._types = types
        self._agents: list[tuple[GroundAgentLoad, RosterEntry]] = []
        self._uavs: list[tuple[UavHome, RosterEntry]] = []

    @property
    def agents(self) -> tuple[GroundAgentLoad, ...]:
        """What the ground simulator is given."""
        return tuple(load for load, _ in self._agents)

    @property
    def homes(self) -> tuple[UavHome, ...]:
        """What the air simulator is given."""
        return tuple(home for home, _ in self._uavs)

    def roster(self, dt_s: float) -> Roster:
        """Return who takes part, in the order of the rows."""
        return Roster(
            dt_s=dt_s,
            agents=tuple(entry for _, entry in self._agents),
            uavs=tuple(entry for _, entry in self._uavs),
        )

    def knows(self, name: str) -> bool:
        """Tell whether a body of a name was placed."""
        names = [e.body_id for _, e in self._agents] + [e.body_id for _, e in self._uavs]
        return name in names

    def add(self, asked: Spawn) -> None:
        """Take a body on the ground.

        Raises:
            SceneRefusal: Its type, its place or its route is none.
        """
        self._check_new(asked.name, len(self._agents), MOST_AGENTS)
        record = self._types.get(asked.type)
        if record is None or asked.type == AgentType.RSU:
            raise SceneRefusal(f'type: there is no {asked.type!r}')
        lane = self._map.network.lanes.get(asked.lane)
        if lane is None or lane.is_internal:
            raise SceneRefusal(f'lane: there is no lane {asked.lane!r} to stand on')
        try:
            load, path = (
                self._person(asked, lane)
                if record.is_person
                else self._vehicle(asked, lane, record.vclass)
            )
        except AuroraError as err:
            raise SceneRefusal(str(err)) from err
        entry = RosterEntry(
            body_id=asked.name,
            type_name=asked.type,
            is_person=record.is_person,
            system_id=0,
            length_m=record.length_m,
            width_m=record.width_m,
            height_m=record.height_m,
            route_edges=load.edges,
            route_xy_m=path,
            role=asked.role.value,
        )
        self._agents.append((load, entry))

    def add_uav(self, asked: SpawnUav) -> None:
        """Take a multirotor.

        Raises:
            SceneRefusal: It stands in a building, or there are too many.
        """
        self._check_new(asked.name, len(self._uavs), MOST_UAVS)
        for building in self._map.buildings:
            if building.is_below(asked.x_m, asked.y_m):
                raise SceneRefusal(f'building {building.id} stands there')
        number = len(self._uavs) + 1
        home = UavHome(
            uav_id=asked.name, system_id=number, x_m=asked.x_m, y_m=asked.y_m,
            yaw_enu_rad=asked.yaw_rad,
        )  # fmt: skip
        length_m, width_m, height_m = UAV_SIZE_M
        entry = RosterEntry(
            body_id=asked.name, type_name='uav', is_person=False, system_id=number,
            length_m=length_m, width_m=width_m, height_m=height_m,
        )  # fmt: skip
        self._uavs.append((home, entry))

    def _check_new(self, name: str, there: int, most: int) -> None:
        if self.knows(name):
            raise SceneRefusal(f'name: there is a {name!r} already')
        if there >= most:
            raise SceneRefusal(f'there are {most} already')

    def _vehicle(
        self, asked: Spawn, lane: Lane, vclass: str
    ) -> tuple[GroundAgentLoad, tuple[tuple[float, float], ...]]:
        if asked.parked:
            x, y, _, _ = lane.line.at(min(asked.position_m, lane.arc_length_m))
            return self._load(asked, (lane.edge_id,)), ((x, y),)
        if vclass not in lane.allows:
            raise SceneRefusal(f'lane: no {asked.type} may drive on {lane.id!r}')
        edges = asked.route
        if edges is None:
            finder = route_finder(self._map.network, vclass)
            edges = finder.straight_route(lane.edge_id, _ON_AND_ON_M) or (lane.edge_id,)
        if edges[0] != lane.edge_id:
            raise SceneRefusal(f'route: it does not begin with {lane.edge_id!r}')
        path = self._map.network.route_path(edges, vclass, start_lane_id=lane.id)
        if asked.position_m > lane.arc_length_m:
            raise SceneRefusal(f'position_m: the lane ends at {lane.arc_length_m:.1f} m')
        return self._load(asked, edges), line_from(path, asked.position_m)

    def _person(
        self, asked: Spawn, lane: Lane
    ) -> tuple[GroundAgentLoad, tuple[tuple[float, float], ...]]:
        edges = asked.route or (lane.edge_id,)
        if edges[0] != lane.edge_id:
            raise SceneRefusal(f'route: it does not begin with {lane.edge_id!r}')
        path = walk_along(self._map.network, edges)
        if path is None:
            raise SceneRefusal('there is no sidewalk along all of these edges')
        if asked.position_m > path.length_m:
            raise SceneRefusal(f'position_m: the sidewalk ends at {path.length_m:.1f} m')
        goal_m = self._map.network.lane(path.goal_lane_id).arc_length_m
        load = self._load(
            asked, edges, arrival_m=None if asked.parked else max(0.0, goal_m - _BEFORE_END_M)
        )
        return load, line_from(path, asked.position_m)

    def _load(
        self, asked: Spawn, edges: tuple[str, ...], arrival_m: float | None = None
    ) -> GroundAgentLoad:
        person = self._types[asked.type].is_person
        return GroundAgentLoad(
            agent_id=asked.name,
            type_name=asked.type,
            is_person=person,
            edges=edges,
            lane_id='' if person else asked.lane,
            lane_position_m=asked.position_m,
            speed_mps=asked.speed_mps,
            arrival_position_m=arrival_m,
            parked=asked.parked and not person,
        )
