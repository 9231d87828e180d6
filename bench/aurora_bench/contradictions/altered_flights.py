# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings in which a UAV flies otherwise than its request says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from aurora_bench.contradictions import motion
from aurora_bench.contradictions.case import Alter, Altered
from aurora_bench.mutation.recording import Recording, Span
from aurora_bench.mutation.states import shortened
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.trace import Trace


def _span(base: Recording, mission: str) -> Span:
    return next(span for span in base.spans if span.mission.id == mission)


def _of(mission: str, change: Callable[..., Trace], *values: float) -> Alter:
    """Return what changes the flight of a mission."""
    return lambda base: change(base, _span(base, mission), *values)


def _flight(
    kind: str, name: str, request: str, requirement: str, alter: Alter, *conditions: str
) -> Altered:
    return Altered(
        kind=kind,
        name=name,
        request=request,
        requirement=requirement,
        conditions=conditions,
        alter=alter,
    )


def _cut(base: Recording, span: Span, seconds: float) -> Trace:
    """Leave so many seconds out of the middle of a mission."""
    middle, ticks = (span.first + span.stop) // 2, motion.ticks_of(base, seconds)
    return motion.without(base, middle - ticks // 2, middle + ticks - ticks // 2)


def _longer(base: Recording, span: Span, seconds: float) -> Trace:
    middle, ticks = (span.first + span.stop) // 2, motion.ticks_of(base, seconds)
    return motion.again(base, middle - ticks // 2, middle + ticks - ticks // 2)


def _corner(base: Recording, span: Span, reach_s: float) -> Trace:
    """Cut the corner at which the way bends most."""
    reach = motion.ticks_of(base, reach_s)
    path = base.trace.uav[:, span.row, UavColumn.X : UavColumn.Y + 1]
    inside = range(span.first + 2 * reach, span.stop - 2 * reach)

    def bend(tick: int) -> float:
        chord = (path[tick - reach] + path[tick + reach]) / 2.0
        return float(np.hypot(*(path[tick] - chord)))

    corner = max(inside, key=bend)
    return motion.drawn(base, span, corner - reach, corner + reach)


def _home_early(base: Recording, span: Span, share: float) -> Trace:
    """Fly straight to the end of the route after a share of it."""
    first = span.first + round(share * (span.stop - span.first))
    return motion.drawn(base, span, first, span.stop - 1)


def _run_cut(base: Recording) -> Trace:
    """End the record two thirds through, with the claim that this was the end."""
    stop = 2 * base.trace.ticks // 3
    trace = shortened(base.trace, stop)
    end = replace(base.trace.events[-1], tick=stop - 1)
    return replace(trace, events=(*trace.events, end))


def _outwards(base: Recording, span: Span, metres: float) -> Trace:
    """Displace the whole flight away from where its target is in the middle of the mission."""
    target, tick = span.mission.target, (span.first + span.stop) // 2
    assert target is not None
    away = (
        base.trace.uav[tick, span.row, UavColumn.X : UavColumn.Y + 1]
        - base.trace.ground[tick, motion.row_of(base, target), GroundColumn.X : GroundColumn.Y + 1]
    )
    east_m, north_m = (metres * away / np.linalg.norm(away)).tolist()
    return motion.elsewhere(base, span, east_m, north_m)


FLIGHTS: tuple[Altered, ...] = (
    _flight(
        'altitude shifted',
        'hovers 8 m lower than asked',
        'hover',
        'r2',
        _of('m1', motion.raised, -8.0, 15.0),
        'm1.altitude',
    ),
    _flight(
        'altitude shifted',
        'first hover 8 m higher than asked',
        'sequence',
        'r3',
        _of('m1', motion.raised, 8.0, 9.0),
        'm1.altitude',
    ),
    _flight(
        'altitude shifted',
        'tracks 10 m lower than asked',
        'setting off',
        'r4',
        _of('m1', motion.raised, -10.0, 25.0),
        'm1.altitude',
        'm1.tracked',
    ),
    _flight(
        'altitude shifted',
        'route 6 m lower than asked',
        'rectangle',
        'r2',
        _of('m1', motion.raised, -6.0, 35.0),
        'm1.altitude',
        'm1.waypoints',
    ),
    _flight(
        'flight elsewhere',
        'hovers 60 m beside the place',
        'hover',
        'r2',
        _of('m1', motion.elsewhere, 60.0, 0.0),
        'm1.drift',
        'm1.capture',
    ),
    _flight(
        'flight elsewhere',
        'rectangle 40 m beside its place',
        'rectangle',
        'r2',
        _of('m1', motion.elsewhere, 0.0, 40.0),
        'm1.waypoints',
    ),
    _flight(
        'flight elsewhere',
        'points 40 m beside what they are around',
        'points',
        'r4',
        _of('m1', motion.elsewhere, 40.0, 0.0),
        'm1.waypoints',
    ),
    _flight(
        'drift',
        'drifts 8 m while it hovers',
        'hover',
        'r2',
        _of('m1', motion.aside, 8.0, 12.0, 2.0),
        'm1.drift',
    ),
    _flight(
        'phase shortened',
        'hovers for 14 s, not 20',
        'hover',
        'r2',
        _of('m1', _cut, 6.0),
        'm1.duration',
    ),
    _flight(
        'phase shortened',
        'tracks for 8 s, not 20',
        'sequence',
        'r4',
        _of('m2', _cut, 12.0),
        'm2.duration',
    ),
    _flight(
        'phase lengthened',
        'hovers for 26 s, not 20',
        'hover',
        'r2',
        _of('m1', _longer, 6.0),
        'm1.duration',
    ),
    _flight('run cut', 'ends after 60 of 90 s', 'hover', 'r3', _run_cut, 'world.duration'),
    _flight(
        'landing removed',
        'stays in the air',
        'sequence',
        'r6',
        _of('m2', motion.aloft),
        'uav1.landed',
        'c1.holds',
    ),
    _flight(
        'target lost',
        'gets 40 m away from its target',
        'sequence',
        'r4',
        _of('m2', motion.aside, 40.0, 18.0, 8.0),
        'm2.tracked',
    ),
    _flight(
        'standoff changed',
        'tracks from 20 m more than asked',
        'convoy',
        'r11',
        _of('m1', _outwards, 20.0),
        'm1.tracked',
        'm1.capture',
    ),
    _flight(
        'standoff changed',
        'hovers 15 m farther than asked',
        'parked',
        'r7',
        _of('m1', _outwards, 15.0),
        'm1.standoff',
    ),
    _flight(
        'corner cut',
        'passes a corner of the rectangle by',
        'rectangle',
        'r2',
        _of('m1', _corner, 4.0),
        'm1.waypoints',
    ),
    _flight(
        'route left',
        'leaves the rectangle after six tenths of it',
        'rectangle',
        'r2',
        _of('m1', _home_early, 0.6),
        'm1.waypoints',
    ),
    _flight(
        'pattern scaled',
        'rectangle of 70 % of its size',
        'rectangle',
        'r2',
        _of('m1', motion.scaled, 0.7),
        'm1.length',
        'm1.waypoints',
    ),
    _flight(
        'route speed changed',
        'flies at 20 m/s, not 10',
        'rectangle',
        'r2',
        _of('m1', motion.faster),
        'm1.speed',
    ),
)
