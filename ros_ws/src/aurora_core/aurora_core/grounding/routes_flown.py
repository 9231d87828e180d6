# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Plan the routes of UAVs: patterns round a point, clear of what stands there."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace
from math import cos, inf, pi, sin

import numpy as np
import shapely

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.come_upon import before_sight, is_seen_last, lap_points
from aurora_core.grounding.laps import REPEATED, Laps
from aurora_core.grounding.neighbours import NOBODY, Neighbours
from aurora_core.grounding.patterns import begun_at, centred, pattern_points, place_pattern
from aurora_core.grounding.planned_flight import (
    PlannedFlight,
    Rejected,
    altitude_slack_m,
    ascent_tolerance_m,
    planned_height_m,
)
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson
from aurora_core.knowledge.limits import (
    Limits,
    Tolerances,
    pattern_off_m,
)
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import GroundingSettings
from aurora_core.mission.orbits import part_of_lap_deg
from aurora_core.mission.plan import MissionPlan
from aurora_core.quantities.waypoints import orbit_radius_m
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.vocabulary import Pattern

Point2 = tuple[float, float]
Point3 = tuple[float, float, float]
Pose = tuple[float, float, float, float]

# Planned share of a leg over a carriageway, beyond what the condition asks.
SPARE_SHARE = 0.05

# Radii of an orbit round a building whose radius nobody states, times the usual one.
_WIDER = (1.5, 2.0, 3.0, 4.0)

# Patterns that end where they begin may begin anywhere on them: at so many of their shares.
_CLOSED = (Pattern.ORBIT, Pattern.RECTANGLE)
_BEGINNINGS = 12
# A pattern that begins where its UAV is is tried in so many directions.
_DIRECTIONS = 16
# Beside others so many places are tried, half their distance apart, and the centre stays so much
# inside its tolerance (m).
_BESIDE = 24
_INSIDE_M = 1.0
# Round a landmark that has no room for a pattern just there, the centre moves by such shares.
_MOVED = (0.35, 0.7, 1.0)
# And so far along the street, for those that are to be over it (m).
_FARTHER_M = tuple(50.0 * k for k in range(1, 13))

# The ends of a way beside another one are so much inside the tolerance of their places (m).
_ENDS_OFF_M = 1.5

# Radius of an orbit and of a ring of waypoints (m).
_RADIUS_M = 30.0
# How far a UAV flies at its speed at least on a leg (m).
_CRUISE_M = 30.0


