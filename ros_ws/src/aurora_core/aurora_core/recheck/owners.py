# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which limits bind the number at a path of the specification."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from aurora_core.recheck.request import node_at

_MISSIONS: Mapping[str, str] = MappingProxyType(
    {
        'altitude_m': 'uav_altitude_m',
        'standoff_m': 'uav_standoff_max_m',
        'speed_mps': 'uav_speed_max_mps',
        'duration_s': 'uav_endurance_s',
    }
)
_WORLD = MappingProxyType(
    {'wind_mps': 'wind_max_mps', 'gust_mps': 'gust_max_mps', 'duration_s': 'duration_s'}
)


def limits_on(spec: dict[str, Any], path: str, *, above: bool) -> tuple[str, ...]:
    """Return the names of the limits that a stated number has to keep, none where there is none.

    Args:
        spec: The specification as JSON.
        path: Of a number in it.
        above: Whether it is too great, not too small: a condition binds on one side.
    """
    kind, *rest = path.split('/')
    element = node_at(spec, '/'.join((kind, *rest[:1])))
    if kind == 'world' and len(rest) == 1:
        return tuple(_WORLD[name] for name in rest if name in _WORLD)
    if not isinstance(element, dict):
        return ()
    field = '/'.join(rest[1:])
    if kind == 'missions':
        return tuple(_MISSIONS[name] for name in (field,) if name in _MISSIONS)
    if kind == 'links' and field == 'loss':
        return ('link_loss',)
    if kind == 'counts' and field == 'value':
        return ('uavs_max',) if element['kind'] == 'uav' else ('agents_max',)
    if kind == 'agents' and rest[1:2] == ['behaviors'] and rest[-1] == 'speed_mps':
        return _of_agent(spec, element['id'])
    if kind == 'agents' and rest[1:2] == ['behaviors'] and rest[-1] == 'duration_s':
        return ('duration_s',) if above else ()
    if kind == 'events':
        return _of_event(spec, element, field)
    if kind == 'conditions' and field == 'value':
        return _of_condition(spec, element, above=above)
    return ()


def _of_agent(spec: dict[str, Any], name: str) -> tuple[str, ...]:
    agents = [a for a in spec.get('agents', ()) if name in (a['id'], a.get('group'))]
    if not agents:
        return ()
    kind = agents[0]['type']
    general = 'pedestrian_speed_max_mps' if kind == 'pedestrian' else 'vehicle_speed_max_mps'
    return general, f'agent_types/{kind}/max_speed_mps'


def _climb(spec: dict[str, Any], action: dict[str, Any]) -> tuple[str, ...]:
    """Up at most; down where every altitude of the UAV is stated and higher."""
    to = action['altitude_m']
    own = [m['altitude_m'] for m in spec.get('missions', ()) if m['uav'] == action['uav']]
    stated = all(a['provenance'] == 'explicit' for a in (to, *own))
    down = bool(own) and stated and all(a['value'] > to['value'] for a in own)
    return ('uav_descent_max_mps',) if down else ('uav_climb_max_mps',)


def _braking(spec: dict[str, Any], name: str) -> tuple[str, ...]:
    kinds = [a['type'] for a in spec.get('agents', ()) if name in (a['id'], a.get('group'))]
    return tuple(f'agent_types/{kind}/emergency_decel_mps2' for kind in kinds[:1])


def _of_event(spec: dict[str, Any], event: dict[str, Any], field: str) -> tuple[str, ...]:
    trigger, action = event.get('trigger') or {}, event.get('action') or {}
    if field == 'trigger/value_m' and trigger['on'] == 'altitude_reached':
        return ('uav_altitude_m',)
    if field == 'trigger/value_mps' and trigger['on'] == 'speed_above':
        return _of_agent(spec, trigger['who'])
    if field == 'action/vertical_mps':
        return _climb(spec, action)
    if field == 'action/deceleration_mps2':
        return _braking(spec, action['agent'])
    if field == 'action/altitude_m':
        return ('uav_altitude_m',)
    return _of_agent(spec, action['agent']) if field == 'action/value_mps' else ()


def _of_condition(
    spec: dict[str, Any], condition: dict[str, Any], *, above: bool
) -> tuple[str, ...]:
    of, quantity, op = condition['of'], condition['quantity'], condition['op']
    uavs = {u[key] for u in spec.get('uavs', ()) for key in ('id', 'group') if u.get(key)}
    aloft = len(of) == 1 and of[0] in uavs
    partly = any(condition.get(name) is not None for name in ('fraction', 'hold_s', 'by_s'))
    # "At most 2 m" of a moment can be met on the ground.
    if (op not in ('>', '>=', '==')) if above else (op not in ('<', '<=') or partly):
        return ()
    if quantity == 'deceleration' and above:
        return _braking(spec, of[0])
    if quantity == 'altitude' and aloft:
        return ('uav_altitude_m',)
    if quantity == 'speed' and above and len(of) == 1:
        return ('uav_speed_max_mps',) if aloft else _of_agent(spec, of[0])
    return ()
