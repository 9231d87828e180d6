# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Turn seats and free vehicles into grounded agents with routes, style and release."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from math import inf

import numpy as np

from aurora_core.errors import MapError
from aurora_core.grounding.convoy import SceneSplit
from aurora_core.grounding.driving_style import ConvoyStyles, free_style, urged_factor
from aurora_core.grounding.entries import entry_speeds_mps
from aurora_core.grounding.free_room import FreeRoom
from aurora_core.grounding.free_run import free_run_m, needed_run_m
from aurora_core.grounding.goals import GoalFinder, stop_after_m, stops
from aurora_core.grounding.hearing import Hearing, reaches_of
from aurora_core.grounding.kerb import parked_pose
from aurora_core.grounding.lane_changers import (
    ORDERED_CHANGES,
    changes_lane,
    first_side,
    with_lane_beside,
)
from aurora_core.grounding.pace import (
    in_emergency,
    stated_speed_mps,
)
from aurora_core.grounding.releases import Release, convoy_release, group_releases, own_release
from aurora_core.grounding.routes import route_finder
from aurora_core.grounding.shown_speed import head_starts
from aurora_core.grounding.sites import (
    LIMIT_SLACK_MPS,
    Site,
    brisk_lanes,
    line_from,
    on_main_roads,
)
from aurora_core.grounding.way_limits import limits_mps
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable, may_stand
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.route_path import RoutePath, arc_at
from aurora_core.knowledge.settings import Settings
from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn
from aurora_core.spec.parameter import Bound
from aurora_core.spec.parking import parks, parks_after, stands, stop_time_s
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import Place

# Whether any street allows a stated speed is looked for on so much of the way (m).
_SHOWN_WAY_M = 500.0

# Routes tried for one on which no signal is in the way.
_RUNS_TRIED = 60


