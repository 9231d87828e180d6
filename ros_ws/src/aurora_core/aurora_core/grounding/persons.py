# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where persons stand, walk and cross at a site: on sidewalks, and over its crosswalk.

The crosswalk of a scene is the crossing nearest to its anchor, as its intersection is the nearest
one. Who crosses stands at its kerb, or where a placement says on the sidewalk that leads to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding import walk_ends
from aurora_core.grounding.awaited import awaited_at, bound_to_places
from aurora_core.grounding.convoy import SceneSplit
from aurora_core.grounding.distances import DEFAULT_GAP_M
from aurora_core.grounding.going import (
    arrives_from_m,
    aside_of_walkers_m,
    awaits_its_moment,
    crosses,
    does_at_a_place,
    goes,
    heads_for,
    keeps_beside,
)
from aurora_core.grounding.kerb import STEP_M, parked_pose, steps_off_m
from aurora_core.grounding.nearby import ALONG, SIDES, by_vehicles, in_order
from aurora_core.grounding.pace import met_m, own_speed_mps
from aurora_core.grounding.parked import parked_boxes, walks_into
from aurora_core.grounding.places import MapPlaces, arrivals, has_point
from aurora_core.grounding.releases import Release, person_release
from aurora_core.grounding.routes import route_finder
from aurora_core.grounding.sidewalk_spots import (
    COMES_M,
    Spot,
    abreast_of,
    at_distance,
    beyond_m,
    nearest_spot,
    off_it_m,
    off_m,
    walked_up_to,
    walks_to,
)
from aurora_core.grounding.sites import (
    ANY_CLASS,
    SeatedAgent,
    SeatedPerson,
    Site,
    line_from,
)
from aurora_core.grounding.stepping_out import FarKerb, names_crosswalk, steps_out
from aurora_core.grounding.walk_ends import (
    KERB_M,
    NEXT_CROSSES_M,
    NEXT_M,
    WALKS_M,
    arrival_m,
    halt_m,
    rests_at,
    walks_up_m,
)
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import WalkTable
from aurora_core.knowledge.settings import PersonSettings
from aurora_core.knowledge.walk_path import WalkPath, kerb_to_kerb, sidewalk_of, walk_along
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn
from aurora_core.spec.parking import (
    crosses_after_stop,
    crosses_rested,
    stands,
    stop_time_s,
    stops_for_good,
)
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import Place, Relation

# Who stands on a side of a vehicle is where the sidewalk is, to so much of a stated distance (m).
_OFF_M = 1.5

# Steps in which a spot at a stated distance is looked for (m).
_STEP_M = 0.5

# Who walks beside a vehicle has so much of the sidewalk ahead, or what his run takes (m).
_BESIDE_WAY_M = 60.0

# So far the way of a person is looked at for parked vehicles (m).
_SHORT_WAY_M = 60.0

# Vehicles have at least this way to a crosswalk that a person uses, and at most that (m).
_CROSSWALK_AHEAD_M = (20.0, 120.0)

# Who is placed to nobody and crosses where no crosswalk is does so that far ahead of them (m).
_STEPS_OUT_AHEAD_M = 60.0

# In front of the bumper of a vehicle that waits there is so much room to the middle of one (m).
_IN_FRONT_M = 3.5

# The crosswalk lies on the way of the vehicles when it is no farther off it (m).
_ON_WAY_M = 10.0

# Who crosses the street in front of a vehicle.
_BEFORE_IT = (Relation.AHEAD, Relation.BEFORE)
# Who is to cross walks no farther than this to the crosswalk (m): it has to be seen to.
_TO_CROSSWALK_M = 20.0


