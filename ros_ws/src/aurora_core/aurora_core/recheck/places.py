# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by where ground agents are placed: twice beside each other."""

from __future__ import annotations

from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, left_open, stated

# Relation -> axis, and where on it the placed one is, seen from the other one.
_WHERE = {
    'ahead': ('length', 1),
    'behind': ('length', -1),
    'left': ('width', 1),
    'right': ('width', -1),
}


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
