# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Executors with planted bugs, each against something that the request says explicitly."""

from __future__ import annotations

from aurora_bench.contradictions.case import Planted
from aurora_system_tests import planted_contradictions as bugs
from aurora_system_tests.sabotage import Sabotage


def _bug(
    name: str, request: str, sabotage: Sabotage, requirement: str, *conditions: str
) -> Planted:
    return Planted(
        kind='planted bug',
        name=name,
        request=request,
        sabotage=sabotage,
        requirement=requirement,
        conditions=conditions,
    )


PLANTED: tuple[Planted, ...] = (
    _bug(
        'flies at three fifths of the altitude',
        'hover',
        bugs.planted('altitude too low'),
        'r2',
        'm1.altitude',
        'm1.order',
        'm1.capture',
    ),
    _bug(
        'hovers 60 m beside the place', 'hover', bugs.HOVERS_ASIDE, 'r2', 'm1.drift', 'm1.capture'
    ),
    _bug(
        'skips the landing',
        'sequence',
        bugs.planted('landing skipped'),
        'r6',
        'uav1.landed',
        'c1.holds',
    ),
    _bug(
        'skips the first mission',
        'sequence',
        bugs.planted('mission skipped'),
        'r3',
        'm1.order',
        'm1.completed',
        'm1.duration',
    ),
    _bug('ends a mission early', 'sequence', bugs.ENDS_EARLY, 'r4', 'm2.duration'),
    _bug('flies a route at 60 % of its speed', 'rectangle', bugs.FLIES_SLOWLY, 'r2', 'm1.speed'),
    _bug(
        'flies a rectangle of half the length',
        'rectangle',
        bugs.SMALL_PATTERN,
        'r2',
        'm1.length',
        'm1.waypoints',
    ),
    _bug('alerts before its trigger', 'tailgate', bugs.TRIGGERS_EARLY, 'r7', 'e1.not_before'),
    _bug('alerts 3 s late', 'tailgate', bugs.ALERTS_LATE, 'r7', 'e1.within'),
    _bug(
        'tracks another target',
        'convoy',
        bugs.planted('another target tracked'),
        'r11',
        'm1.tracked',
    ),
    _bug('keeps half of the standoff', 'convoy', bugs.TOO_NEAR, 'r11', 'm1.tracked'),
    _bug(
        'sends no message at all',
        'lossy link',
        bugs.SENDS_NOTHING,
        'r5',
        'e1.within',
        'e1.time',
        'e1.delivered',
    ),
    _bug(
        'never sends a lost message again',
        'lossy link',
        bugs.NEVER_AGAIN,
        'r4',
        'link1.retransmissions',
    ),
    _bug('adds half a second of latency', 'lossy link', bugs.SLUGGISH_LINK, 'r4', 'e1.latency'),
    _bug(
        'sets off before its trigger',
        'setting off',
        bugs.TRIGGERS_EARLY,
        'r3',
        'e1.at_rest',
        'e1.not_before',
    ),
    _bug(
        'gets half way to the speed to set off at',
        'setting off',
        bugs.HALF_HEARTED,
        'r3',
        'e1.completed',
    ),
    _bug(
        'slows down half way to the speed',
        'slow and stop',
        bugs.HALF_HEARTED,
        'r4',
        'e1.completed',
    ),
    _bug(
        'slows to 2 m/s instead of stopping',
        'slow and stop',
        bugs.HALF_HEARTED,
        'r5',
        'e2.completed',
    ),
    _bug(
        'brakes 2 s before its delay is over', 'brake later', bugs.BRAKES_EARLY, 'r4', 'e2.within'
    ),
    _bug('drives past where it is to park', 'parking', bugs.DRIVES_PAST, 'r2', 'truck1.park2'),
    _bug(
        'drives beside somebody at the start only',
        'beside',
        bugs.planted('beside somebody at the start only'),
        'r4',
        'motorcycle1.placed.kept',
    ),
)
