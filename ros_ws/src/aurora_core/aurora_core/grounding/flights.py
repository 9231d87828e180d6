# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Plan the flights of a site: offsets, patterns and hover points that are clear and can see."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
import numpy.typing as npt
import shapely

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.pace import moves
from aurora_core.grounding.patterns import pattern_points, place_pattern
from aurora_core.grounding.places import (
    ROAD_STEP_M,
    ROAD_WAY_M,
    ROADS,
    intersection_point,
    landmark_point,
    road_point,
)
from aurora_core.grounding.sites import Site, samples_along
from aurora_core.grounding.spots import SpotFinder
from aurora_core.grounding.starts import uncrossed
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode, Pattern

FloatArray = npt.NDArray[np.float64]
Point3 = tuple[float, float, float]

# Planned share of a leg over a carriageway, beyond what the condition asks.
SPARE_SHARE = 0.05

_SIGHT_HEIGHT_PLACE_M = 1.0

# Half the distance of neighbours above one target, as a share of that of hovering ones: well
# inside the tracking tolerance.
_SHARED = 0.45

# Neighbours on a ring are as far apart as they have to be, to rounding.
_ROUNDING_M = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedFlight:
    """A mission with its scores: clearance (m), share of samples seen."""

    plan: MissionPlan
    clearance_m: float
    seen: float
    over_street: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Rejected:
    """Why a site does not do."""

    reason: str


