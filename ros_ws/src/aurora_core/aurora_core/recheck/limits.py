# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Proofs by one number: a limit, a count, or a sign."""

from __future__ import annotations

import math
from typing import Any

from aurora_core.outcomes.feasibility import Certificate
from aurora_core.recheck.finding import Step
from aurora_core.recheck.owners import limits_on
from aurora_core.recheck.request import node_at, quoted, read_config, read_limits

# Limit name of a certificate -> (key in limits.json of its lower end, of its upper end).
_LIMITS: dict[str, tuple[str | None, str]] = {
    'uav_altitude_m': ('uav_altitude_min_m', 'uav_altitude_max_m'),
    'uav_standoff_max_m': (None, 'uav_standoff_max_m'),
    'uav_speed_max_mps': (None, 'uav_speed_max_mps'),
    'uav_endurance_s': (None, 'uav_endurance_s'),
    'vehicle_speed_max_mps': (None, 'vehicle_speed_max_mps'),
    'pedestrian_speed_max_mps': (None, 'pedestrian_speed_max_mps'),
    'uav_climb_max_mps': (None, 'uav_climb_max_mps'),
    'uav_descent_max_mps': (None, 'uav_descent_max_mps'),
    'gust_max_mps': (None, 'gust_max_mps'),
    'wind_max_mps': (None, 'wind_max_mps'),
    'duration_s': ('duration_min_s', 'duration_max_s'),
    'uavs_max': (None, 'uavs_max'),
    'agents_max': (None, 'agents_max'),
}
# A message that is lost with certainty: the limit follows from what a probability is.
_LOSS = 'link_loss'
_SIGNED = {'m', 's', 'm/s', 'm/s^2', '1'}


def by_limit(proof: Certificate, spec: dict[str, Any] | None) -> list[Step]:
    """A stated number, or a count, lies beyond a limit."""
    return [*_limit(proof), *_stated(proof, spec)]


def by_sign(proof: Certificate, spec: dict[str, Any]) -> list[Step]:
    """A stated number is one that nothing has: below zero, nothing flown, a broken count."""
    number = _at(spec, proof.path)
    if number is None:
        return [(False, f'the specification has no parameter {proof.path}')]
    value, bound = float(number['value']), number.get('bound', 'exactly')
    if value == 0.0:
        step = _is_flown(spec, proof.path), f'{proof.path} = 0 leaves nothing to fly'
    elif proof.path.endswith('/waypoint_count') and value > 0.0:
        broken = bound == 'exactly' and value != int(value)
        step = broken, f'{proof.path} = {value:g} is no whole number'
    else:
        step = value < 0.0, f'{proof.path} = {value:g} is below zero'
    return [
        (number.get('provenance') == 'explicit', f'{proof.path} is {number.get("provenance")}'),
        (number.get('unit') in _SIGNED, f'a number in {number.get("unit")} has to be positive'),
        (bound != 'at_least', f'the number binds {bound}, so nothing greater meets it'),
        step,
    ]


def _is_flown(spec: dict[str, Any], path: str) -> bool:
    """Return whether a zero at a path leaves a UAV without a phase, a way or a pattern."""
    parts = path.split('/')
    mission = node_at(spec, '/'.join(parts[:2])) if parts[0] == 'missions' else None
    if not isinstance(mission, dict):
        return False
    name = '/'.join(parts[2:])
    if name == 'size_m/1':
        return mission.get('pattern') in ('rectangle', 'lawnmower')
    return name == 'duration_s' or (
        mission.get('mode') == 'navigate'
        and name in ('speed_mps', 'radius_m', 'waypoint_count', 'turns', 'size_m/0')
    )


def _limit(proof: Certificate) -> list[Step]:
    if proof.requested is None or proof.limit is None:
        return [(False, 'a proof by a limit needs the requested value and the limit')]
    asked, limit = proof.requested, proof.limit
    if proof.limit_name == _LOSS:
        return [
            (limit in (0.0, 1.0), f'{limit:g} is an end of the range of probabilities'),
            (
                asked >= 1.0 or asked < 0.0,
                f'with loss {asked:g} no message is ever delivered, or it is no probability',
            ),
        ]
    ends = _ends(proof.limit_name)
    if ends is None:
        return [(False, f'there is no limit {proof.limit_name!r}')]
    low, high = ends
    shown = f'{low:g} to {high:g}'
    return [
        (limit in (low, high), f'{limit:g} is an end of {proof.limit_name}, {shown}'),
        (
            asked < low or asked > high,
            f'{asked:g} {proof.unit} lies outside {shown}',
        ),
    ]