class RoutePlanner:
    """Plans routes over one map.

    Args:
        map_model: Map.
        airspace: Its buildings and zones.
        limits: Limits in force.
        tolerances: Tolerances in force.
        settings: Search settings.
        laps: Plans how often a route is flown.
    """

    def __init__(
        self,
        *,
        map_model: MapModel,
        airspace: Airspace,
        limits: Limits,
        tolerances: Tolerances,
        settings: GroundingSettings,
        laps: Laps,
    ) -> None:
        self._air = airspace
        self._limits = limits
        self._tolerances = tolerances
        self._settings = settings
        self._laps = laps
        self._found_moved: dict[tuple[str, Pose], tuple[PlannedFlight | Rejected, Pose]] = {}
        self._leg_share = min(1.0, tolerances.over_carriageway_share + SPARE_SHARE)
        self._carriageway = map_model.network.carriageway
        shapely.prepare(self._carriageway)

    def plan(
        self,
        mission: UavMission,
        centre: Pose,
        others: Neighbours = NOBODY,
        *,
        beside: bool = False,
    ) -> PlannedFlight | Rejected:
        """Return the plan of a route that keeps off the other UAVs where there is one.

        Args:
            mission: What to fly.
            centre: Of its pattern (x, y in m, ENU), and the direction of its first leg (unit).
            others: Where other UAVs are.
            beside: The centre is in a building: an orbit is as wide as it has to be.
        """
        best = self._wide_enough(mission, centre, 0.0, beside=beside)
        if isinstance(best, Rejected) and _is_all_stated(mission):
            best, centre = self._moved(mission, centre, best)
        if isinstance(best, Rejected):
            return best
        gap_m = others.gap_m(best.plan)
        # Where nothing is far enough, the farthest: how near they come is for the run to show.
        for middle, turned in self._elsewhere(mission, centre, others):
            if gap_m >= others.apart_m:
                break
            found = self._wide_enough(mission, middle, turned, beside=beside)
            if not isinstance(found, Rejected) and others.gap_m(found.plan) > gap_m:
                best, gap_m = found, others.gap_m(found.plan)
        return best

    def onward(
        self, mission: UavMission, here: Pose, others: Neighbours = NOBODY
    ) -> PlannedFlight | Rejected:
        """Return the plan of a pattern that begins where its UAV is, in whichever direction.

        Args:
            mission: What to fly.
            here: Where it is (x, y in m, ENU), and the direction that is tried first (unit).
            others: Where other UAVs are.
        """
        x, y, hx, hy = here
        points = self._points(mission)
        if points is None:
            return Rejected(reason='pattern')
        for k in range(_DIRECTIONS):
            cosine, sine = cos(2.0 * pi * k / _DIRECTIONS), sin(2.0 * pi * k / _DIRECTIONS)
            heading = hx * cosine - hy * sine, hx * sine + hy * cosine
            off_x, off_y = _placed(mission, points, (0.0, 0.0), heading)[0]
            found = self._around(mission, (x - off_x, y - off_y, *heading), 0.0, crosswise=False)
            if not isinstance(found, Rejected) and others.gap_m(found.plan) >= others.apart_m:
                return found
        return Rejected(reason='clearance')

    def _moved(
        self, mission: UavMission, centre: Pose, rejected: Rejected
    ) -> tuple[PlannedFlight | Rejected, Pose]:
        """Plan a pattern about the nearest centre that still counts as over its landmark.

        A landmark stands where it stands: what was found for one site is so for all.
        """
        key = (mission.id, centre)
        if key not in self._found_moved:
            x, y, hx, hy = centre
            most_m = pattern_off_m(mission, self._tolerances) - _INSIDE_M
            found: tuple[PlannedFlight | Rejected, Pose] = rejected, centre
            for share, k in itertools.product(_MOVED, range(_BEGINNINGS)):
                angle, away_m = 2.0 * pi * k / _BEGINNINGS, share * most_m
                middle = x + away_m * cos(angle), y + away_m * sin(angle), hx, hy
                planned = self._around(mission, middle, 0.0)
                if not isinstance(planned, Rejected):
                    found = planned, middle
                    break
            self._found_moved[key] = found
        return self._found_moved[key]

    def _elsewhere(
        self, mission: UavMission, centre: Pose, others: Neighbours
    ) -> Iterator[tuple[Pose, float]]:
        """Yield other centres of a pattern, and at which share of it its flight begins.

        Round something it stays there, so that one begins elsewhere; nowhere in particular it has
        room beside the others.
        """
        x, y, hx, hy = centre
        shares = (k / _BEGINNINGS for k in range(1, _BEGINNINGS))
        turned = [share for share in shares if mission.pattern in _CLOSED]
        # Half round first: that is the farthest from one who began at the usual point.
        turned.sort(key=lambda share: (abs(share - 0.5), share))
        if mission.target is not None:
            yield from ((centre, share) for share in turned)
        most_m = inf
        if mission.target is not None:
            most_m = pattern_off_m(mission, self._tolerances) - _INSIDE_M
        for k in range(1, _BESIDE + 1):
            for aside_m in (k * others.apart_m / 2.0, -k * others.apart_m / 2.0):
                if abs(aside_m) <= most_m:
                    yield (x - aside_m * hy, y + aside_m * hx, hx, hy), 0.0
        if mission.target is None:
            yield from ((centre, share) for share in turned)
            for away_m in _FARTHER_M:
                for along_m in (away_m, -away_m):
                    yield (x + along_m * hx, y + along_m * hy, hx, hy), 0.0

    def coming_upon(
        self, mission: UavMission, seat: SeatedAgent | SeatedPerson, body_m: float, range_m: float
    ) -> PlannedFlight | Rejected:
        """Plan a route from whose far end somebody is seen who stands, and not before.

        Args:
            mission: The route.
            seat: Where he stands.
            body_m: How high above the ground he is looked for.
            range_m: Of sight.
        """
        height_m = planned_height_m(mission, self._limits, self._tolerances)
        where = before_sight(mission, seat, range_m, height_m)
        if where is None:
            return Rejected(reason='sight')
        found = self._around(mission, *where, crosswise=False)
        if isinstance(found, Rejected):
            return found
        points = lap_points(found.plan)
        target = np.array([[*seat.path.position_at(seat.arc_m)[:2], body_m]])
        seen = self._air.seen(points, np.repeat(target, len(points), axis=0), range_m)
        shows = is_seen_last(mission, seen)
        return found if shows else Rejected(reason='sight')

    def _wide_enough(
        self,
        mission: UavMission,
        centre: Pose,
        turned: float,
        *,
        beside: bool,
    ) -> PlannedFlight | Rejected:
        """Plan a pattern, an orbit round a building as wide as it has to be."""
        radius = mission.radius_m
        plain = self._around(mission, centre, turned)
        if not beside or mission.pattern is not Pattern.ORBIT or not isinstance(plain, Rejected):
            return plain
        if radius is None or radius.provenance is Provenance.EXPLICIT:
            return plain
        for factor in _WIDER:
            wider = radius.model_copy(update={'value': factor * radius.value})
            asked = mission.model_copy(update={'radius_m': wider})
            found = self._around(asked, centre, turned)
            if not isinstance(found, Rejected):
                return found
        return plain

    def least_way_m(self, plan: MissionPlan) -> float:
        """Return how long the way to a mission has to be to show its speed, 0 for any."""
        if plan.way_mps is None:
            return 0.0
        return _shown_m(plan.way_mps, self._tolerances.route_acceleration_mps2)

    def between(
        self,
        mission: UavMission,
        start: tuple[float, float],
        end: tuple[float, float],
        others: Neighbours = NOBODY,
    ) -> PlannedFlight | Rejected:
        """Return the plan of the way from one place to another (x, y in m), round obstacles.

        Where another UAV flies the same way it is beside that: both ends still count as there.
        """
        best = self._between(mission, start, end)
        if isinstance(best, Rejected):
            return best
        gap_m = others.gap_m(best.plan)
        aside_m = self._tolerances.pattern_centre_m - _ENDS_OFF_M
        way_x, way_y = end[0] - start[0], end[1] - start[1]
        way_m = norm2(way_x, way_y)
        for off_m in (aside_m, -aside_m):
            if gap_m >= aside_m or way_m <= 0.0:
                break
            x, y = -off_m * way_y / way_m, off_m * way_x / way_m
            found = self._between(mission, (start[0] + x, start[1] + y), (end[0] + x, end[1] + y))
            if not isinstance(found, Rejected) and others.gap_m(found.plan) > gap_m:
                best, gap_m = found, others.gap_m(found.plan)
        return best

    def _between(
        self, mission: UavMission, start: tuple[float, float], end: tuple[float, float]
    ) -> PlannedFlight | Rejected:
        height_m = planned_height_m(mission, self._limits, self._tolerances)
        level = self._air.level_way(start, end, height_m, self._settings.clearance_m)
        if level is None:
            return Rejected(reason='clearance')
        way = tuple((x, y, height_m) for x, y in level)
        clearance = self._air.way_clearance_m(way)
        if clearance < self._settings.clearance_m:
            return Rejected(reason='clearance')
        over = self._over_street(level)
        if mission.over_a_road and over < self._leg_share:
            return Rejected(reason='clearance')
        plan = self._plan(mission, way)
        return PlannedFlight(plan=plan, clearance_m=clearance, seen=1.0, over_street=over)

    def _around(
        self, mission: UavMission, centre: Pose, turned: float, *, crosswise: bool = True
    ) -> PlannedFlight | Rejected:
        """Plan a pattern round a point, begun at a share of it, along a street or across it."""
        points = self._points(mission)
        if points is None:
            return Rejected(reason='pattern')
        points = begun_at(points, turned) if turned else points
        hx, hy = centre[2], centre[3]
        shifts = self._settings.pattern_shifts_m
        height_m = planned_height_m(mission, self._limits, self._tolerances)
        best: PlannedFlight | None = None
        crosswise = crosswise and mission.pattern is not Pattern.ORBIT
        headings = ((hx, hy), (-hy, hx)) if crosswise else ((hx, hy),)
        for heading in headings:
            for along in shifts if mission.over_streets else (0.0,):
                middle = (centre[0] + along * hx, centre[1] + along * hy)
                placed = _placed(mission, points, middle, heading)
                if self._air.bars_level(placed, height_m, self._settings.clearance_m):
                    continue
                way = tuple((x, y, height_m) for x, y in placed)
                clearance = self._air.way_clearance_m(way)
                if clearance < self._settings.clearance_m:
                    continue
                over = self._over_street(placed)
                if mission.over_a_road and over < self._leg_share:
                    continue
                if best is None or over > best.over_street:
                    plan = self._plan(mission, way)
                    best = PlannedFlight(
                        plan=plan, clearance_m=clearance, seen=1.0, over_street=over
                    )
        if best is None:
            return Rejected(reason='clearance')
        return replace(best, plan=self._lasting(mission, best.plan))

    def _points(self, mission: UavMission) -> tuple[Point2, ...] | None:
        """Return the points of a pattern about (0, 0), None where it is none that can be flown."""
        assert mission.pattern is not None
        assert mission.speed_mps is not None
        if mission.speed_mps.value <= 0.0:
            return None
        count = 4 if mission.waypoint_count is None else round(mission.waypoint_count.value)
        length, width = (p.value for p in mission.size_m) if mission.size_m else (100.0, 60.0)
        return pattern_points(
            mission.pattern,
            length_m=length,
            width_m=width,
            radius_m=_radius_m(mission, count, self._tolerances.route_acceleration_mps2),
            waypoint_count=count,
        )

    def _plan(self, mission: UavMission, way: tuple[Point3, ...]) -> MissionPlan:
        speed = mission.speed_mps
        assert speed is not None
        # The way to a single point is all that shows a stated speed.
        shows = len(way) == 1 and speed.provenance is Provenance.EXPLICIT
        return MissionPlan(
            id=mission.id,
            mode=mission.mode,
            target=mission.target,
            altitude_m=planned_height_m(mission, self._limits, self._tolerances),
            capture_horizontal_m=self._tolerances.waypoint_horizontal_m,
            capture_altitude_m=altitude_slack_m(mission, self._tolerances),
            ascent_tolerance_m=ascent_tolerance_m(mission, self._limits, self._tolerances),
            waypoints=way,
            speed_mps=speed.value,
            way_mps=speed.value if shows else None,
            level_way=mission.has_a_level_way,
        )

    def _lasting(self, mission: UavMission, plan: MissionPlan) -> MissionPlan:
        """Return a plan whose route is flown as often, or for as long, as the request states."""
        asked, speed = mission.duration_s, mission.speed_mps
        states_time = asked is not None and asked.provenance is Provenance.EXPLICIT
        asked_s = asked.value if asked is not None and states_time else None
        if speed is None or (asked_s is None and mission.turns is None):
            return plan
        update: dict[str, object] = {} if asked_s is None else {'duration_s': asked_s}
        keeps_speed = speed.provenance is Provenance.EXPLICIT
        if mission.turns is not None:
            turns = mission.turns.inside(self._tolerances.orbit_deg / 360.0)
            way, speed_mps = self._laps.turned(
                plan.waypoints, max(1.0, turns), plan.speed_mps, asked_s, keeps_speed=keeps_speed
            )
            update |= {'waypoints': way, 'speed_mps': speed_mps}
        elif asked_s is not None and self._is_part(mission, plan):
            update['waypoints'] = self._laps.part(plan.waypoints, plan.speed_mps, asked_s)
        elif mission.pattern in REPEATED and asked_s is not None:
            way, speed_mps = self._laps.lasting(
                plan.waypoints, plan.speed_mps, asked_s, keeps_speed=keeps_speed
            )
            update |= {'waypoints': way, 'speed_mps': speed_mps}
        return plan.model_copy(update=update)

    def _is_part(self, mission: UavMission, plan: MissionPlan) -> bool:
        """Tell whether there is no time for a whole orbit."""
        if mission.pattern is not Pattern.ORBIT:
            return False
        radius_m = orbit_radius_m(plan.waypoints)
        return part_of_lap_deg(mission, radius_m, self._limits, self._tolerances) is not None

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


