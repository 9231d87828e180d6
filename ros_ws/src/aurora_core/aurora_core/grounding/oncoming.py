# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Oncoming vehicles: in the other direction of the street on which somebody drives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from aurora_core.errors import MapError
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.convoy import ConvoyMember, oncoming_to
from aurora_core.grounding.routes import route_finder
from aurora_core.grounding.sites import SeatedAgent, Site
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable, may_stand
from aurora_core.knowledge.route_path import arc_at
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import GroundAgent
from aurora_core.spec.vocabulary import Relation

# Distances of an oncoming vehicle where the request states none (m): a few seconds from meeting,
# the first one that the street has room for.
_MEETING_M = (60.0, 80.0, 45.0, 35.0, 25.0)

# Cosine of two headings that are opposite to each other.
_OPPOSITE = -0.9

# Of a group one comes so far after the other, at most so many (m).
_BETWEEN_M = 15.0
_MOST_ROWS = 6

# Room in front of and behind its bumpers on its street (m).
_ROOM_M = 1.0


class OncomingPlacer:
    """Places oncoming vehicles on one map.

    Args:
        map_model: Map.
        types: Agent sizes.
        inside_m: How far inside a bound on the distance they stand.
        spawns: What is beside each lane, and where vehicle types were measured to stand.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        inside_m: float,
        spawns: SpawnTable,
    ) -> None:
        self._network = map_model.network
        self._types = types
        self._inside_m = inside_m
        self._spawns = spawns

    def seated(self, agents: tuple[GroundAgent, ...], site: Site, run_m: float) -> Site | str:
        """Return a site with its oncoming vehicles, or what it lacks.

        Args:
            agents: Who is to be placed.
            site: Where the others stand.
            run_m: Length of their routes.
        """
        for agent in agents:
            seat = self._seat(agent, site, run_m)
            if seat is None:
                return 'oncoming'
            site = replace(site, others=(*site.others, seat))
        return site

    def _seat(self, agent: GroundAgent, site: Site, run_m: float) -> SeatedAgent | None:
        placement = oncoming_to(agent)
        met = None if placement is None else site.seat(placement.of or '')
        if placement is None or not isinstance(met, SeatedAgent):
            return None
        ahead = next((p for p in agent.placements if p.relation is Relation.AHEAD), None)
        told = placement if ahead is None else ahead
        stated = told.distance_m
        given = stated is not None and stated.provenance is Provenance.EXPLICIT
        tried = (stated.inside(self._inside_m),) if given and stated is not None else _MEETING_M
        straight = ahead is None
        # The second of a group comes after the first one.
        rows = ((away_m + _BETWEEN_M * row, row) for row in range(_MOST_ROWS) for away_m in tried)
        seats = (
            self._at(agent, met, away_m, run_m, straight=straight)
            for away_m, row in rows
            if row == 0 or agent.group is not None
        )
        free = (seat for seat in seats if seat is not None and self._is_free(seat, site))
        return next(free, None)

    def _is_free(self, seat: SeatedAgent, site: Site) -> bool:
        """Tell whether nobody stands where somebody is to be placed."""
        return all(
            abs(other.lane_position_m - seat.lane_position_m)
            > (self._length_m(other) + self._length_m(seat)) / 2.0 + _ROOM_M
            for other in (*site.seated, *site.others)
            if other.lane_id == seat.lane_id
        )

    def _length_m(self, seat: SeatedAgent) -> float:
        return self._types[seat.agent.type.value].length_m

    def _at(
        self, agent: GroundAgent, met: SeatedAgent, away_m: float, run_m: float, *, straight: bool
    ) -> SeatedAgent | None:
        """Return the place in the other direction at a distance, None where there is none."""
        arc_m = met.arc_m + away_m
        if arc_m > met.path.length_m:
            return None
        lane_id, position_m = met.path.lane_position_at(arc_m)
        there_m = arc_at(self._network.lane(lane_id), position_m)
        opposite = self._spawns.samples.opposite_of(lane_id, there_m)
        if opposite is None:
            return None
        street = self._network.lane(opposite).edge_id
        return self._on(agent, street, met, away_m, run_m, straight=straight)

    def _on(
        self,
        agent: GroundAgent,
        edge_id: str,
        met: SeatedAgent,
        away_m: float,
        run_m: float,
        *,
        straight: bool,
    ) -> SeatedAgent | None:
        """Return the place on the rightmost lane of an edge, a distance from who is met.

        Args:
            agent: Who is placed.
            edge_id: The edge.
            met: Who is met.
            away_m: How far from him.
            run_m: Length of the route.
            straight: The distance is straight, else it is along the way of who is met.
        """
        record = self._types[agent.type.value]
        lanes = (self._network.lane(i) for i in self._network.edge(edge_id).lane_ids)
        lane = next((known for known in lanes if record.vclass in known.allows), None)
        edges = route_finder(self._network, record.vclass).straight_route(edge_id, run_m)
        if lane is None or not edges:
            return None
        x, y, hx, hy = met.path.position_at(met.arc_m)
        ahead = met.path.position_at(met.arc_m + away_m)
        along_m, _ = lane.line.project(ahead[0], ahead[1])
        here = lane.line.at(along_m)
        if here[2] * hx + here[3] * hy > _OPPOSITE:
            return None  # the street bends, or the way turns off
        if straight:  # farther away is back along the other direction
            along_m -= away_m - norm2(here[0] - x, here[1] - y)
        room_m = record.length_m / 2.0 + _ROOM_M
        if not room_m <= along_m <= lane.arc_length_m - room_m:
            return None
        position_m = along_m / lane.arc_length_m * lane.length_m
        if not may_stand(self._spawns, record.name, lane.id, along_m):
            return None
        try:
            path = self._network.route_path(edges, record.vclass, start_lane_id=lane.id)
            arc_m = path.arc_of(lane.id, position_m)
        except MapError:  # no way from this lane, or the way leaves it before
            return None
        return SeatedAgent(
            member=ConvoyMember(agent=agent, offset_m=0.0, lane_shift=0),
            path=path,
            arc_m=arc_m,
            lane_id=lane.id,
            lane_position_m=position_m,
        )
