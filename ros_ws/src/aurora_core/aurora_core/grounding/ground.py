# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ground a specification: rank the sites of a map and turn relations into places.

Source: paper, "Joint road-airspace grounding", eq. (2).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from aurora_core.grounding.agents import AgentPlacer
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.allowed import allowed_sites
from aurora_core.grounding.apart import homes_m, layer_m, over_one_point, spacing_m, tight_m
from aurora_core.grounding.bends import bends_between
from aurora_core.grounding.columns import Column, climbs_to_m, columns, nearest_points
from aurora_core.grounding.convoy import SceneSplit
from aurora_core.grounding.flights import FlightPlanner
from aurora_core.grounding.free_run import never_stops
from aurora_core.grounding.goals import GoalFinder
from aurora_core.grounding.groups import GroupPlacer
from aurora_core.grounding.keep_out import kept_out
from aurora_core.grounding.lane_changers import (
    changes_in_time,
    changes_lane,
    needs_lane,
    share_with_another_lane,
)
from aurora_core.grounding.laps import Laps
from aurora_core.grounding.leads import leads_m
from aurora_core.grounding.neighbours import Neighbours
from aurora_core.grounding.oncoming import OncomingPlacer
from aurora_core.grounding.pace import (
    PACED,
    fastest_stated_mps,
    outruns,
    own_speed_mps,
    timed_way_m,
    watched_speed_mps,
)
from aurora_core.grounding.persons import PersonPlacer
from aurora_core.grounding.places import MapPlaces
from aurora_core.grounding.planned_flight import PlannedFlight, Rejected, planned_height_m
from aurora_core.grounding.premises import (
    anchor_arc_m,
    comes_about,
    heard,
    starts_out_of_reach,
    stays_apart,
)
from aurora_core.grounding.radio import link_score
from aurora_core.grounding.realised import realised_values
from aurora_core.grounding.shown_speed import LOOKED_S, all_show, room_for, shows_before
from aurora_core.grounding.sites import Site, TriedSite, sites, tied_way_m
from aurora_core.grounding.splits import splits
from aurora_core.grounding.spots import SpotFinder
from aurora_core.grounding.time_need import horizon_s
from aurora_core.grounding.traffic import TrafficPlacer
from aurora_core.grounding.uav_speeds import within_speeds
from aurora_core.grounding.unplaced import lacked, on_no_street
from aurora_core.grounding.wind import gust_over_mean_mps, mean_wind_mps
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.basis import Basis
from aurora_core.knowledge.limits import Limits, Tolerances, hover_capture_m
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import SpawnTable, WalkTable, not_measured
from aurora_core.knowledge.settings import Settings
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import AnchorScore, GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.outcomes.repair import RepairPlan
from aurora_core.ports.random_streams import stream
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec

# Clearance that earns the full air score (m above the planned clearance).
_GOOD_CLEARANCE_M = 15.0
# A score that no later site can beat by more than rounding.
_PERFECT = 1.0 - 1e-9
# What is left of a road's score where a bend spoils a stated distance.
_BENT = 0.1
# And where it leads by turns, or does not lead, to where an event waits for somebody.
_DETOUR = 0.6
_ASTRAY = 0.1
# And where two who are to come near each other are so from the start on, or never.
_NEVER = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class _Option:
    site: Site
    uavs: tuple[UavPlan, ...]
    score: AnchorScore