def _placed(
    mission: UavMission, points: tuple[Point2, ...], middle: Point2, heading: Point2
) -> tuple[Point2, ...]:
    """Return the points of a pattern about a place, turned to a heading (unit vector)."""
    placed = place_pattern(points, middle, heading)
    # The circle through an odd number of points is not about their middle.
    if mission.pattern is Pattern.WAYPOINTS and len(placed) % 2 and len(placed) > 1:
        placed = centred(placed, middle)
    return placed


def _is_all_stated(mission: UavMission) -> bool:
    """Tell whether a pattern at a landmark can be no wider and no higher than it is."""
    sizes = (mission.radius_m,) if mission.size_m is None else mission.size_m
    numbers = (mission.altitude_m, *sizes)
    stated = all(n is not None and n.provenance is Provenance.EXPLICIT for n in numbers)
    return stated and is_landmark(mission.target)


def _radius_m(mission: UavMission, count: int, acceleration_mps2: float) -> float:
    """Return the radius of an orbit or of a ring of waypoints: stated, else wide enough.

    A stated speed has to show on the legs.
    """
    radius, speed = mission.radius_m, mission.speed_mps
    radius_m = _RADIUS_M if radius is None else radius.value
    said = radius is not None and radius.provenance is Provenance.EXPLICIT
    if said or mission.pattern is not Pattern.WAYPOINTS or speed is None or count < 2:
        return radius_m
    if speed.provenance is not Provenance.EXPLICIT:
        return radius_m
    leg_m = _shown_m(speed.value, acceleration_mps2)
    return max(radius_m, leg_m / (2.0 * sin(pi / count)))


def _shown_m(speed_mps: float, acceleration_mps2: float) -> float:
    """Return how long a leg is that shows a speed: longer than to get to it and to brake."""
    return speed_mps * speed_mps / acceleration_mps2 + _CRUISE_M
