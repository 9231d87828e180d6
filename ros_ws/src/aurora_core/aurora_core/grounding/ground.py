# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ground a specification: rank the sites of a map and turn relations into places.

Source: paper, "Joint road-airspace grounding", eq. (2).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from aurora_core.grounding.agents import AgentPlacer
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.convoy import SceneSplit, split_scene
from aurora_core.grounding.flights import FlightPlanner, PlannedFlight, Rejected
from aurora_core.grounding.pace import watched_speed_mps
from aurora_core.grounding.realised import realised_values
from aurora_core.grounding.sites import Site, sites, tied_way_m
from aurora_core.grounding.spots import SpotFinder
from aurora_core.grounding.time_need import horizon_s
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.basis import Basis
from aurora_core.knowledge.limits import Limits, Tolerances, hover_drift_limit_m
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import Settings
from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.grounded import AnchorScore, GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.ports.random_streams import stream
from aurora_core.spec.scenario import ScenarioSpec

# Clearance that earns the full air score (m above the planned clearance).
_GOOD_CLEARANCE_M = 15.0

# A score that no later site can beat by more than rounding.
_PERFECT = 1.0 - 1e-9


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
    ) -> None:
        self._map = map_model
        self._basis = basis
        self._executor_version = executor_version
        self._types = types
        self._limits = limits
        self._tolerances = tolerances
        self._settings = settings
        self._air = Airspace(map_model.buildings, map_model.zones)
        self._spots = SpotFinder(map_model, settings.grounding)

    def ground(self, spec: ScenarioSpec, seed: int) -> GroundedScenario | GroundingFailure:
        """Return the best grounding, or what every site lacked.

        Args:
            spec: What to ground.
            seed: Seed of the run (background traffic).
        """
        split = split_scene(spec)
        planner = FlightPlanner(
            map_model=self._map,
            airspace=self._air,
            spots=self._spots,
            types=self._types,
            limits=self._limits,
            tolerances=self._tolerances,
            settings=self._settings.grounding,
            sensing_range_m=self._limits.sensing_range(
                spec.world.weather.value, spec.world.time_of_day.value
            ),
            hover_drift_m=hover_drift_limit_m(
                spec.world.weather.value, self._limits, self._tolerances
            ),
        )
        run_m = horizon_s(spec, self._limits) * self._drive_speed(spec, split) + 300.0
        ranked = self._ranked_sites(spec, split, run_m)
        rejected: Counter[str] = Counter()
        best: _Option | None = None
        scored = 0
        for road, site in ranked:
            enough = scored >= self._settings.grounding.anchors_scored
            if best is not None and (enough or best.score.joint >= _PERFECT):
                break
            scored += 1
            option = self._option(spec, split, site, road, planner)
            if isinstance(option, Rejected):
                rejected[option.reason] += 1
            elif best is None or option.score.joint > best.score.joint:
                best = option
        if best is None:
            reasons = dict(sorted(rejected.items()))
            most = max(reasons, key=lambda r: (reasons[r], r)) if reasons else 'road'
            return GroundingFailure(reason=most, tried=scored, rejected_by=reasons)
        return self._scenario(spec, split, best, scored, run_m, seed, planner)

    def _drive_speed(self, spec: ScenarioSpec, split: SceneSplit) -> float:
        stated = [
            b.speed_mps.value for a in spec.agents for b in a.behaviors if b.speed_mps is not None
        ]
        # 20 m/s is above every speed limit that a slowed convoy or free traffic drives at.
        return max([20.0, *stated])

    def _ranked_sites(
        self, spec: ScenarioSpec, split: SceneSplit, run_m: float
    ) -> list[tuple[float, Site]]:
        grounding = self._settings.grounding
        way_m = tied_way_m(spec, grounding)
        need_m = way_m if len(split.convoy) > 1 else 0.0
        wanted = grounding.target_speed_mps
        ranked: list[tuple[float, Site]] = []
        found = sites(self._map, split.convoy, self._types, run_m, grounding, split.before)
        for site in found:
            free = min(1.0, site.free_run_m / need_m) if need_m > 0.0 else 1.0
            brisk = min(1.0, site.fastest_mps(self._map.network, way_m) / wanted)
            straight = max(0.0, 1.0 - site.turns(way_m, grounding) / grounding.turns_bad)
            road = 0.4 * free + 0.2 * float(site.steady) + 0.2 * brisk + 0.2 * straight
            ranked.append((road, site))
        # Stable: equal scores keep the order of the map.
        ranked.sort(key=lambda r: -r[0])
        return ranked

    def _option(
        self,
        spec: ScenarioSpec,
        split: SceneSplit,
        site: Site,
        road: float,
        planner: FlightPlanner,
    ) -> _Option | Rejected:
        flights: list[PlannedFlight] = []
        uavs: list[UavPlan] = []
        for number, uav in enumerate(spec.uavs):
            own: list[PlannedFlight] = []
            hovering = [f.plan.hover_point for f in flights if f.plan.hover_point is not None]
            for mission in spec.missions:
                if mission.uav != uav.id:
                    continue
                speed = watched_speed_mps(spec, mission, self._limits, self._settings.grounding)
                flight = planner.plan_mission(spec, mission, site, speed, hovering)
                if isinstance(flight, Rejected):
                    return flight
                own.append(flight)
            if not own:
                continue
            taken = [(u.home_x_m, u.home_y_m) for u in uavs]
            plan = planner.plan_uav(uav.id, number + 1, own, site, taken)
            if isinstance(plan, Rejected):
                return plan
            uavs.append(plan)
            flights += own
        return _Option(
            site=site,
            uavs=planner.uncrossed(uavs, site),
            score=self._score(road, flights, spec),
        )

    def _score(self, road: float, flights: list[PlannedFlight], spec: ScenarioSpec) -> AnchorScore:
        planned = self._settings.grounding.clearance_m
        spare = min((f.clearance_m - planned for f in flights), default=_GOOD_CLEARANCE_M)
        air = max(0.0, min(1.0, spare / _GOOD_CLEARANCE_M))
        sense = min((f.seen for f in flights), default=1.0)
        comm = sense if spec.links else 1.0
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
        run_m: float,
        seed: int,
        planner: FlightPlanner,
    ) -> GroundedScenario:
        uavs = tuple(planner.with_landing_spots(u, best.site) for u in best.uavs)
        placer = AgentPlacer(self._map, self._types, self._settings, self._limits)
        agents = placer.convoy(spec, split, best.site)
        generator = stream(seed, 'grounding:background')
        agents, missing = placer.free(spec, split, best.site, agents, run_m, generator)
        lane_id, position_m = best.site.origin_path.lane_position_at(best.site.origin_arc_m)
        weather = spec.world.weather.value
        unsupported = (
            *split.unsupported,
            *(f'{p.id}: pedestrians' for p in split.persons),
            *missing,
        )
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
            wind_mean_east_mps=self._limits.wind_mean_mps[weather],
            wind_gust_mps=self._limits.wind_gust_mps[weather],
            seed=seed,
            basis=self._basis,
            configuration='' if self._basis is None else self._basis.sha256,
            executor_version=self._executor_version,
        )