class Grounder:
    """Grounds specifications on one map; the map's indices are built once.

    Args:
        map_model: Map.
        types: Agent sizes.
        limits: Limits in force.
        tolerances: Tolerances in force.
        settings: Search settings.
        basis: What the grounding says it was made with.
        executor_version: Version of the executor that will run it, written there too.
        spawns: Where vehicle types were measured to stand; None where the map was not measured.
        airspace: Of the map, when it exists already.
        walks: Which sidewalks and crossings were walked; None where the map was not measured.
    """

    def __init__(
        self,
        map_model: MapModel,
        types: Mapping[str, AgentTypeRecord],
        limits: Limits,
        tolerances: Tolerances,
        settings: Settings,
        basis: Basis | None = None,
        executor_version: int = 0,
        spawns: SpawnTable | None = None,
        airspace: Airspace | None = None,
        walks: WalkTable | None = None,
    ) -> None:
        self._map = map_model
        self._basis = basis
        self._executor_version = executor_version
        self._spawns = not_measured(map_model) if spawns is None else spawns
        self._walks = walks
        self._types = types
        self._limits = limits
        self._tolerances = tolerances
        self._settings = settings
        if airspace is None:
            airspace = Airspace(map_model.buildings, map_model.zones)
        self._air = airspace
        self._spots = SpotFinder(map_model, settings.grounding)
        self._goals = GoalFinder(map_model, types, tolerances, settings.grounding)

    def ground(
        self,
        spec: ScenarioSpec,
        seed: int,
        plan: RepairPlan | None = None,
        tried: list[TriedSite] | None = None,
    ) -> GroundedScenario | GroundingFailure:
        """Return the best grounding, or what every site lacked.

        Args:
            spec: What to ground.
            seed: Seed of the run (background traffic).
            plan: Where the scene may not be, or has to stay; its values are in `spec` already.
            tried: Takes every site that was looked at, in order; for pictures.
        """
        tried = [] if tried is None else tried
        failure: GroundingFailure | None = None
        for split in splits(spec, self._tolerances.placement_vehicle_m, self._types):
            found = self._ground(spec, split, seed, plan, tried)
            if not isinstance(found, GroundingFailure):
                return found
            failure = failure or found
        assert failure is not None  # a scene has a split
        return failure

    def _ground(
        self,
        spec: ScenarioSpec,
        split: SceneSplit,
        seed: int,
        plan: RepairPlan | None,
        tried: list[TriedSite],
    ) -> GroundedScenario | GroundingFailure:
        keep_out = kept_out(spec, MapPlaces(self._map))
        planner = FlightPlanner(
            map_model=self._map,
            airspace=self._air.keeping_out(keep_out),
            spots=self._spots,
            types=self._types,
            limits=self._limits,
            tolerances=self._tolerances,
            settings=self._settings.grounding,
            sensing_range_m=self._limits.sensing_range(
                spec.world.weather.value, spec.world.time_of_day.value
            ),
            hover_capture_m={
                uav.id: hover_capture_m(spec, uav.id, self._limits, self._tolerances)
                for uav in spec.uavs
            },
            apart_m=spacing_m(spec, self._limits),
            homes_m=homes_m(spec, self._limits),
            laps=Laps(self._settings),
            leads_m=leads_m(spec, split, self._types, self._limits, self._settings),
        )
        run_s = horizon_s(spec, self._limits, self._settings.flight)
        run_m = run_s * self._drive_speed(spec, split) + 300.0
        persons = PersonPlacer(
            self._map,
            self._types,
            self._settings.grounding.persons,
            self._tolerances,
            self._walks,
        )
        oncoming = OncomingPlacer(
            self._map, self._types, self._settings.grounding.inside_bound_m, self._spawns
        )
        ranked = self._ranked_sites(spec, split, run_m)
        if plan is not None:
            ranked = allowed_sites(ranked, plan, self._map.network)
        groups = GroupPlacer(
            self._map,
            self._types,
            self._goals,
            self._settings.grounding,
            spec,
            split.groups if ranked else (),
            split.groups_before if ranked else (),
            run_m,
            self._spawns,
        )
        rejected: Counter[str] = Counter()
        best: _Option | None = None
        scored = 0
        for road, site in ranked:
            enough = scored >= self._settings.grounding.anchors_scored
            if best is not None and (enough or best.score.joint >= _PERFECT):
                break
            peopled = oncoming.seated(split.oncoming, site, run_m)
            if not isinstance(peopled, str):
                peopled = groups.seated(peopled)
            if not isinstance(peopled, str):
                peopled = persons.seated(spec, split, peopled, run_s)
            if isinstance(peopled, str):
                rejected[peopled] += 1
                tried.append(TriedSite.of(site, why=peopled))
                continue
            scored += 1
            road *= 1.0 if comes_about(spec, peopled, MapPlaces(self._map), self._air) else _NEVER
            road *= all_show(spec, peopled, self._map.network, self._tolerances)
            option = self._option(spec, peopled, road, planner)
            if isinstance(option, Rejected):
                rejected[option.reason] += 1
                tried.append(TriedSite.of(site, why=option.reason))
                continue
            tried.append(TriedSite.of(site, joint=option.score.joint))
            if best is None or option.score.joint > best.score.joint:
                best = option
        if best is None:
            reasons = dict(sorted(rejected.items()))
            most = max(reasons, key=lambda r: (reasons[r], r)) if reasons else 'road'
            count = sum(reasons.values())
            words = lacked(most, split)
            if not ranked:
                known = self._map, self._types, self._settings.grounding, self._spawns
                words = on_no_street(spec, split, self._goals, *known, run_m)
            return GroundingFailure(reason=most, tried=count, rejected_by=reasons, words=words)
        times = run_s, run_m
        made = self._scenario(spec, split, best, scored, times, seed, planner, persons)
        return made.model_copy(update={'keep_out': keep_out}) if keep_out else made

    def _drive_speed(self, spec: ScenarioSpec, split: SceneSplit) -> float:
        stated = [
            b.speed_mps.value for a in spec.agents for b in a.behaviors if b.speed_mps is not None
        ]
        # 20 m/s is above every speed limit that a slowed convoy or free traffic drives at.
        return max([20.0, *stated])

    def _ranked_sites(
        self, spec: ScenarioSpec, split: SceneSplit, run_m: float
    ) -> list[tuple[float, Site]]:
        """Return the sites by the score of their roads, on streets that allow a stated speed.

        Where none of these has room, a vehicle drives faster than its street allows, and passes
        who is parked without a second lane.
        """
        members = [m.agent for m in split.convoy]
        stated = fastest_stated_mps(spec, members, self._settings.grounding.speeds)
        several = [any(does(spec, a) for a in members) for does in (changes_lane, needs_lane)]
        for least_mps, lanes in dict.fromkeys(product((stated, 0.0), several)):
            ranked = self._ranked_on(
                spec, split, run_m, stated, least_limit_mps=least_mps, several_lanes=lanes
            )
            if ranked:
                return ranked
        return []

    def _ranked_on(
        self,
        spec: ScenarioSpec,
        split: SceneSplit,
        run_m: float,
        stated: float,
        *,
        least_limit_mps: float,
        several_lanes: bool,
    ) -> list[tuple[float, Site]]:
        grounding = self._settings.grounding
        way_m = tied_way_m(spec, grounding)
        changing = {m.agent.id for m in split.convoy if changes_lane(spec, m.agent)}
        need_m = way_m if len(split.convoy) > 1 else LOOKED_S / 2.0 * stated
        members = [m.agent for m in split.convoy]
        goes_on = never_stops(spec, members)
        # A red light would part them.
        followed = any(b.kind in PACED for agent in members for b in agent.behaviors)
        need_m = run_m if goes_on else max(need_m, timed_way_m(spec, members, grounding))
        wanted = grounding.target_speed_mps
        ranked: list[tuple[float, Site]] = []
        places = MapPlaces(self._map)
        weather, time_of_day = spec.world.weather.value, spec.world.time_of_day.value
        range_m = self._limits.sensing_range(weather, time_of_day)

        def found(goals: tuple[frozenset[str], ...]) -> Iterator[Site]:
            return sites(
                self._map,
                split.convoy,
                self._types,
                grounding,
                run_m,
                self._goals.spacing_m(spec, grounding.anchor_spacing_m),
                split.before,
                least_limit_mps=least_limit_mps,
                several_lanes=several_lanes,
                spawns=self._spawns,
                goals=goals,
            )

        for site in self._fitting(spec, members, found):
            free = min(1.0, site.free_run_m / need_m) if need_m > 0.0 else 1.0
            limit_mps = site.fastest_mps(self._map.network, way_m)
            brisk = min(1.0, limit_mps / wanted)
            straight = max(0.0, 1.0 - site.turns(way_m, grounding) / grounding.turns_bad)
            road = 0.4 * free + 0.2 * float(site.steady) + 0.2 * brisk + 0.2 * straight
            road *= max(_NEVER, free * straight) if goes_on else 1.0
            road *= 0.5 + 0.5 * free if followed else 1.0
            if bends_between(spec, site, self._tolerances.placement_vehicle_m, split.before):
                road *= _BENT
            if not self._goals.leads(spec, site):
                road *= _DETOUR if self._goals.leads(spec, site, wide=True) else _ASTRAY
            if outruns(spec, limit_mps, grounding.speeds):
                road *= _ASTRAY
            road *= max(_NEVER, heard(spec, site, places, self._limits))
            road *= max(_NEVER, stays_apart(spec, site))
            if not starts_out_of_reach(spec, site, places, range_m):
                road *= _ASTRAY
            if stated > 0.0:
                road *= room_for(stated, spec, site, self._tolerances)
            road *= max(_NEVER, shows_before(site, self._map.network, self._tolerances))
            for seat in site.seated:
                if several_lanes and seat.agent.id in changing:
                    pace_mps = own_speed_mps(seat.agent) or stated or wanted
                    road *= share_with_another_lane(spec, self._map.network, seat, way_m, pace_mps)
                    in_time = changes_in_time(spec, self._map.network, seat, pace_mps)
                    road *= max(_NEVER, in_time)
            ranked.append((road, site))
        # Stable: equal scores keep the order of the map.
        ranked.sort(key=lambda r: -r[0])
        return ranked

    def _fitting(
        self,
        spec: ScenarioSpec,
        members: list[GroundAgent],
        found: Callable[[tuple[frozenset[str], ...]], Iterator[Site]],
    ) -> Iterator[Site]:
        """Yield the sites that lead their vehicles to their places: straight on, else by turns."""
        led = False
        for site in found(()):
            if self._goals.fits(spec, site):
                led = led or self._goals.leads(spec, site)
                yield site
        goals = () if led else self._goals.edges_on_the_way(spec, members)
        if goals:
            for site in found(goals):
                if self._goals.fits(spec, site, wide=True):
                    yield site

    def _option(
        self,
        spec: ScenarioSpec,
        site: Site,
        road: float,
        planner: FlightPlanner,
    ) -> _Option | Rejected:
        flown_by: dict[str, list[PlannedFlight]] = {}
        uavs: list[UavPlan] = []
        hovering: list[Column] = []
        routes: list[MissionPlan] = []
        for number, uav in enumerate(spec.uavs):
            own = flown_by[uav.id] = []
            for mission in spec.missions:
                if mission.uav != uav.id:
                    continue
                speed = watched_speed_mps(spec, mission, self._limits, self._settings.grounding)
                height_m = planned_height_m(mission, self._limits, self._tolerances)
                top_m = climbs_to_m(spec, uav.id, height_m)
                share = over_one_point(spec, mission, self._limits)
                apart_m = (tight_m if share[1] > 1 else spacing_m)(spec, self._limits)
                others = Neighbours(
                    points=nearest_points(hovering, height_m, top_m),
                    routes=() if own else tuple(routes),
                    apart_m=apart_m,
                    layer_m=layer_m(spec, self._limits),
                    share=share,
                )
                flight = planner.plan_mission(spec, mission, site, speed, others, own)
                if isinstance(flight, Rejected):
                    return flight
                own.append(flight)
            if not own:
                continue
            taken = [(u.home_x_m, u.home_y_m) for u in uavs]
            last = next(m for m in reversed(spec.missions) if m.uav == uav.id)
            plan = planner.plan_uav(
                uav.id,
                number + 1,
                own,
                site,
                taken,
                lands=not last.ends_in_flight,
            )
            if isinstance(plan, Rejected):
                return plan
            uavs.append(within_speeds(spec, plan, self._limits, self._settings.grounding))
            hovering += columns(spec, uav.id, (f.plan.hover_point for f in own))
            routes += [own[0].plan] if own[0].plan.waypoints else []
        return _Option(
            site=site,
            uavs=planner.uncrossed(uavs, site),
            score=self._score(road, flown_by, spec, site),
        )

    def _score(
        self,
        road: float,
        flown_by: Mapping[str, Sequence[PlannedFlight]],
        spec: ScenarioSpec,
        site: Site,
    ) -> AnchorScore:
        flights = [flight for own in flown_by.values() for flight in own]
        planned = self._settings.grounding.clearance_m
        spare = min((f.clearance_m - planned for f in flights), default=_GOOD_CLEARANCE_M)
        air = max(0.0, min(1.0, spare / _GOOD_CLEARANCE_M))
        sense = min((f.seen for f in flights), default=1.0)
        comm = link_score(spec, site, flown_by, self._air, self._types, self._limits)
        w = self._settings.grounding.weights
        total = w.road + w.air + w.sense + w.comm
        joint = (w.road * road + w.air * air + w.sense * sense + w.comm * comm) / total
        return AnchorScore(road=road, air=air, sense=sense, comm=comm, joint=joint)

    def _scenario(
        self,
        spec: ScenarioSpec,
        split: SceneSplit,
        best: _Option,
        scored: int,
        times: tuple[float, float],
        seed: int,
        planner: FlightPlanner,
        persons: PersonPlacer,
    ) -> GroundedScenario:
        run_s, run_m = times
        uavs = tuple(planner.with_landing_spots(u, best.site) for u in best.uavs)
        known, rules = (self._map, self._types), (self._limits, self._tolerances)
        placer = AgentPlacer(*known, self._settings, *rules, self._goals, run_s, self._spawns)
        agents = [*placer.convoy(spec, split, best.site), *persons.grounded(spec, best.site)]
        generator = stream(seed, 'grounding:background')
        agents, missing = placer.free(spec, split, best.site, agents, uavs, run_m, generator)
        traffic = TrafficPlacer(*known, self._settings.grounding, *rules, self._spawns)
        homes = [(uav.home_x_m, uav.home_y_m) for uav in uavs]
        draws = stream(seed, 'grounding:traffic')
        agents += traffic.placed(spec, agents, homes, run_m, draws)
        weather = spec.world.weather.value
        range_m = self._limits.sensing_range(weather, spec.world.time_of_day.value)
        arc_m = anchor_arc_m(spec, best.site, range_m)
        lane_id, position_m = best.site.origin_path.lane_position_at(arc_m)
        wind_mps = mean_wind_mps(spec, agents, uavs, self._limits, self._tolerances, seed)
        unsupported = (*split.unsupported, *missing)
        return GroundedScenario(
            map_name=self._map.name,
            map_digest=self._map.digest,
            anchor_lane=lane_id,
            anchor_position_m=position_m,
            score=best.score,
            candidates=scored,
            agents=tuple(agents),
            uavs=uavs,
            realised=realised_values(spec, tuple(agents), uavs),
            unsupported=unsupported,
            weather=weather,
            time_of_day=spec.world.time_of_day.value,
            wind_mean_east_mps=wind_mps[0],
            wind_mean_north_mps=wind_mps[1],
            wind_gust_mps=gust_over_mean_mps(spec, wind_mps, self._limits, self._tolerances),
            seed=seed,
            basis=self._basis,
            configuration='' if self._basis is None else self._basis.sha256,
            executor_version=self._executor_version,
        )