class AgentPlacer:
    """Places agents on one map.

    Args:
        map_model: Map.
        types: Agent sizes.
        settings: Style of driving.
        limits: Limits in force.
        tolerances: Tolerances in force.
        goals: Where vehicles stop by themselves.
        run_s: How long they drive at most.
        spawns: What is beside each lane, and where vehicle types were measured to stand.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        settings: Settings,
        limits: Limits,
        tolerances: Tolerances,
        goals: GoalFinder,
        run_s: float,
        spawns: SpawnTable,
    ) -> None:
        self._goals = goals
        self._run_s = run_s
        self._spawns = spawns
        self._map = map_model
        self._types = types
        self._settings = settings
        self._limits = limits
        self._tolerances = tolerances

    def convoy(self, spec: ScenarioSpec, split: SceneSplit, site: Site) -> list[GroundedAgent]:
        """Return the convoy's members in the order of the specification."""
        release = convoy_release(spec, split)
        apart = group_releases(spec, split)
        seats = {s.agent.id: s for s in (*site.seated, *site.others)}
        network, speeds = self._map.network, self._settings.grounding.speeds
        styles = ConvoyStyles(
            spec, site, self._types, network, self._settings, self._limits, self._tolerances
        )
        waiting = {
            name: Release(on=ReleaseOn.PARTED, agent=front, beyond_m=beyond_m)
            for name, front, beyond_m in head_starts(
                spec, site, self._types, network, self._tolerances
            )
        }
        entries = entry_speeds_mps(spec, seats, self._types, network, speeds)
        placed = []
        for agent in spec.agents:
            seat = seats.get(agent.id)
            if seat is None:
                continue
            parked = parks(spec, agent)
            still = parked or (stands(agent) and parks_after(spec, agent) is None)
            begins = waiting.get(agent.id, apart.get(agent.id, release))
            placed.append(
                self._grounded(
                    agent,
                    seat.path,
                    seat.arc_m,
                    release=own_release(spec, agent, begins),
                    still=still,
                    speed_mps=styles.leads_mps(agent) or self._stated_mps(spec, agent),
                    entry_mps=entries.get(agent.id, 0.0),
                    style=styles.of(seat),
                    lane_changes=self._lane_changes(spec, agent, tied=len(site.seated) > 1),
                    stop_m=self._goals.stop_arc_m(spec, site, seat),
                    parked=parked,
                )
            )
        return placed

    def _stated_mps(self, spec: ScenarioSpec, agent: GroundAgent) -> float | None:
        return stated_speed_mps(spec, agent, self._settings.grounding.speeds)

    def free(
        self,
        spec: ScenarioSpec,
        split: SceneSplit,
        site: Site,
        placed: list[GroundedAgent],
        uavs: Sequence[UavPlan],
        run_m: float,
        generator: np.random.Generator,
    ) -> tuple[list[GroundedAgent], tuple[str, ...]]:
        """Add the free vehicles on random lanes around, apart from everybody else.

        Who talks by radio with somebody who stays at a place keeps near that place.

        Returns:
            All agents in the order of the specification, and what found no place.
        """
        x0, y0, _, _ = site.origin()
        found = {a.id: a for a in placed}
        room = FreeRoom(self._map.network, (x0, y0), self._settings.grounding.background_gap_m)
        for other in placed:
            room.take(other.x_m, other.y_m)
        missing = []
        for agent in split.free:
            release = own_release(spec, agent, Release())
            reaches = reaches_of(spec, agent.id, placed, uavs, self._limits)
            hearing = Hearing(self._map.network, reaches)
            grounded = self._free_agent(
                spec, agent, release, room, hearing, run_m, generator, parked=parks(spec, agent)
            )
            if grounded is None:
                missing.append(f'{agent.id}: no free lane within reach')
            else:
                found[agent.id] = grounded
                room.take(grounded.x_m, grounded.y_m)
        return [found[a.id] for a in spec.agents if a.id in found], tuple(missing)

    def _free_agent(
        self,
        spec: ScenarioSpec,
        agent: GroundAgent,
        release: Release,
        room: FreeRoom,
        hearing: Hearing,
        run_m: float,
        generator: np.random.Generator,
        *,
        parked: bool,
    ) -> GroundedAgent | None:
        record = self._types[agent.type.value]
        speed_mps = self._stated_mps(spec, agent)
        network = self._map.network
        drivable, least_mps = brisk_lanes(
            list(network.driving_lanes(record.vclass)), speed_mps or 0.0
        )
        finder = route_finder(network, record.vclass, least_mps)
        low, high = self._settings.grounding.background_radius_m
        lanes = [
            lane
            for lane in drivable
            if finder.endless(lane.edge_id) and lane.length_m > 2.0 * record.length_m + 4.0
        ]
        if any(p.of == Place.MAIN_ROAD for p in agent.placements):
            lanes = on_main_roads(lanes)
        if any(p.of == Place.ROADSIDE for p in agent.placements):
            lanes = [lane for lane in lanes if self._is_outermost(lane, record.vclass)]
        if changes_lane(spec, agent):
            lanes = with_lane_beside(lanes, first_side(spec, agent))
        if not lanes:
            return None
        heard = [lane for lane in lanes if hearing.ends_inside(lane.edge_id)]
        if hearing.reaches and heard:
            lanes, low, high = heard, 0.0, inf
        margin = record.length_m / 2.0 + 1.0
        drawn = ((p, high) for p in room.drawn(lanes, margin, generator))
        # A crowd that fills the surroundings may spread over the whole map.
        scanned = ((p, inf) for p in room.scanned(lanes, margin))
        pace_mps = speed_mps or self._settings.grounding.target_speed_mps
        needed_m = needed_run_m(spec, agent, pace_mps)
        best: tuple[tuple[float, float], RoutePath, float] | None = None
        tries = 0
        for (lane, position, away_m), reach in itertools.chain(drawn, scanned):
            if not low <= away_m <= reach:
                continue
            if not may_stand(self._spawns, record.name, lane.id, arc_at(lane, position)):
                continue
            edges = finder.wandering_route(lane.edge_id, run_m, generator, hearing.ends_inside)
            try:
                path = network.route_path(
                    edges,
                    record.vclass,
                    start_lane_id=lane.id,
                    # The place itself stays on the lane; a lane change comes after it.
                    start_pos_m=min(position + record.length_m, lane.length_m),
                )
            except MapError:
                continue
            arc_m = path.arc_of(lane.id, position)
            tries += 1
            suits = hearing.share_inside(path, arc_m), min(needed_m, free_run_m(path, arc_m))
            if best is None or suits > best[0]:
                best = (suits, path, arc_m)
            if best[0] >= (1.0, needed_m) or tries >= _RUNS_TRIED:
                break
        if best is None:
            return None
        _, path, arc_m = best
        stop_m = None
        if stops(agent):
            stop_m = self._goals.open_arc_m(agent, path, arc_m + stop_after_m(agent))
        return self._grounded(
            agent,
            path,
            arc_m,
            release=release,
            still=parked or stands(agent),
            speed_mps=speed_mps,
            style=free_style(agent, self._settings.grounding.speeds),
            lane_changes=self._lane_changes(spec, agent, tied=False),
            stop_m=stop_m,
            parked=parked,
        )

    def _is_outermost(self, lane: Lane, vclass: str) -> bool:
        """Tell whether no lane for a class is to the right of a lane."""
        right = self._spawns.samples.right_of(lane.id)
        return right is None or vclass not in self._map.network.lane(right).allows

    def _beyond_limits(
        self, agent: GroundAgent, path: RoutePath, arc_m: float, speed_mps: float | None
    ) -> float:
        """Return the factor with which a stated speed is kept where the way does not allow it.

        That is so where no street allows it, and where the way comes to a slower one later on that
        is long enough to be judged on; in a roundabout everybody slows down.
        """
        bounds = {b.speed_mps.bound for b in agent.behaviors if b.speed_mps is not None}
        if speed_mps is None or Bound.AT_MOST in bounds:
            return 0.0
        where = self._map.network, path, arc_m
        limits = limits_mps(*where, _SHOWN_WAY_M)
        if speed_mps <= max(limits) + LIMIT_SLACK_MPS:
            room_m = 2.0 * self._tolerances.free_road_m
            limits = limits_mps(*where, speed_mps * self._run_s, longer_m=room_m)
        least_mps = min(limits, default=speed_mps)
        return speed_mps / least_mps if speed_mps > least_mps + LIMIT_SLACK_MPS else 0.0

    def _grounded(
        self,
        agent: GroundAgent,
        path: RoutePath,
        arc_m: float,
        *,
        release: Release,
        still: bool,
        speed_mps: float | None,
        style: dict[str, float],
        lane_changes: int | None,
        stop_m: float | None,
        parked: bool = False,
        entry_mps: float = 0.0,
    ) -> GroundedAgent:
        record = self._types[agent.type.value]
        lane_id, position_m = path.lane_position_at(arc_m)
        lane = self._map.network.lane(lane_id)
        lane_arc_m = arc_at(lane, position_m)
        first = lane.edge_id
        late = still or release.on is not ReleaseOn.START
        factor = max(style.get('speed_factor', 1.0), urged_factor(record, speed_mps))
        factor = max(factor, self._beyond_limits(agent, path, arc_m, speed_mps))
        edges = path.edge_ids[path.edge_ids.index(first) :]
        x, y, hx, hy = path.body_at(arc_m, record.length_m)
        if parked:
            x, y, _, _ = parked_pose((x, y, hx, hy), lane, record)
        route_xy_m = ((x, y), *line_from(path, arc_m)[1:])
        stop_lane_id, stop_position_m = '', 0.0
        if stop_m is not None:
            stop_lane_id, position_m = path.lane_position_at(stop_m)
            stop_position_m = arc_at(self._map.network.lane(stop_lane_id), position_m)
        return GroundedAgent(
            id=agent.id,
            type_name=agent.type.value,
            is_person=False,
            length_m=record.length_m,
            width_m=record.width_m,
            height_m=record.height_m,
            role=agent.role.value,
            edges=edges,
            route_xy_m=route_xy_m,
            lane_id=lane_id,
            lane_position_m=lane_arc_m,
            x_m=x,
            y_m=y,
            heading_x=hx,
            heading_y=hy,
            # The simulator refuses who enters faster than its style of driving lets it be.
            speed_mps=0.0 if late else min(entry_mps, factor * lane.speed_limit_mps),
            speed_factor=factor,
            time_gap_s=style.get('time_gap_s'),
            min_gap_m=style.get('min_gap_m'),
            gentle_mps2=style.get('gentle_mps2'),
            lane_change_mode=lane_changes,
            release=ReleaseOn.NEVER if still else release.on,
            release_uav=release.uav,
            release_mission=release.mission,
            release_agent=release.agent,
            release_within_m=release.within_m,
            release_beyond_m=release.beyond_m,
            release_after_s=release.after_s,
            drive_speed_mps=speed_mps,
            acceleration_mps2=record.accel_mps2,
            deceleration_mps2=record.decel_mps2,
            top_speed_mps=record.desired_speed_mps or record.max_speed_mps,
            parked=parked,
            runs_red=in_emergency(agent),
            stop_lane_id=stop_lane_id,
            stop_position_m=stop_position_m,
            stop_s=stop_time_s(agent),
        )

    def _lane_changes(self, spec: ScenarioSpec, agent: GroundAgent, *, tied: bool) -> int | None:
        """Return when a vehicle changes lane of its own accord, as a SUMO bit set."""
        if changes_lane(spec, agent):
            return ORDERED_CHANGES
        return self._settings.run.convoy_lane_change_mode if tied else None
