# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Plan the flights of a site: offsets, patterns and hover points that are clear and can see."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import cos, pi, sin

import numpy as np
import numpy.typing as npt

from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.apart import sharing
from aurora_core.grounding.beside import turned_along, with_turns
from aurora_core.grounding.centre import centre_of
from aurora_core.grounding.come_upon import come_upon
from aurora_core.grounding.crossings import crossed
from aurora_core.grounding.laps import Laps
from aurora_core.grounding.neighbours import NOBODY, Neighbours
from aurora_core.grounding.offsets import Spread, from_afar, is_lost, loses_sight, offsets
from aurora_core.grounding.onward import onward_from
from aurora_core.grounding.pace import watched_speed_mps
from aurora_core.grounding.places import MapPlaces
from aurora_core.grounding.planned_flight import (
    PlannedFlight,
    Rejected,
    altitude_slack_m,
    ascent_tolerance_m,
    first_point,
    inside_bound,
    landing_areas,
    planned_height_m,
)
from aurora_core.grounding.pulling_away import PullingAway, phase_s, pulling_away
from aurora_core.grounding.routes_flown import RoutePlanner
from aurora_core.grounding.sites import Site, samples_along
from aurora_core.grounding.spots import SpotFinder
from aurora_core.grounding.starts import Starts, uncrossed
from aurora_core.grounding.staying import staying
from aurora_core.grounding.watched import Watcher
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.spec.flight_order import stays_where_it_is
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.vocabulary import MissionMode

FloatArray = npt.NDArray[np.float64]
Point3 = tuple[float, float, float]

# Where sight is to be lost now and then, more of the phase than has to be is seen.
_SPARE = 0.08
# And on this share of its way.
_EARLY = 0.5

# A hover point stays so much inside the tolerance of its place (m).
_DRIFTS_M = 0.1
# One at the edge of that tolerance is inside it, whatever is rounded (m).
_ROUNDING_M = 5e-7

