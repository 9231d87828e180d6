# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by where ground agents are placed: twice beside each other."""

from __future__ import annotations

import math
from typing import Any

from aurora_core.outcomes.feasibility import Certificate, FactSource
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, left_open, stated

# Relation -> axis, and where on it the placed one is, seen from the other one.
_WHERE = {
    'ahead': ('length', 1),
    'behind': ('length', -1),
    'left': ('width', 1),
    'right': ('width', -1),
}

_ROUNDING_M = 1e-6


def placement(proof: Certificate, request: Request) -> list[Step]:
    """Another placement of the same two is on the other side, or at another distance."""
    parts = proof.path.split('/')
    is_one = len(parts) == 4 and (parts[0], parts[2]) == ('agents', 'placements')
    one = request.one(proof.path) if is_one else None
    if one is None or one.get('relation') not in _WHERE:
        return [(False, f'{proof.path} places an agent on a side')]
    others = [
        (agent['id'], p)
        for agent in request.all('agents')
        for p in agent.get('placements', ())
        if p is not one and p.get('relation') in _WHERE
    ]
    against = any(_exclude(request, (parts[1], one), other) for other in others)
    if not against and _does_not_close(request, proof, _WHERE[one['relation']][0]):
        return [(True, 'placements in a row add up to something else')]
    return [(against, f'another placement of {parts[1]} and {one.get("of")} excludes this one')]


def _exclude(
    request: Request, one: tuple[str, dict[str, Any]], other: tuple[str, dict[str, Any]]
) -> bool:
    (name, a), (second, b) = one, other
    if (axis := _WHERE[a['relation']])[0] != _WHERE[b['relation']][0]:
        return False
    sign, other_sign = axis[1], _WHERE[b['relation']][1]
    if (second, b.get('of')) == (a.get('of'), name):
        other_sign = -other_sign
    elif (second, b.get('of')) != (name, a.get('of')):
        return False
    if sign != other_sign:
        return True
    far, away = a.get('distance_m'), b.get('distance_m')
    if not (stated(far) and stated(away)):
        return False
    if any(number.get('bound', 'exactly') != 'exactly' for number in (far, away)):
        return False
    low, high = left_open(far, request.slack('placement_other_m', far))
    least, most = left_open(away, request.slack('placement_other_m', away))
    return low > most or least > high


def _does_not_close(request: Request, proof: Certificate, axis: str) -> bool:
    """Whether the placements that the proof names cannot all be: shortest ways from each to each.

    `most[a][b]` is the greatest amount by which b may be farther along than a.
    """
    named = {
        '/'.join(f.path.split('/')[:4])
        for f in proof.facts
        if f.source is FactSource.REQUEST and '/placements/' in f.path
    }
    if proof.path not in named:
        return False
    most: dict[tuple[str, str], float] = {}
    for agent in request.all('agents'):
        for k, placed in enumerate(agent.get('placements', ())):
            where = _WHERE.get(placed['relation'])
            if f'agents/{agent["id"]}/placements/{k}' not in named or where is None:
                continue
            if where[0] != axis or not placed.get('of'):
                return False
            behind, front = (placed['of'], agent['id'])[:: where[1]]
            number = placed.get('distance_m')
            slack = request.slack('placement_other_m', number) if number else 0.0
            low, high = left_open(number, slack)
            for way, bound in (((front, behind), -low), ((behind, front), high)):
                most[way] = min(most.get(way, math.inf), bound)
    names = sorted({name for way in most for name in way})
    for middle in names:
        for a in names:
            for b in names:
                detour = most.get((a, middle), math.inf) + most.get((middle, b), math.inf)
                most[a, b] = min(most.get((a, b), math.inf), detour)
    # Being ahead of oneself by nothing is as wrong where nobody says how far.
    loops = [most[name, name] for name in names if (name, name) in most]
    return any(loop < -_ROUNDING_M for loop in loops) or _all_ahead(request, named)


def _all_ahead(request: Request, named: set[str]) -> bool:
    """Whether every one of them is ahead of the next, in a circle."""
    ahead = {}
    for path in named:
        placed = request.one(path)
        if placed is None or placed.get('relation') not in _WHERE:
            return False
        front, behind = path.split('/')[1], placed['of']
        if _WHERE[placed['relation']][1] < 0:
            front, behind = behind, front
        ahead[front] = behind
    start = at = next(iter(ahead), '')
    for _ in named:
        at = ahead.get(at, '')
    return len(ahead) == len(named) and at == start != ''
