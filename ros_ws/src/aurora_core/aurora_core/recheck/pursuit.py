# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by a target that drives away from whoever tracks it."""

from __future__ import annotations

import math
from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.bounds import is_whole
from aurora_core.recheck.finding import Step
from aurora_core.recheck.operands import SLOWS, is_split
from aurora_core.recheck.request import Request, left_open, stated


def pursuit(proof: Certificate, request: Request) -> list[Step]:
    """At its least speed the target leaves the ring in which it is tracked before the time."""
    parts = proof.path.split('/')
    mission = request.one('/'.join(parts[:2])) if parts[-1] == 'target' else None
    if mission is None or mission.get('mode') != 'track':
        return [(False, f'{proof.path} is the target of a pursuit')]
    agent = request.one(f'agents/{mission["target"]}')
    if agent is None:
        return [(False, f'{mission["target"]} is on the ground')]
    top = request.limit('uav_speed_max_mps')
    fastest = top * (1.0 + float(request.tolerances['limit_margin']))
    tracked = float(request.tolerances['tracked_fraction'])
    for condition in request.all('conditions'):
        if condition['quantity'] == 'tracked_fraction' and mission['uav'] in condition['of']:
            tracked = min(tracked, float(condition['value']['value']))
    length, way = _least_phase(request, mission), _way(request, mission)
    speeds = [s for s in _speeds(request, agent) if s[0] == proof.requested]
    gone = max(
        (max(0.0, tracked + share - 1.0) * length * (low - fastest) for _, low, share in speeds),
        default=0.0,
    )
    return [
        (not is_split(request, {mission['uav'], agent['id']}), 'no event changes either of them'),
        (proof.limit == top, f'{proof.limit_name} is {top:g}'),
        (bool(speeds), f'{proof.requested} m/s is stated of {agent["id"]}'),
        (
            gone > way,
            f'{agent["id"]} gets {gone:.1f} m away while it has to be near, and is near for '
            f'{way:.1f} m at most',
        ),
    ]


def _speeds(request: Request, agent: dict[str, Any]) -> list[tuple[float, float, float]]:
    """Return stated speeds, the least that meets each, and the share of the time that it holds."""
    found = []
    behaviors = agent.get('behaviors', ())
    if not any(b['kind'] in SLOWS for b in behaviors):
        share = float(request.tolerances['route_speed_share'])
        for number in (b.get('speed_mps') for b in behaviors):
            if stated(number):
                low = left_open(number, request.slack('route_speed_mps', number))[0]
                found.append((float(number['value']), low, share))
    for condition in request.all('conditions'):
        number = condition['value']
        fast = condition['quantity'] == 'speed' and list(condition['of']) == [agent['id']]
        if fast and condition['op'] in ('>', '>=') and is_whole(condition) and stated(number):
            found.append((float(number['value']), float(number['value']), 1.0))
    return found


def _least_phase(request: Request, mission: dict[str, Any]) -> float:
    number = mission['duration_s']
    if not stated(number):
        return float(number['low'])
    return left_open(number, request.slack('duration_s', number))[0]


def _way(request: Request, mission: dict[str, Any]) -> float:
    """Return the longest straight way between two circles, or inside the one there is."""
    number, slack = mission['standoff_m'], request.limit('tracking_horizontal_m')
    if stated(number):
        slack = request.slack('standoff_m', number)
        most = request.limit('uav_standoff_max_m') + slack
        near, far = left_open(number, slack, 0.0, most)
    else:
        near, far = max(0.0, float(number['value']) - slack), float(number['value']) + slack
    return 2.0 * math.sqrt(max(0.0, far**2 - near**2))
