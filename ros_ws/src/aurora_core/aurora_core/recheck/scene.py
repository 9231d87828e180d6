# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by a count of the whole scene that leaves out what the prompt names."""

from __future__ import annotations

from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.request import Request, stated

_NO_VEHICLES = ('pedestrian', 'rsu')


def scene(proof: Certificate, request: Request) -> list[Step]:
    """More bodies of a kind are named than the count has, or as many beside a traffic."""
    count = request.one(proof.path)
    number = (count or {}).get('value')
    if count is None or 'kind' not in count or not stated(number):
        return [(False, f'{proof.path} is a count of the scene')]
    kind, words = count['kind'], number['span']
    named = [b for b in _bodies(request, kind) if not _overlap(b.get('span'), words)]
    density = (request.spec.get('world') or {}).get('traffic_density')
    traffic = int(density is not None and kind in ('vehicle', 'body'))
    return [
        (number.get('bound', 'exactly') != 'at_least', 'the count is no "at least"'),
        (
            len(named) + traffic > float(number['value']),
            f'{len(named)} named and {traffic} of the traffic are more than {number["value"]:g}',
        ),
    ]


def _bodies(request: Request, kind: str) -> list[dict[str, Any]]:
    found = []
    for agent in request.all('agents'):
        vehicle = agent['type'] not in _NO_VEHICLES
        person = agent['type'] == 'pedestrian'
        fits = {'vehicle': vehicle, 'person': person, 'body': vehicle or person}
        if fits.get(kind, agent['type'] == kind):
            found.append(agent)
    return found + (request.all('uavs') if kind in ('uav', 'body') else [])


def _overlap(one: Any, other: Any) -> bool:
    if not one or not other:
        return False
    return bool(max(one['start'], other['start']) < min(one['end'], other['end']))
