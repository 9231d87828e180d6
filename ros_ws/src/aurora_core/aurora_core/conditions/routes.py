# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by routes: waypoints, closing, streets below, centre, speed, size."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.errors import VerificationError
from aurora_core.geometry.kernel import norm2
from aurora_core.outcomes.condition import Condition, MissionArguments, Point3, Window
from aurora_core.quantities.waypoints import extent, has_shape
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import UavMission
from aurora_core.spec.vocabulary import Pattern

# Patterns with a length and a width.
_SIZED = frozenset({Pattern.RECTANGLE, Pattern.LINE, Pattern.LAWNMOWER})

# Legs of a pattern whose size is stated keep that size to this.
SIZE_GUARD_M = 1e-3


def route_conditions(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    """Yield the conditions of a navigate mission.

    Raises:
        VerificationError: The plan has another pattern than the request, or resized it.
    """
    _check_shape(mission, arguments)
    _check_size(mission, arguments)
    uav, points = mission.uav, arguments.waypoints
    closed = points[0] == points[-1]
    limit = inputs.tolerances.waypoint_horizontal_m
    yield condition(
        id=f'{mission.id}.waypoints',
        sentence=f'{uav} visits all {len(points)} points of its route in order',
        quantity=QuantityName.WAYPOINTS_VISITED,
        signal=f'waypoint_distance({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=limit, unit='m'),
        arguments=inputs.arguments(Window.PHASE, aspect='distance', mission=arguments),
        source=source,
    )
    if closed:
        yield condition(
            id=f'{mission.id}.closed',
            sentence=f'{uav} closes its route where it began',
            quantity=QuantityName.ROUTE_CLOSED,
            of=(uav,),
            target=Target(op='<=', threshold=limit, unit='m'),
            arguments=inputs.arguments(Window.PHASE, mission=arguments),
            source=source,
            every_sample=False,
        )
    count = mission.waypoint_count
    if count is not None and count.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{mission.id}.count',
            sentence=f'{uav} visits {number(count.value)} waypoints',
            quantity=QuantityName.WAYPOINTS_VISITED,
            of=(uav,),
            target=Target(op='>=', threshold=count.value, unit='1'),
            arguments=inputs.arguments(Window.PHASE, aspect='count', mission=arguments),
            source=stated_by(source, count),
            every_sample=False,
        )
    if mission.over_a_road:
        share = inputs.tolerances.over_carriageway_share
        yield condition(
            id=f'{mission.id}.over_streets',
            sentence=(
                f'{uav} flies at least one leg over a carriageway '
                f'({number(100 * share)} % of the leg)'
            ),
            quantity=QuantityName.OVER_CARRIAGEWAY,
            of=(uav,),
            target=Target(op='>=', threshold=share, unit='1'),
            fraction=share,
            arguments=inputs.arguments(Window.PHASE, mission=arguments),
            source=source,
            every_sample=False,
        )
    if mission.target is not None:
        limit = inputs.tolerances.pattern_centre_m
        yield condition(
            id=f'{mission.id}.centre',
            sentence=(
                f'the pattern of {uav} is centred within {number(limit)} m of {mission.target} '
                'at t = 0'
            ),
            quantity=QuantityName.PATTERN_CENTRE,
            of=(uav, mission.target),
            target=Target(op='<=', threshold=limit, unit='m'),
            arguments=inputs.arguments(Window.START, mission=arguments),
            source=source,
            every_sample=False,
        )
    yield from _route_numbers(inputs, mission, arguments, source)
    yield from _extents(inputs, mission, arguments, source)


def _route_numbers(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    uav, speed = mission.uav, mission.speed_mps
    if speed is not None and speed.provenance is Provenance.EXPLICIT:
        share = inputs.tolerances.route_speed_share
        slack = inputs.tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
        way = speed.value * speed.value / (2.0 * inputs.tolerances.route_acceleration_mps2)
        yield condition(
            id=f'{mission.id}.speed',
            sentence=(
                f'{uav} flies {bound_words(speed)} {number(speed.value)} m/s for '
                f'{number(100 * share)} % of the time on its legs'
            ),
            quantity=QuantityName.ROUTE_SPEED,
            of=(uav,),
            target=Target(op='>=', threshold=share, unit='1'),
            fraction=share,
            arguments=inputs.arguments(
                Window.PHASE,
                mission=arguments,
                bound=speed.bound,
                wanted=speed.value,
                sample_tolerance=0.0 if speed.bound is not Bound.EXACTLY else slack,
                low=way,
            ),
            source=stated_by(source, speed),
            every_sample=False,
        )
    radius = mission.radius_m
    if radius is not None and radius.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{mission.id}.radius',
            sentence=f'{uav} circles at {bound_words(radius)} {number(radius.value)} m',
            quantity=QuantityName.HORIZONTAL_DISTANCE,
            signal=f'distance_from_centre({uav})',
            of=(uav,),
            target=number_target(radius, inputs.tolerances.standoff_m),
            arguments=inputs.arguments(Window.PHASE, aspect='centre', mission=arguments),
            source=stated_by(source, radius),
        )


def _extents(
    inputs: Inputs, mission: UavMission, arguments: MissionArguments, source: Source
) -> Iterator[Condition]:
    """Yield that the flown pattern is as long and as wide as the prompt states.

    Each end of it may be as far off as a waypoint may be missed.
    """
    if mission.size_m is None or mission.pattern not in _SIZED:
        return
    slack = 2.0 * inputs.tolerances.waypoint_horizontal_m
    axes = _axes(mission.size_m, arguments.waypoints)
    for name, size, axis in zip(('length', 'width'), mission.size_m, axes, strict=True):
        if size.provenance is not Provenance.EXPLICIT or size.value == 0.0:
            continue
        yield condition(
            id=f'{mission.id}.{name}',
            sentence=f'the pattern of {mission.uav} has a {name} of {number(size.value)} m',
            quantity=QuantityName.PATTERN_EXTENT,
            signal=f'{name}({mission.uav})',
            of=(mission.uav,),
            target=Target(op='==', threshold=size.value, unit='m', tolerance=slack),
            arguments=inputs.arguments(Window.PHASE, mission=arguments, axis=axis),
            source=stated_by(source, size),
            every_sample=False,
        )


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


def _check_shape(mission: UavMission, arguments: MissionArguments) -> None:
    """Refuse a plan of another pattern: that its points are visited would then say nothing."""
    points = arguments.waypoints
    if mission.pattern is None or has_shape(mission.pattern, points):
        return
    raise VerificationError(
        f'mission {mission.id} asks for the pattern {mission.pattern.value}, the plan has '
        f'{len(points)} points of another shape',
        hint='grounding must plan the pattern that is asked for',
    )


def _check_size(mission: UavMission, arguments: MissionArguments) -> None:
    """Refuse a route whose legs are not of the stated size: explicit sizes are never changed."""
    if mission.size_m is None or mission.pattern not in (Pattern.RECTANGLE, Pattern.LINE):
        return
    legs = [norm2(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(arguments.waypoints)]
    for parameter in mission.size_m:
        if parameter.provenance is not Provenance.EXPLICIT or parameter.value == 0.0:
            continue
        if all(abs(leg - parameter.value) > SIZE_GUARD_M for leg in legs):
            raise VerificationError(
                f'mission {mission.id} asks for a side of {parameter.value} m, the plan has legs '
                f'of {", ".join(number(leg) for leg in legs)} m',
                hint='grounding must not resize an explicit pattern',
            )