class PersonPlacer:
    """Places persons on one map.

    Args:
        map_model: Map.
        types: Agent sizes.
        style: How they stand and walk.
        tolerances: How near is near, and at.
        walks: Which sidewalks and crossings were walked; None where the map was not measured.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        style: PersonSettings,
        tolerances: Tolerances,
        walks: WalkTable | None = None,
    ) -> None:
        self._tolerances = tolerances
        self._walks = walks
        self._map = map_model
        self._places = MapPlaces(map_model)
        self._types = types
        self._style = style
        self._finder = route_finder(map_model.network, ANY_CLASS)
        self._kerbs = FarKerb(map_model.network)

    def seated(
        self, spec: ScenarioSpec, split: SceneSplit, site: Site, run_s: float
    ) -> Site | str:
        """Return a site with its persons, or what it lacks.

        Args:
            spec: The request.
            split: Who is to be placed.
            site: Where the vehicles stand.
            run_s: How long they may walk.
        """
        for number, agent in enumerate(in_order(split.persons)):
            if split.anywhere and crosses(spec, agent) and not names_crosswalk(agent):
                spot = self._over_street(spec, agent, site, number)
            else:
                spot = self._spot(spec, agent, site, run_s, number)
            if isinstance(spot, str):
                return spot
            walker = SeatedPerson(
                agent=agent,
                path=spot.path,
                arc_m=spot.arc_m,
                lateral_m=spot.lateral_m,
                rest_m=spot.rest_m,
            )
            way_m = _SHORT_WAY_M if goes(spec, agent) else 0.0
            seats = (*site.seated, *site.others)
            parked = parked_boxes(spec, seats, self._map.network, self._types)
            if not self._walked(spot.path):
                return 'sidewalk'
            if walks_into(parked, walker, way_m, self._style.body_m):
                return 'blocked'
            site = replace(site, walkers=(*site.walkers, walker))
        return site

    def _walked(self, path: WalkPath) -> bool:
        """Tell whether somebody was found to walk where a walk begins, and over its crossing."""
        walks = self._walks
        if walks is None:
            return True
        crossed = path.crossing_id is None or walks.crosses(path.crossing_id)
        return crossed and walks.walks(path.lane_id)

    def grounded(self, spec: ScenarioSpec, site: Site) -> Iterator[GroundedAgent]:
        """Yield the persons of a site as they enter the run."""
        for seat in site.walkers:
            agent, path = seat.agent, seat.path
            record = self._types[agent.type.value]
            x, y, hx, hy = path.position_at(seat.arc_m)
            x, y = x - seat.lateral_m * hy, y + seat.lateral_m * hx
            free = path.begins_m is not None
            stays = free or not goes(spec, agent)
            mps = own_speed_mps(agent) or self._style.walking_mps
            rested, awaits = crosses_rested(spec, agent), awaits_its_moment(spec, agent)
            halts = halt_m(seat, self._map.network) if rested or awaits else None
            release = person_release(spec, agent) if rested or halts is None else Release()
            goal_m = self._map.network.lane(path.goal_lane_id).arc_length_m
            arrival = arrival_m(site, seat, goal_m, crosses=crosses(spec, agent))
            if not rested:
                halts, arrival = walk_ends.stopping_m(seat, halts, arrival)
            yield GroundedAgent(
                id=agent.id,
                type_name=agent.type.value,
                is_person=True,
                length_m=record.length_m,
                width_m=record.width_m,
                height_m=record.height_m,
                role=agent.role.value,
                edges=path.edge_ids[:1] if stays else path.edge_ids,
                route_xy_m=line_from(path, seat.arc_m),
                lane_id=path.lane_id,
                lane_position_m=seat.arc_m if path.begins_m is None else path.begins_m,
                x_m=x,
                y_m=y,
                heading_x=hx,
                heading_y=hy,
                arrival_position_m=None if stays else arrival,
                lateral_m=seat.arc_m if free else seat.lateral_m,
                way_xy_m=line_from(path, seat.arc_m) if free else (),
                stop_s=None if crosses_after_stop(spec, agent) else stop_time_s(agent),
                halt_xy_m=None if halts is None else path.position_at(halts)[:2],
                release=ReleaseOn.NEVER if stays and not free else release.on,
                release_uav=release.uav,
                release_mission=release.mission,
                release_agent=release.agent,
                release_within_m=release.within_m,
                drive_speed_mps=mps,
                acceleration_mps2=record.accel_mps2,
                deceleration_mps2=record.decel_mps2,
            )

    def _spot(
        self, spec: ScenarioSpec, agent: GroundAgent, site: Site, run_s: float, number: int
    ) -> Spot | str:
        """Return where a person stands and walks, or what is missing there."""
        placed = self._beside_vehicle(spec, agent, site, number)
        if isinstance(placed, Spot) and not self._is_at_landmarks(agent, placed):
            return 'away_from_place'
        if isinstance(placed, Spot) and crosses(spec, agent) and steps_out(spec, agent):
            return self._over_street(spec, agent, site, number)
        if crosses(spec, agent):
            # Without a stated distance the crosswalk says how far ahead of the vehicle that is.
            stated = any(is_stated(p.distance_m) for p in agent.placements)
            ahead = any(p.relation in _BEFORE_IT for p in agent.placements)
            back_m = arrives_from_m(spec, agent) or KERB_M
            up_m = walks_up_m(spec, agent, own_speed_mps(agent) or self._style.walking_mps)
            there = placed if stated or not ahead else None
            return self._crossing(site, there, number, back_m, up_m)
        if isinstance(placed, str):
            return placed
        if placed is None:
            placed = self._at_place(spec, agent, site, number)
        if placed is None:
            return 'sidewalk'
        if not goes(spec, agent) or stops_for_good(agent):
            return placed
        way_m = (own_speed_mps(agent) or self._style.walking_mps) * run_s
        if keeps_beside(spec, agent):
            # Over the next street no vehicle goes with him.
            left_m = self._map.network.lane(placed.path.lane_id).arc_length_m - placed.arc_m
            return placed if left_m >= min(way_m, _BESIDE_WAY_M) else 'sidewalk'
        return self._onward(placed, way_m)

    def _over_street(
        self, spec: ScenarioSpec, agent: GroundAgent, site: Site, number: int
    ) -> Spot | str:
        """Return the way straight over the street from where a person is."""
        placed = self._beside_vehicle(spec, agent, site, number)
        if placed is None and site.seated and not any(has_point(p.of) for p in agent.placements):
            front = max(site.seated, key=lambda s: s.arc_m)
            placed = self._along(front, _STEPS_OUT_AHEAD_M, number)
        elif placed is None:
            placed = self._at_place(spec, agent, site, number)
        if not isinstance(placed, Spot):
            return placed or 'sidewalk'
        way = self._kerbs.way(placed.path, placed.arc_m)
        if way is None:
            return 'far_kerb'
        kerb_m = steps_off_m(self._map.network, way) if awaits_its_moment(spec, agent) else None
        return Spot(way, 0.0 if kerb_m is None else max(0.0, kerb_m - STEP_M))

    def _crossing(
        self, site: Site, placed: Spot | str | None, number: int, back_m: float, up_m: float
    ) -> Spot | str:
        """Return the walk over the crosswalk of a site, begun so far before it (m).

        Who walks up to it, by `up_m`, does so from the beginning of the sidewalk at most.
        """
        x, y, _, _ = site.origin()
        crossing = self._places.crossing_near((x, y))
        path = None if crossing is None else kerb_to_kerb(self._map.network, crossing)
        if crossing is None or path is None or crossing.has_signal:
            return 'crosswalk'
        first = self._map.network.lane(path.lane_id)
        if isinstance(placed, str):
            return placed
        if placed is not None:
            same = placed.path.lane_id == path.lane_id
            near = first.arc_length_m - placed.arc_m <= _TO_CROSSWALK_M
            return Spot(path, placed.arc_m) if same and near else 'crosswalk'
        if site.seated and not self._ahead(site, path.line.at(first.arc_length_m)[:2]):
            return 'crosswalk'
        begin_m = first.arc_length_m - back_m - NEXT_CROSSES_M * number
        if begin_m < (COMES_M if up_m > 0.0 else 0.0) and max(back_m, up_m) > KERB_M:
            return 'crosswalk'
        return Spot(path, max(0.0, begin_m - up_m))

    def _ahead(self, site: Site, point: tuple[float, float]) -> bool:
        """Tell whether a point lies on the way of the vehicles, ahead of all of them."""
        along_m, aside_m = site.origin_path.line.project(*point)
        low, high = _CROSSWALK_AHEAD_M
        # Who waits lets the person cross right in front, who is parked is in nobody's way.
        still = [s for s in site.seated if stands(s.agent) or s.member.parked]
        front = max([s for s in site.seated if s not in still] or still, key=lambda s: s.arc_m)
        for seat in still:
            room_m = 0.0 if seat.member.parked else _IN_FRONT_M
            if along_m < seat.arc_m + self._types[seat.agent.type.value].length_m / 2.0 + room_m:
                return False
        low = 0.0 if front in still else low
        return abs(aside_m) <= _ON_WAY_M and low <= along_m - front.arc_m <= high

    def _beside_vehicle(
        self, spec: ScenarioSpec, agent: GroundAgent, site: Site, number: int
    ) -> Spot | str | None:
        """Return the spot that a placement to a vehicle gives, None where there is no such."""
        for placement in (*agent.placements, *by_vehicles(spec, agent)):
            seat = site.seat(placement.of or '')
            if seat is None or placement.relation not in ALONG:
                continue
            stated = placement.distance_m
            told = is_stated(stated)
            if not told and placement.relation in _BEFORE_IT and does_at_a_place(agent):
                continue  # which is ahead of the vehicles
            left = placement.relation is Relation.LEFT
            aside = placement.relation in SIDES and isinstance(seat, SeatedAgent)
            if told and stated is not None and (aside or placement.relation is Relation.NEAR):
                aimed_m = max(0.0, stated.inside(self._style.inside_bound_m))
                most_m = _OFF_M if aside else off_m(stated, self._tolerances)
                return self._so_near(seat, aimed_m, most_m, left=left) or 'sidewalk'
            sign = ALONG[placement.relation]
            length_m = self._types[seat.agent.type.value].length_m
            away_m = sign * (stated.value if told and stated else off_it_m(seat, length_m, stated))
            if sign > 0.0 and not told and isinstance(seat, SeatedAgent):
                away_m = max([away_m, *met_m(spec, agent, seat.agent)])
            if isinstance(seat, SeatedPerson) and sign == 0.0:
                return abreast_of(
                    self._map.network, seat, placement.relation, self._style.abreast_m
                )
            return self._along(seat, away_m, 0, left=left) or 'sidewalk'
        elsewhere = any(p.relation is not Relation.ON for p in agent.placements)
        if elsewhere or bound_to_places(spec, agent) or crosses(spec, agent):
            return None
        for seat in site.seated:
            for away_m in met_m(spec, agent, seat.agent):
                return self._along(seat, away_m, number) or 'sidewalk'
        return None

    def _is_at_landmarks(self, agent: GroundAgent, spot: Spot) -> bool:
        """Tell whether who is placed to a vehicle is at the landmarks where it is to be, too."""
        x, y, _, _ = spot.path.position_at(spot.arc_m)
        for placement in agent.placements:
            if is_landmark(placement.of):
                near = placement.relation is Relation.NEAR
                most_m = self._tolerances.near_m if near else self._tolerances.arrival_m
                if near and placement.distance_m is not None:
                    most_m = placement.distance_m.inside(self._style.inside_bound_m)
                to_x, to_y = self._places.point(str(placement.of), (x, y))
                if norm2(x - to_x, y - to_y) > most_m:
                    return False
        return True

    def _so_near(
        self,
        seat: SeatedAgent | SeatedPerson,
        stated_m: float,
        most_off_m: float,
        *,
        left: bool = False,
    ) -> Spot | None:
        """Return the spot on the sidewalk that is so far from another one, ahead of it.

        None where that is farther off than `most_off_m`.
        """
        pose = seat.path.position_at(seat.arc_m)
        if isinstance(seat, SeatedAgent) and seat.member.parked:
            record = self._types[seat.agent.type.value]
            pose = parked_pose(pose, self._map.network.lane(seat.lane_id), record)
        x, y, _, _ = pose
        best: tuple[float, Spot] | None = None
        for step in range(round(stated_m / _STEP_M) + 1):
            spot = self._along(seat, stated_m - step * _STEP_M, 0, left=left)
            if spot is not None:
                here = spot.path.position_at(spot.arc_m)
                off_m = abs(norm2(here[0] - x, here[1] - y) - stated_m)
                if best is None or off_m < best[0]:
                    best = off_m, spot
        return None if best is None or best[0] > most_off_m else best[1]

    def _along(
        self,
        seat: SeatedAgent | SeatedPerson,
        away_m: float,
        number: int,
        *,
        left: bool = False,
    ) -> Spot | None:
        """Return the sidewalk abreast of a point on somebody's way: right of it, or `left`."""
        arc_m = seat.arc_m + away_m + NEXT_M * number
        if not 0.0 <= arc_m <= seat.path.length_m:
            return None
        x, y, hx, hy = seat.path.position_at(arc_m)
        edges = seat.path.edge_ids
        if left:
            across = (self._map.network.opposite_edge(e) for e in edges if not e.startswith(':'))
            edges = tuple(e for e in across if e is not None)
        for edge in edges:
            spot_m = self._abreast(edge, (x, y))
            path = None if spot_m is None else walk_along(self._map.network, (edge,))
            if spot_m is None or path is None:
                continue
            to_x, to_y, _, _ = path.position_at(spot_m)
            # A way that comes back has the other side of the street on it, too.
            if not left or (to_y - y) * hx - (to_x - x) * hy > 0.0:
                return Spot(path, spot_m)
        return None

    def _abreast(self, edge_id: str, point: tuple[float, float]) -> float | None:
        """Return where on the sidewalk of an edge (m) one is abreast of a point on its road."""
        lane = sidewalk_of(self._map.network, edge_id)
        if lane is None:
            return None
        arc_m, aside_m = lane.line.project(*point)
        inside = KERB_M <= arc_m <= lane.arc_length_m - KERB_M
        return arc_m if inside and abs(aside_m) <= 2.0 * _ON_WAY_M else None

    def _at_place(
        self, spec: ScenarioSpec, agent: GroundAgent, site: Site, number: int
    ) -> Spot | None:
        """Return the spot at the place that the request names, else beside the anchor."""
        x, y, _, _ = site.origin()
        names = [p.of for p in agent.placements] + [b.target for b in agent.behaviors]
        names += [awaited.place for awaited in awaited_at(spec) if awaited.agent == agent.id]
        names += [trigger.place for trigger in arrivals(spec, agent)]
        # Who is to arrive somewhere walks there from a little way off, who goes there from more.
        rests, heads = rests_at(spec, agent), heads_for(agent)
        from_m = arrives_from_m(spec, agent) or KERB_M
        stated = {
            p.of: max(0.0, p.distance_m.inside(self._style.inside_bound_m))
            for p in agent.placements
            if p.distance_m is not None and is_stated(p.distance_m)
        }
        for name in names:
            if name is not None and name in stated and has_point(name):
                return at_distance(
                    self._map.network, self._places.itself(name, (x, y)), stated[name], number
                )
            if name == Place.CROSSWALK:
                crossing = self._places.crossing_near((x, y))
                path = None if crossing is None else kerb_to_kerb(self._map.network, crossing)
                if path is None:
                    return None
                lane = self._map.network.lane(path.lane_id)
                back_m = max(WALKS_M, from_m) if name == heads else from_m
                back_m = NEXT_M * number + (KERB_M if name == rests else back_m)
                walk = walk_along(self._map.network, path.edge_ids[:1])
                if walk is None:
                    return None
                aside_m = aside_of_walkers_m(spec, agent)
                spot = Spot(walk, max(0.0, lane.arc_length_m - back_m), aside_m)
                if name == rests:
                    spot = walks_to(self._map.network, spot)
                short = lane.arc_length_m - spot.arc_m < COMES_M
                return None if name == heads and short else spot
            if name is not None and has_point(name):
                there = self._places.point(name, (x, y))
                near = nearest_spot(self._map.network, there, number)
                if name == heads:
                    most_m = self._tolerances.arrival_m - 1.0
                    near = walked_up_to(self._map.network, there, most_m) or near
                if near is not None and name == rests:
                    most_m = beyond_m(near, there, self._tolerances.arrival_m)
                    return walks_to(self._map.network, near, most_m)
                back_m = max(WALKS_M, from_m) if name == heads else from_m
                if near is None or back_m <= KERB_M:
                    return near
                return replace(near, arc_m=max(0.0, near.arc_m - back_m))
        if site.seated:
            front = max(site.seated, key=lambda s: s.arc_m)
            return self._along(front, DEFAULT_GAP_M, number)
        return nearest_spot(self._map.network, (x, y), number)

    def _onward(self, spot: Spot, way_m: float) -> Spot | str:
        """Return a walk that goes on along the street for a way (m)."""
        edges = self._finder.straight_route(spot.path.edge_ids[0], spot.arc_m + way_m)
        path = walk_along(self._map.network, edges) if edges else None
        return 'sidewalk' if path is None else replace(spot, path=path)
