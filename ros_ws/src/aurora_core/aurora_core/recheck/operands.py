# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the conditions that a proof names are about things that have their quantity."""

from __future__ import annotations

from typing import Any

from aurora_core.outcomes.feasibility import Certificate, FactSource
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, names_of

_PLACES = ('intersection', 'crosswalk', 'sidewalk', 'roadside', 'main_road')
# What takes its speed from who drives.
SLOWS = ('stop', 'brake', 'slow', 'yield', 'wait', 'park')
_ONE_UAV = (
    'altitude',
    'hover_drift',
    'waypoints_visited',
    'mission_completed',
    'landed',
    'battery',
)


def kinds_fit(proof: Certificate, request: Request) -> list[Step]:
    """Every condition that a proof rests on has operands of the right kinds."""
    paths = [proof.path, *(b.of for b in proof.chain)]
    paths += [f.path for f in proof.facts if f.source is FactSource.REQUEST]
    ids = {p.split('/')[1] for p in paths if p.startswith('conditions/') and p.count('/')}
    named = [c for c in request.all('conditions') if c['id'] in ids]
    return [(_fits(c, request), f'{c["quantity"]} is of {", ".join(c["of"])}') for c in named]


def _fits(condition: dict[str, Any], request: Request) -> bool:
    of, quantity = list(condition['of']), condition['quantity']
    uavs, agents = names_of(request, 'uavs'), names_of(request, 'agents')
    bodies = uavs | agents
    if len(set(of)) != len(of) or not of:
        return False
    if quantity in _ONE_UAV:
        return len(of) == 1 and of[0] in uavs
    if quantity == 'speed':
        return len(of) == 1 and of[0] in bodies
    if quantity == 'event_time':
        return len(of) == 1 and of[0] in {e['id'] for e in request.all('events')}
    if quantity == 'separation':
        single = {b['id'] for kind in ('uavs', 'agents') for b in request.all(kind)}
        return set(of) <= bodies and (len(of) > 1 or of[0] not in single)
    if len(of) != 2:
        return False
    place = [name in _PLACES or name.startswith('landmark:') for name in of]
    body = [name in bodies for name in of]
    if quantity in ('distance', 'horizontal_distance'):
        return any(body) and all(b or p for b, p in zip(body, place, strict=True))
    if quantity in ('visible_time', 'visible_fraction'):
        return body[0] and (body[1] or place[1])
    if quantity in ('tracked_fraction', 'clearance'):
        return of[0] in uavs and (body[1] or place[1])
    return all(body)


def is_split(request: Request, names: set[str]) -> bool:
    """Whether one of these does several things after each other: a condition may mean one."""
    busy = []
    flown = [m['uav'] for m in request.all('missions')]
    for event in request.all('events'):
        action = event.get('action') or {}
        # An event that begins the one mission of a UAV splits nothing.
        if not (action.get('mission') and flown.count(action.get('uav')) == 1):
            busy += [action.get('uav'), action.get('agent')]
    busy += [uav for uav in flown if flown.count(uav) > 1]
    for kind in ('uavs', 'agents'):
        busy += [b['group'] for b in request.all(kind) if b.get('group') and b['id'] in busy]
    return bool(names & set(busy))