class FlightPlanner:
    """Plans flights over one map.

    Args:
        map_model: Map.
        airspace: Its obstacles.
        spots: Its free spots.
        types: Agent sizes.
        limits: Limits in force.
        tolerances: Tolerances in force.
        settings: Search settings.
        sensing_range_m: Of the weather and time of day.
        hover_drift_m: Drift allowed while hovering; it is the capture tolerance as well.
    """

    def __init__(
        self,
        *,
        map_model: MapModel,
        airspace: Airspace,
        spots: SpotFinder,
        types: Mapping[str, AgentTypeRecord],
        limits: Limits,
        tolerances: Tolerances,
        settings: GroundingSettings,
        sensing_range_m: float,
        hover_drift_m: float,
    ) -> None:
        self._map = map_model
        self._air = airspace
        self._spots = spots
        self._types = types
        self._limits = limits
        self._tolerances = tolerances
        self._settings = settings
        self._range = sensing_range_m
        self._hover_drift_m = hover_drift_m
        self._apart_m = 2.0 * limits.separation_min_m
        self._leg_share = min(1.0, tolerances.over_carriageway_share + SPARE_SHARE)
        self._carriageway = map_model.network.carriageway
        shapely.prepare(self._carriageway)

    def plan_mission(
        self,
        spec: ScenarioSpec,
        mission: UavMission,
        site: Site,
        speed_mps: float,
        others: Sequence[Point3] = (),
    ) -> PlannedFlight | Rejected:
        """Plan one mission at a site.

        Args:
            spec: The request.
            mission: What to plan.
            site: Where.
            speed_mps: Speed that the target will drive.
            others: Where other UAVs hover.
        """
        if mission.mode is MissionMode.TRACK:
            return self._track(spec, mission, site, speed_mps)
        centre = self._centre(mission, site)
        if centre is None:
            return Rejected(reason='target_place')
        if mission.mode is MissionMode.HOVER:
            targets = self._watched(spec, mission, site, centre, speed_mps)
            return self._hover(mission, centre, targets, others)
        return self._navigate(mission, centre)

    def plan_uav(
        self,
        uav_id: str,
        system_id: int,
        flights: list[PlannedFlight],
        site: Site,
        taken: list[tuple[float, float]],
    ) -> UavPlan | Rejected:
        """Choose the start of a UAV whose missions are planned; it could land there again."""
        if not self._ways_between_are_free(flights, site):
            return Rejected(reason='way_between_missions')
        first = _first_point(flights[0].plan, site)
        home = None
        for spot in self._spots.near(first[0], first[1], 6 + 20 * len(taken)):
            far = all(
                norm2(spot[0] - x, spot[1] - y) >= self._settings.home_spacing_m for x, y in taken
            )
            top = (spot[0], spot[1], first[2])
            if far and self._air.way_clearance_m((top, first)) >= self._settings.clearance_m:
                home = spot
                break
        if home is None:
            return Rejected(reason='start_spot')
        highest = max(f.plan.altitude_m for f in flights)
        over_all = self._air.highest_m + 2.0 * self._settings.clearance_m
        return UavPlan(
            id=uav_id,
            system_id=system_id,
            home_x_m=home[0],
            home_y_m=home[1],
            landing_spots=(home,),
            missions=tuple(f.plan for f in flights),
            safe_altitude_m=min(self._limits.uav_altitude_max_m, max(highest, over_all)),
        )

    def uncrossed(self, plans: Sequence[UavPlan], site: Site) -> tuple[UavPlan, ...]:
        """Exchange starts so that UAVs at one height do not meet on their first ways."""
        return uncrossed(
            plans,
            [_first_point(p.missions[0], site) for p in plans],
            self._air,
            apart_m=self._apart_m,
            clearance_m=self._settings.clearance_m,
        )

    def _ways_between_are_free(self, flights: list[PlannedFlight], site: Site) -> bool:
        """Check the straight ways between missions, at both altitudes.

        Where a track mission ends is not known before; its ways are not checked.
        """
        for before, after in itertools.pairwise(f.plan for f in flights):
            if before.mode is MissionMode.TRACK:
                continue
            x, y, z = _last_point(before)
            to_x, to_y, to_z = _first_point(after, site)
            for height in {z, to_z}:
                way = ((x, y, height), (to_x, to_y, height))
                if self._air.way_clearance_m(way) < self._settings.clearance_m:
                    return False
        return True

    def with_landing_spots(self, plan: UavPlan, site: Site) -> UavPlan:
        """Add the free spots along everything that the UAV flies over."""
        spots = list(plan.landing_spots)
        for mission in plan.missions:
            for x, y in self._landing_areas(mission, site):
                spots += [s for s in self._spots.near(x, y) if s not in spots]
        return UavPlan.model_validate({**plan.model_dump(), 'landing_spots': tuple(spots)})

    def _track(
        self, spec: ScenarioSpec, mission: UavMission, site: Site, speed_mps: float
    ) -> PlannedFlight | Rejected:
        seat = site.seat(mission.target or '')
        if seat is None:
            return Rejected(reason='target_not_in_convoy')
        assert mission.standoff_m is not None
        assert mission.duration_s is not None
        record = self._types[seat.member.agent.type.value]
        way_m = speed_mps * (mission.duration_s.value + 6.0)
        samples = samples_along(seat.path, seat.arc_m, way_m, self._settings.sample_spacing_m)
        targets = np.column_stack(
            (samples[:, 0], samples[:, 1], np.full(len(samples), record.height_m / 2.0))
        )
        best: PlannedFlight | None = None
        for offset in self._offsets(mission, samples[0], self._share(spec, mission)):
            points = np.column_stack(
                (
                    samples[:, 0] + offset[0],
                    samples[:, 1] + offset[1],
                    np.full(len(samples), mission.altitude_m.value),
                )
            )
            clearance = self._air.points_clearance_m(points)
            if clearance < self._settings.clearance_m:
                continue
            seen = self._air.seen_share(points, targets, self._range)
            if best is None or (round(seen, 3), clearance) > (
                round(best.seen, 3),
                best.clearance_m,
            ):
                plan = self._hold_plan(mission, offset_m=offset)
                best = PlannedFlight(plan=plan, clearance_m=clearance, seen=seen, over_street=0.0)
        if best is None:
            return Rejected(reason='clearance')
        if best.seen < self._tolerances.visible_fraction:
            return Rejected(reason='sight')
        return best

    def _share(self, spec: ScenarioSpec, mission: UavMission) -> tuple[int, int]:
        """Return which one of how many UAVs this is that track one target at one height."""
        height_m = mission.altitude_m.value
        sharing = [
            m.uav
            for m in spec.missions
            if m.mode is MissionMode.TRACK
            and m.target == mission.target
            and abs(m.altitude_m.value - height_m) < self._apart_m
        ]
        uavs = list(dict.fromkeys(sharing))
        return uavs.index(mission.uav), len(uavs)

    def _offsets(
        self, mission: UavMission, start: FloatArray, share: tuple[int, int] = (0, 1)
    ) -> Iterator[tuple[float, float]]:
        own, count = share
        standoff = 0.0 if mission.standoff_m is None else mission.standoff_m.value
        if standoff == 0.0:
            # Above the target there is room for one; several stand round it.
            angle = 2.0 * pi * own / count
            radius_m = 0.0 if count == 1 else _SHARED * self._apart_m / sin(pi / count)
            yield radius_m * cos(angle), radius_m * sin(angle)
            return
        if mission.bearing_deg is not None:
            compass = mission.bearing_deg.value * pi / 180.0
            yield (standoff * sin(compass), standoff * cos(compass))
            return
        hx, hy = float(start[2]), float(start[3])
        # Behind the target first, then round it; the first of equal ones is taken. Of several
        # UAVs each has a sector, with a gap to the next one.
        bearings = self._settings.bearings
        first = own * bearings // count + (1 if count > 1 else 0)
        for k in range(first, (own + 1) * bearings // count):
            angle = 2.0 * pi * k / bearings
            c, s = cos(angle), sin(angle)
            yield (-standoff * (hx * c - hy * s), -standoff * (hx * s + hy * c))

    def _places(
        self,
        mission: UavMission,
        centre: tuple[float, float, float, float],
        others: Sequence[Point3],
    ) -> Iterator[tuple[float, float]]:
        """Yield the offsets of a hover point: beside the centre where somebody hovers over it."""
        yield from self._offsets(mission, np.array(centre))
        stands_off = mission.standoff_m is not None and mission.standoff_m.value > 0.0
        middle = (centre[0], centre[1], mission.altitude_m.value)
        if stands_off or self._apart(middle, others):
            return
        for ring in (1, 2):
            radius_m, count = ring * self._apart_m, 6 * ring
            for k in range(count):
                angle = 2.0 * pi * k / count
                yield radius_m * cos(angle), radius_m * sin(angle)

    def _apart(self, point: Point3, others: Sequence[Point3]) -> bool:
        return all(_distance(point, other) >= self._apart_m - _ROUNDING_M for other in others)

    def _altitude_slack(self, mission: UavMission) -> float:
        altitude = mission.altitude_m
        return self._tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)

    def _hold_plan(
        self,
        mission: UavMission,
        *,
        offset_m: tuple[float, float] = (0.0, 0.0),
        hover_point: Point3 | None = None,
    ) -> MissionPlan:
        standoff = 0.0 if mission.standoff_m is None else mission.standoff_m.value
        horizontal = self._limits.tracking_horizontal_m
        if mission.mode is MissionMode.HOVER:
            horizontal = self._hover_drift_m
        elif mission.standoff_m is not None and (
            mission.standoff_m.provenance is Provenance.EXPLICIT
        ):
            horizontal = self._tolerances.standoff_m.of(
                standoff, approximate=mission.standoff_m.approximate
            )
        assert mission.duration_s is not None
        slack = self._altitude_slack(mission)
        track = mission.mode is MissionMode.TRACK
        return MissionPlan(
            id=mission.id,
            mode=mission.mode,
            target=mission.target,
            altitude_m=mission.altitude_m.value,
            standoff_m=standoff,
            offset_m=offset_m,
            capture_horizontal_m=horizontal,
            capture_altitude_m=self._limits.tracking_altitude_m if track else slack,
            ascent_tolerance_m=slack,
            hover_point=hover_point,
            duration_s=mission.duration_s.value,
        )

    def _hover(
        self,
        mission: UavMission,
        centre: tuple[float, float, float, float],
        targets: FloatArray,
        others: Sequence[Point3],
    ) -> PlannedFlight | Rejected:
        reason = 'clearance'
        for offset in self._places(mission, centre, others):
            point = (centre[0] + offset[0], centre[1] + offset[1], mission.altitude_m.value)
            if not self._apart(point, others):
                reason = 'separation'
                continue
            clearance = self._air.points_clearance_m(np.array([point]))
            if clearance < self._settings.clearance_m:
                continue
            observers = np.repeat(np.array([point]), len(targets), axis=0)
            seen = self._air.seen_share(observers, targets, self._range)
            if mission.target is not None and seen < self._tolerances.visible_fraction:
                reason = 'sight'
                continue
            return PlannedFlight(
                plan=self._hold_plan(mission, hover_point=point),
                clearance_m=clearance,
                seen=seen,
                over_street=0.0,
            )
        return Rejected(reason=reason)

    def _watched(
        self,
        spec: ScenarioSpec,
        mission: UavMission,
        site: Site,
        centre: tuple[float, float, float, float],
        speed_mps: float,
    ) -> FloatArray:
        """Return the points (K, 3) at which the target of a hover will be, its sight point."""
        seat = site.seat(mission.target or '')
        if seat is None:
            return np.array([[centre[0], centre[1], _SIGHT_HEIGHT_PLACE_M]])
        height_m = self._types[seat.member.agent.type.value].height_m / 2.0
        assert mission.duration_s is not None
        way_m = speed_mps * mission.duration_s.value if moves(spec, seat.member.agent) else 0.0
        samples = samples_along(seat.path, seat.arc_m, way_m, self._settings.sample_spacing_m)
        return np.column_stack((samples[:, :2], np.full(len(samples), height_m)))

    def _navigate(
        self, mission: UavMission, centre: tuple[float, float, float, float]
    ) -> PlannedFlight | Rejected:
        assert mission.pattern is not None
        assert mission.speed_mps is not None
        length, width = (p.value for p in mission.size_m) if mission.size_m else (100.0, 60.0)
        points = pattern_points(
            mission.pattern,
            length_m=length,
            width_m=width,
            radius_m=30.0 if mission.radius_m is None else mission.radius_m.value,
            waypoint_count=4
            if mission.waypoint_count is None
            else round(mission.waypoint_count.value),
        )
        if points is None or mission.speed_mps.value <= 0.0:
            return Rejected(reason='pattern')
        hx, hy = centre[2], centre[3]
        shifts = self._settings.pattern_shifts_m
        best: PlannedFlight | None = None
        headings = ((hx, hy), (-hy, hx)) if mission.pattern is not Pattern.ORBIT else ((hx, hy),)
        for heading in headings:
            for along in shifts if mission.over_streets else (0.0,):
                middle = (centre[0] + along * hx, centre[1] + along * hy)
                placed = place_pattern(points, middle, heading)
                way = tuple((x, y, mission.altitude_m.value) for x, y in placed)
                clearance = self._air.way_clearance_m(way)
                if clearance < self._settings.clearance_m:
                    continue
                over = self._over_street(placed)
                if mission.over_a_road and over < self._leg_share:
                    continue
                if best is None or over > best.over_street:
                    plan = MissionPlan(
                        id=mission.id,
                        mode=mission.mode,
                        target=mission.target,
                        altitude_m=mission.altitude_m.value,
                        capture_altitude_m=self._altitude_slack(mission),
                        ascent_tolerance_m=self._altitude_slack(mission),
                        waypoints=way,
                        speed_mps=mission.speed_mps.value,
                    )
                    best = PlannedFlight(
                        plan=plan, clearance_m=clearance, seen=1.0, over_street=over
                    )
        return best if best is not None else Rejected(reason='clearance')

    def _over_street(self, placed: tuple[tuple[float, float], ...]) -> float:
        legs = [shapely.LineString([a, b]) for a, b in itertools.pairwise(placed)]
        # Numbers that are tiny beside the map's coordinates give legs without a length.
        return max(
            (
                float(leg.intersection(self._carriageway).length) / float(leg.length)
                for leg in legs
                if leg.length > 0.0
            ),
            default=0.0,
        )

    def _centre(self, mission: UavMission, site: Site) -> tuple[float, float, float, float] | None:
        target = mission.target
        x, y, hx, hy = site.origin()
        if target is None:
            return x, y, hx, hy
        seat = site.seat(target)
        if seat is not None:
            return seat.path.position_at(seat.arc_m)
        if target.startswith('landmark:'):
            mark_x, mark_y = landmark_point(self._map, target.removeprefix('landmark:'))
            return mark_x, mark_y, 1.0, 0.0
        if target == 'intersection':
            near_x, near_y = intersection_point(self._map, (x, y))
            return near_x, near_y, hx, hy
        if target in ROADS:
            samples = samples_along(
                site.origin_path, site.origin_arc_m, ROAD_WAY_M, ROAD_STEP_M
            ).tolist()
            seats = [s.path.position_at(s.arc_m)[:2] for s in site.seated]
            road_x, road_y = road_point([(p[0], p[1]) for p in samples], seats)
            return road_x, road_y, hx, hy
        return None

    def _landing_areas(self, plan: MissionPlan, site: Site) -> list[tuple[float, float]]:
        if plan.mode is MissionMode.TRACK:
            seat = site.seat(plan.target or '')
            assert seat is not None
            way = samples_along(seat.path, seat.arc_m, 900.0, 60.0)
            return [(float(p[0]), float(p[1])) for p in way]
        x, y, _ = _last_point(plan)
        return [(x, y)]


def _distance(a: Point3, b: Point3) -> float:
    return norm2(norm2(a[0] - b[0], a[1] - b[1]), a[2] - b[2])


def _last_point(plan: MissionPlan) -> Point3:
    last = plan.waypoints[-1] if plan.waypoints else plan.hover_point
    assert last is not None
    return last


def _first_point(plan: MissionPlan, site: Site) -> Point3:
    if plan.mode is MissionMode.TRACK:
        seat = site.seat(plan.target or '')
        assert seat is not None
        x, y, _, _ = seat.path.position_at(seat.arc_m)
        return x + plan.offset_m[0], y + plan.offset_m[1], plan.altitude_m
    if plan.hover_point is not None:
        return plan.hover_point
    return plan.waypoints[0]
