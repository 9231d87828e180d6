# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Time points and circles of bounds in words."""

from __future__ import annotations

from aurora_core.temporal.links import START, Link
from aurora_core.temporal.network import BEFORE, Cycle

_POINTS = {
    'takeoff': 'the take-off of',
    'up': 'the end of the ascent of',
    'landed': 'the landing of',
    'captured': 'the beginning of',
    'over': 'the end of',
    'trigger': 'the trigger of',
    'done': 'the end of',
}


def named(point: str) -> str:
    """Return the name of a time point: `uavs/uav1/landed` is the landing of uav1."""
    _, name, *rest = *point.split('/'), ''
    words = _POINTS.get(rest[0], '')
    return f'{words} {name}'.strip()


def told(cycle: Cycle) -> str:
    """Return why the bounds of a circle exclude each other, in one sentence without its stop.

    Bounds of no time are left out, unless they say what comes before what.
    """
    needed = [link for link in cycle if link.least_s is not None]
    allowed = [link for link in cycle if link.most_s is not None]
    steps = ', '.join(_step(link) for link in needed if link.least_s or link.kind in BEFORE)
    if not allowed:
        return f'something waits for itself: {steps}'
    limits = ', '.join(link.words for link in allowed)
    if not steps:
        return f'{limits}: that is before anything can be'
    least_s = sum(link.least_s or 0.0 for link in needed)
    # What has to come before the end of the scenario says no more than that it has to.
    reached = [link.later for link in needed if link.later.count('/')]
    since = '' if needed[0].earlier == START else f' after {named(needed[0].earlier)}'
    return f'{limits}; {named(reached[-1])} comes {least_s:.1f} s{since} at the earliest: {steps}'


def _step(link: Link) -> str:
    return f'{link.words} ({link.least_s:.1f} s)' if link.least_s else link.words