# Steps in which a flight looks for free air above (m).
_HIGHER_M = 10.0


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
        hover_capture_m: How near each UAV comes to its point before it hovers.
        apart_m: Distance of UAVs at one height.
        homes_m: Least distance of their starts, where the usual one does not do.
        laps: Plans how often a route is flown.
        leads_m: So far the first target of a UAV has gone when it is up, by UAV.
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
        hover_capture_m: Mapping[str, float],
        apart_m: float,
        homes_m: float,
        laps: Laps,
        leads_m: Mapping[str, float],
    ) -> None:
        self._air = airspace
        self._spots = spots
        self._leads_m = leads_m
        self._types = types
        self._limits = limits
        self._tolerances = tolerances
        self._settings = settings
        self._range = sensing_range_m
        self._hover_capture_m = hover_capture_m
        self._apart_m = apart_m
        self._starts = Starts(
            spots=spots,
            airspace=airspace,
            clearance_m=settings.clearance_m,
            apart_m=max(settings.home_spacing_m, homes_m),
            wide=homes_m > 0.0,
        )
        self._spread = Spread(apart_m=apart_m, strict=homes_m > 0.0, bearings=settings.bearings)
        self._routes = RoutePlanner(
            map_model=map_model,
            airspace=airspace,
            limits=limits,
            tolerances=tolerances,
            settings=settings,
            laps=laps,
        )
        # The same for every site that is tried.
        self._places = MapPlaces(map_model)

    def plan_mission(
        self,
        spec: ScenarioSpec,
        mission: UavMission,
        site: Site,
        speed_mps: float,
        others: Neighbours = NOBODY,
        before: Sequence[PlannedFlight] = (),
    ) -> PlannedFlight | Rejected:
        """Plan one mission at a site.

        Args:
            spec: The request.
            mission: What to plan.
            site: Where.
            speed_mps: Speed that the target will drive.
            others: Where other UAVs are.
            before: The missions before it of the same UAV, as planned.
        """
        mission = inside_bound(mission, self._limits, self._tolerances)
        if stays_where_it_is(spec, mission):
            plan = self._hold_plan(mission)
            return staying(spec, mission, plan, self._limits, self._tolerances)
        if mission.mode is MissionMode.TRACK:
            return self._track(spec, mission, site, speed_mps)
        free = mission.altitude_m.provenance is Provenance.DEFAULT and len(spec.uavs) == 1
        higher = tuple(self._higher(mission)) if free else ()
        here = onward_from(spec, mission, site, before, partial(self._target_mps, spec))
        for at in (mission, *higher):
            if here is None:
                break
            onward = self._routes.onward(at, here, others)
            if not isinstance(onward, Rejected):
                return onward
        found = self._at_place(spec, mission, site, speed_mps, others)
        if not isinstance(found, Rejected) or not is_landmark(mission.target):
            return found
        # A landmark stands where it stands: higher up is the way out that the request leaves open.
        for at in higher:
            above = self._at_place(spec, at, site, speed_mps, others)
            if not isinstance(above, Rejected):
                return above
        return found

    def _higher(self, mission: UavMission) -> Iterator[UavMission]:
        """Yield a mission with an open altitude higher and higher up, inside its domain."""
        top_m = min(mission.altitude_m.high, self._limits.uav_altitude_max_m)
        height_m = mission.altitude_m.value
        while (height_m := height_m + _HIGHER_M) <= top_m:
            altitude = mission.altitude_m.model_copy(update={'value': height_m})
            yield mission.model_copy(update={'altitude_m': altitude})

    def _at_place(
        self,
        spec: ScenarioSpec,
        mission: UavMission,
        site: Site,
        speed_mps: float,
        others: Neighbours,
    ) -> PlannedFlight | Rejected:
        """Plan a hover or a route over or round where its target is at t = 0."""
        stood = come_upon(spec, mission, site)
        if stood is not None:
            height_m = self._types[stood.agent.type.value].height_m / 2.0
            return self._routes.coming_upon(mission, stood, height_m, self._range)
        centre = centre_of(spec, mission, site, self._places, self._range)
        if centre is None:
            return Rejected(reason='target_place')
        if mission.start is not None:
            here = self._places.itself(mission.start, site.origin()[:2])
            return self._routes.between(mission, here, centre[:2], others)
        if mission.mode is MissionMode.NAVIGATE:
            beside = self._air.is_inside(*centre[:2])
            return self._routes.plan(mission, centre, others, beside=beside)
        watcher = Watcher(spec=spec, site=site, types=self._types, settings=self._settings)
        targets = watcher.target(mission, centre, speed_mps)
        found = self._hover(mission, centre, targets, others)
        if isinstance(found, Rejected) or found.plan.hover_point is None:
            return found
        # Who else is to be seen from there counts, too.
        for points, stays in watcher.others(mission, speed_mps):
            observers = np.repeat(np.array([found.plan.hover_point]), len(points), axis=0)
            seen = self._air.seen_share(observers, points, self._range)
            if stays and seen == 0.0:
                return Rejected(reason='sight')
            found = replace(found, seen=min(found.seen, seen))
        return found

    def plan_uav(
        self,
        uav_id: str,
        system_id: int,
        flights: list[PlannedFlight],
        site: Site,
        taken: list[tuple[float, float]],
        *,
        lands: bool = True,
    ) -> UavPlan | Rejected:
        """Choose the start of a UAV whose missions are planned; it could land there again.

        Args:
            uav_id: Which.
            system_id: Its number.
            flights: Its missions as planned, in their order.
            site: Where.
            taken: Starts of others (x, y in m).
            lands: After its missions.
        """
        ways = crossed(
            flights,
            site,
            self._air,
            clearance_m=self._settings.clearance_m,
            top_m=self._limits.uav_altitude_max_m,
            speed_mps=self._settings.target_speed_mps,
        )
        if ways is None:
            return Rejected(reason='way_between_missions')
        first = first_point(flights[0].plan, site, self._leads_m.get(uav_id, 0.0))
        seat = site.seat(flights[0].plan.target or '') if flights[0].plan.offset_turns else None
        home = self._starts.free(
            first,
            taken,
            way_m=self._routes.least_way_m(flights[0].plan),
            beside=None if seat is None else seat.path.position_at(seat.arc_m)[:2],
        )
        if home is None:
            from_above = self._starts.over(first, taken, self._limits.uav_altitude_max_m)
            if from_above is None or ways[0].plan.mode is MissionMode.TRACK:
                return Rejected(reason='start_spot')
            home, over_m = from_above
            begun = ways[0].plan.model_copy(update={'over_m': over_m})
            ways = (replace(ways[0], plan=begun), *ways[1:])
        highest = max(f.plan.altitude_m for f in flights)
        over_all = self._air.highest_m + 2.0 * self._settings.clearance_m
        return UavPlan(
            id=uav_id,
            system_id=system_id,
            home_x_m=home[0],
            home_y_m=home[1],
            landing_spots=(home,),
            missions=tuple(f.plan for f in ways),
            safe_altitude_m=min(self._limits.uav_altitude_max_m, max(highest, over_all)),
            lands=lands,
        )

    def uncrossed(self, plans: Sequence[UavPlan], site: Site) -> tuple[UavPlan, ...]:
        """Exchange starts so that UAVs at one height do not meet on their first ways."""
        return uncrossed(
            plans,
            [first_point(p.missions[0], site) for p in plans],
            self._air,
            apart_m=self._apart_m,
            clearance_m=self._settings.clearance_m,
        )

    def with_landing_spots(self, plan: UavPlan, site: Site) -> UavPlan:
        """Add the free spots along everything that the UAV flies over."""
        spots = list(plan.landing_spots)
        for x, y in (area for m in plan.missions for area in landing_areas(m, site)):
            spots += [s for s in self._spots.near(x, y) if s not in spots]
        return UavPlan.model_validate({**plan.model_dump(), 'landing_spots': tuple(spots)})

    def _target_mps(self, spec: ScenarioSpec, mission: UavMission) -> float:
        return watched_speed_mps(spec, mission, self._limits, self._settings)

    def _track(
        self, spec: ScenarioSpec, mission: UavMission, site: Site, speed_mps: float
    ) -> PlannedFlight | Rejected:
        seat = site.seat(mission.target or '')
        if seat is None:
            return Rejected(reason='target_not_in_convoy')
        assert mission.standoff_m is not None
        assert mission.duration_s is not None
        record = self._types[seat.agent.type.value]
        speed_mps = min(speed_mps, record.desired_speed_mps or record.max_speed_mps)
        way_m = speed_mps * (mission.duration_s.value + 6.0)
        samples = samples_along(seat.path, seat.arc_m, way_m, self._settings.sample_spacing_m)
        samples = samples if mission.side is None else with_turns(samples)
        targets = _at_height(samples[:, :2], record.height_m / 2.0)
        share = self._share(spec, mission)
        if loses_sight(spec, mission):
            for asked in from_afar(mission, self._limits.uav_standoff_max_m):
                found = self._watching(asked, samples, targets, share, gets_lost=True)
                if found is not None and found.seen >= self._tolerances.visible_fraction + _SPARE:
                    return found
            return Rejected(reason='sight')
        known = (self._limits, self._tolerances)
        fast = pulling_away(spec, mission, samples[0], *known, self._settings)
        if fast is not None and self._leads_m.get(mission.uav, 0.0) == 0.0:
            fast = fast.from_rest(record.accel_mps2)
        fast = fast if share[1] == 1 else None
        best = self._watching(mission, samples, targets, share, fast=fast)
        if best is None:
            return Rejected(reason='clearance')
        if best.seen < self._tolerances.visible_fraction:
            return Rejected(reason='sight')
        if fast is None:
            return best
        lasts_s = phase_s(spec, mission, fast.kept_s(best.plan.offset_m), self._tolerances)
        return replace(best, plan=best.plan.model_copy(update={'duration_s': lasts_s}))

    def _watching(
        self,
        mission: UavMission,
        samples: FloatArray,
        targets: FloatArray,
        share: tuple[int, int],
        *,
        gets_lost: bool = False,
        fast: PullingAway | None = None,
    ) -> PlannedFlight | None:
        """Return the flight that sees most of its target: for `gets_lost` not all along.

        Of a target that is too `fast` the one that stays near for longest.
        """
        best: PlannedFlight | None = None
        kept_s = 0.0
        ahead = () if fast is None else fast.offsets()
        for offset in (*ahead, *offsets(mission, samples[0], self._spread, share)):
            beside = samples[:, :2] + np.array(offset)
            if mission.side is not None:
                beside = turned_along(offset, samples)
            points = _at_height(beside, self._planned_height_m(mission))
            clearance = self._air.points_clearance_m(points)
            if clearance < self._settings.clearance_m:
                continue
            mask = self._air.seen(points, targets, self._range)
            # Held up by lights it comes no farther than a part of its way.
            if gets_lost and not is_lost(mask[: round(_EARLY * len(mask))]):
                continue
            seen = float(np.count_nonzero(mask)) / len(mask)
            stays_s = 0.0 if fast is None else fast.kept_s(offset)
            order = (round(stays_s, 1), round(seen, 3), clearance)
            if best is None or order > (round(kept_s, 1), round(best.seen, 3), best.clearance_m):
                plan, kept_s = self._hold_plan(mission, offset_m=offset), stays_s
                best = PlannedFlight(plan=plan, clearance_m=clearance, seen=seen, over_street=0.0)
        return best

    def _share(self, spec: ScenarioSpec, mission: UavMission) -> tuple[int, int]:
        """Return which one of how many UAVs this is that track one target at one height."""
        same = sharing(spec, mission, self._limits)
        uavs = list(dict.fromkeys(m.uav for m in same))
        return uavs.index(mission.uav), len(uavs)

    def _hover_places(
        self,
        mission: UavMission,
        centre: tuple[float, float, float, float],
        others: Neighbours,
    ) -> Iterator[tuple[float, float]]:
        """Yield the offsets of a hover point: beside the centre where somebody hovers over it."""
        own, count = others.share
        radius_m = 0.5 * others.apart_m / sin(pi / count) if count > 1 else 0.0
        if 0.0 < radius_m <= self._tolerances.pattern_centre_m - _DRIFTS_M:
            # All of them round it, for none is right over it then.
            angle = 2.0 * pi * own / count
            yield radius_m * cos(angle), radius_m * sin(angle)
        yield from offsets(mission, np.array(centre), self._spread)
        stands_off = mission.standoff_m is not None and mission.standoff_m.value > 0.0
        middle = (*centre[:2], self._planned_height_m(mission))
        if stands_off or others.leave(middle):
            return
        for ring in (1, 2):
            radius_m, count = ring * self._apart_m - _ROUNDING_M, 6 * ring
            for k in range(count):
                angle = 2.0 * pi * k / count
                yield radius_m * cos(angle), radius_m * sin(angle)

    def _is_out_of_reach(self, mission: UavMission, point: Point3) -> bool:
        """Tell whether no level way leads to a hover point, and it need not be just there.

        A height that is stated is come to from above, one that is not may be another.
        """
        if not self._air.is_inside(*point[:2]) or self._starts.lead_to(point):
            return False
        stated = mission.altitude_m.provenance is Provenance.EXPLICIT
        return not stated or self._starts.over(point, (), self._limits.uav_altitude_max_m) is None

    def _planned_height_m(self, mission: UavMission) -> float:
        return planned_height_m(mission, self._limits, self._tolerances)

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
            horizontal = self._hover_capture_m[mission.uav]
        elif mission.standoff_m is not None and (
            mission.standoff_m.provenance is Provenance.EXPLICIT
        ):
            horizontal = self._tolerances.standoff_m.of(
                standoff, approximate=mission.standoff_m.approximate
            )
        assert mission.duration_s is not None
        slack = altitude_slack_m(mission, self._tolerances)
        track = mission.mode is MissionMode.TRACK
        return MissionPlan(
            id=mission.id,
            mode=mission.mode,
            target=mission.target,
            altitude_m=self._planned_height_m(mission),
            standoff_m=standoff,
            offset_m=offset_m,
            offset_turns=mission.side is not None,
            capture_horizontal_m=horizontal,
            capture_altitude_m=self._limits.tracking_altitude_m if track else slack,
            ascent_tolerance_m=ascent_tolerance_m(mission, self._limits, self._tolerances),
            hover_point=hover_point,
            duration_s=mission.duration_s.value,
            level_way=mission.has_a_level_way,
        )

    def _hover(
        self,
        mission: UavMission,
        centre: tuple[float, float, float, float],
        targets: FloatArray,
        others: Neighbours,
    ) -> PlannedFlight | Rejected:
        reason, look = 'clearance', is_landmark(mission.target)
        air = self._air.looking_at(*centre[:2]) if look else self._air
        for offset in self._hover_places(mission, centre, others):
            point = (centre[0] + offset[0], centre[1] + offset[1], self._planned_height_m(mission))
            if not others.leave(point):
                reason = 'separation'
                continue
            clearance = self._air.points_clearance_m(np.array([point]))
            if clearance < self._settings.clearance_m or self._is_out_of_reach(mission, point):
                continue
            observers = np.repeat(np.array([point]), len(targets), axis=0)
            seen = air.seen_share(observers, targets, self._range)
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


def _at_height(points: FloatArray, height_m: float) -> FloatArray:
    """Return points (K, 3) of places (K, 2), all at one height."""
    return np.column_stack((points, np.full(len(points), height_m)))
