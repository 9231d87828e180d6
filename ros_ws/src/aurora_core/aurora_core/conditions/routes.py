# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by routes: waypoints, closing, streets below, centre, speed, size."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from aurora_core.errors import VerificationError
from aurora_core.geometry.kernel import norm2
from aurora_core.judging.build import Inputs, Source, Underivable, number
from aurora_core.judging.quantities import (
    angle_swept,
    horizontal_distance,
    over_carriageway,
    pattern_centre,
    pattern_extent,
    route_closed,
    route_speed,
    waypoints_visited,
)
from aurora_core.knowledge.limits import pattern_off_m
from aurora_core.mission.orbits import part_of_lap_deg
from aurora_core.outcomes.condition import Condition, MissionArguments, Point3
from aurora_core.quantities.waypoints import arc_centre, extent, has_shape, orbit_radius_m
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.vocabulary import Pattern

# Patterns with a length and a width.
_SIZED = frozenset({Pattern.RECTANGLE, Pattern.LINE, Pattern.LAWNMOWER})

# Legs of a pattern whose size is stated keep that size to this.
SIZE_GUARD_M = 1e-3


def route_conditions(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition | Underivable]:
    """Yield the conditions of a navigate mission.

    Raises:
        VerificationError: The plan has another pattern than the request, or resized it.
    """
    part_deg = None
    if mission.pattern is Pattern.ORBIT and arc_centre(arguments.waypoints) is not None:
        radius_m = orbit_radius_m(arguments.waypoints)
        part_deg = part_of_lap_deg(mission, radius_m, inputs.limits, inputs.tolerances)
    _check_shape(mission, arguments, in_part=part_deg is not None)
    _check_size(mission, arguments)
    points = arguments.waypoints
    yield waypoints_visited.all_points(inputs, arguments, source)
    if len(points) > 1 and points[0] == points[-1] and arguments.left_by is None:
        yield route_closed.implied(inputs, arguments, source)
    if mission.pattern is Pattern.ORBIT:
        lasts = mission.duration_s is not None or arguments.left_by is not None
        if part_deg is None:
            yield angle_swept.implied(inputs, arguments, mission.turns, source, again=lasts)
        else:
            yield angle_swept.in_part(inputs, arguments, part_deg, source)
    count = mission.waypoint_count
    if count is not None and count.provenance is Provenance.EXPLICIT:
        yield waypoints_visited.stated_count(inputs, arguments, count, source)
    if mission.over_a_road:
        yield over_carriageway.implied(inputs, arguments, source)
    if mission.start is not None and mission.target is not None:
        yield pattern_centre.of_end(inputs, arguments, 'first', mission.start, source)
        yield pattern_centre.of_end(inputs, arguments, 'last', mission.target, source)
    elif mission.target is not None:
        limit_m = pattern_off_m(mission, inputs.tolerances)
        yield pattern_centre.implied(inputs, arguments, mission.target, source, limit_m)
    speed = mission.speed_mps
    if speed is not None and speed.provenance is Provenance.EXPLICIT:
        yield route_speed.implied(inputs, arguments, speed, source)
    radius = mission.radius_m
    if radius is not None and radius.provenance is Provenance.EXPLICIT:
        yield horizontal_distance.of_orbit(inputs, arguments, radius, source)
    yield from _extents(inputs, mission, arguments, source)


def _extents(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition | Underivable]:
    """Yield that the flown pattern is as long and as wide as the prompt states."""
    if mission.size_m is None or mission.pattern not in _SIZED:
        return
    width = mission.size_m[1]
    if mission.pattern is Pattern.LINE and width.value > 0.0:
        yield Underivable(element=mission.id, what='width of a line', span=width.span)
        return
    axes = _axes(mission.size_m, arguments.waypoints)
    for side, size, axis in zip(('length', 'width'), mission.size_m, axes, strict=True):
        if size.provenance is Provenance.EXPLICIT and size.value != 0.0:
            yield pattern_extent.implied(inputs, arguments, side, size, axis, source)


def _axes(
    size: tuple[Parameter, Parameter], points: tuple[Point3, ...]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the directions of length and width: the first leg's, and across it."""
    dx, dy = points[1][0] - points[0][0], points[1][1] - points[0][1]
    way = norm2(dx, dy)
    along = (dx / way, dy / way) if way > 0.0 else (1.0, 0.0)
    across = (-along[1], along[0])
    seen = [abs(extent(points, axis) - size[0].value) for axis in (along, across)]
    return (along, across) if seen[0] <= seen[1] else (across, along)


def _check_shape(mission: UavMission, arguments: MissionArguments, *, in_part: bool) -> None:
    """Refuse a plan of another pattern: that its points are visited would then say nothing."""
    points = arguments.waypoints
    if mission.pattern is None or has_shape(mission.pattern, points, in_part=in_part):
        return
    raise VerificationError(
        f'mission {mission.id} asks for the pattern {mission.pattern.value}, the plan has '
        f'{len(points)} points of another shape',
        hint='grounding must plan the pattern that is asked for',
    )


def _check_size(mission: UavMission, arguments: MissionArguments) -> None:
    """Refuse a route that is not of the stated size: explicit sizes are never changed."""
    radius = mission.radius_m
    if mission.pattern is Pattern.ORBIT and radius is not None:
        planned_m, exact = orbit_radius_m(arguments.waypoints), radius.bound is Bound.EXACTLY
        stated = exact and radius.provenance is Provenance.EXPLICIT
        if stated and abs(planned_m - radius.value) > SIZE_GUARD_M:
            raise VerificationError(
                f'mission {mission.id} asks for a radius of {radius.value} m, the plan has an '
                f'orbit of {number(planned_m)} m',
                hint='grounding must not resize an explicit pattern',
            )
    if mission.size_m is None or mission.pattern not in (Pattern.RECTANGLE, Pattern.LINE):
        return
    legs = [norm2(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(arguments.waypoints)]
    sides = mission.size_m[:1] if mission.pattern is Pattern.LINE else mission.size_m
    for parameter in sides:
        if parameter.provenance is not Provenance.EXPLICIT or parameter.value == 0.0:
            continue
        if all(abs(leg - parameter.value) > SIZE_GUARD_M for leg in legs):
            raise VerificationError(
                f'mission {mission.id} asks for a side of {parameter.value} m, the plan has legs '
                f'of {", ".join(number(leg) for leg in legs)} m',
                hint='grounding must not resize an explicit pattern',
            )