def _ends(name: str) -> tuple[float, float] | None:
    """Return what a limit allows; None for a limit that is not known."""
    table = read_limits()
    parts = name.split('/')
    if len(parts) == 3 and (parts[0], parts[2]) == ('agent_types', 'max_speed_mps'):
        rows = read_config('knowledge', 'measured', 'agent_types.json')['types']
        row = next((r for r in rows if r['name'] == parts[1]), None)
        if row is None:
            return None
        general = 'pedestrian_speed_max_mps' if row['is_person'] else 'vehicle_speed_max_mps'
        return 0.0, min(float(row['max_speed_mps']), float(table[general]))
    if len(parts) == 3 and (parts[0], parts[2]) == ('agent_types', 'emergency_decel_mps2'):
        rows = read_config('knowledge', 'measured', 'agent_types.json')['types']
        ends = [float(r['emergency_decel_mps2']) for r in rows if r['name'] == parts[1]]
        return (0.0, ends[0]) if ends else None
    keys = _LIMITS.get(name)
    if keys is None:
        return None
    low, high = keys
    # A one-sided limit has zero as its other end: no speed, distance or duration is negative.
    return (0.0 if low is None else float(table[low])), float(table[high])


def _stated(proof: Certificate, spec: dict[str, Any] | None) -> list[Step]:
    """The request really says the number."""
    if spec is None:
        return []
    if proof.path in ('agents', 'uavs'):
        count = len(spec.get(proof.path, ()))
        return [(count == proof.requested, f'the specification has {count} {proof.path}')]
    parameter = _at(spec, proof.path)
    if parameter is None:
        return [(False, f'the specification has no parameter {proof.path}')]
    value = parameter.get('value')
    above = (proof.requested or 0.0) > (proof.limit or 0.0) or proof.limit_name == _LOSS
    names = limits_on(spec, proof.path, above=above)
    checks: list[Step] = [
        *_in_space(spec, proof),
        *_may_not_lose(spec, proof),
        (proof.limit_name in names, f'{proof.path} is bound by {", ".join(names) or "nothing"}'),
        (value == proof.requested, f'the specification has {proof.path} = {value}'),
        (
            parameter.get('provenance') == 'explicit',
            f'{proof.path} is {parameter.get("provenance")}: only a stated number may be refused',
        ),
    ]
    bound = parameter.get('bound', 'exactly')
    if proof.requested is not None and proof.limit is not None:
        escape = 'at_most' if above else 'at_least'
        checks.append((bound != escape, f'the number binds {bound}, so it cannot be moved inside'))
    return [*checks, *quoted(proof, spec)]


def _in_space(spec: dict[str, Any], proof: Certificate) -> list[Step]:
    """The speed of a UAV, unless it is that of a route, is in space: it may climb as well."""
    of_uav = proof.limit_name == 'uav_speed_max_mps' and proof.path.startswith('conditions/')
    if not of_uav or (proof.requested or 0.0) < 0.0:
        return []
    table, margin = read_limits(), read_config('tolerances.json')['limit_margin']
    fastest = math.hypot(float(table['uav_speed_max_mps']), float(table['uav_climb_max_mps']))
    fastest *= 1.0 + float(margin)
    return [((proof.requested or 0.0) > fastest, f'it flies {fastest:.2f} m/s in space at most')]


def _may_not_lose(spec: dict[str, Any], proof: Certificate) -> list[Step]:
    """A link may lose all messages where the request asks for that."""
    if proof.limit_name != _LOSS or proof.requested != 1.0:
        return []
    link = node_at(spec, proof.path.rpartition('/')[0]) or {}
    asked = [
        c
        for c in spec.get('conditions') or ()
        if (c['quantity'], c['op'], c['value']['value']) == ('delivered', '==', 0.0)
        and list(c['of']) == [link.get('sender'), link.get('receiver')]
    ]
    return [(not asked, f'{proof.path}: that nothing is delivered is not what is asked for')]


def _at(spec: dict[str, Any], path: str) -> dict[str, Any] | None:
    """Return the parameter at a path such as `missions/m1/altitude_m`."""
    node = node_at(spec, path)
    return node if isinstance(node, dict) and 'value' in node else None
