# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Feasible requests of the prompt files, each pushed over one limit, or just up to it.

A push changes one thing of a specification (or adds one) so that nothing else can be at fault. It
is tried on every request, and of those that it fits a few are taken, evenly spread.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from aurora_bench.feasibility.families import Case
from aurora_core.spec.scenario import ScenarioSpec

Doc = dict[str, Any]
# Changes a specification; whether the result is over the limit. None: the push does not fit.
_Change = Callable[[Doc, bool], Doc | None]


@dataclass(frozen=True, slots=True)
class Push:
    """One limit and the change that goes over it."""

    id: str
    because: tuple[str, ...]
    change: _Change


def push_cases(specs: Sequence[tuple[str, ScenarioSpec]], each: int) -> Iterator[Case]:
    """Yield pairs of requests: pushed over the limit, and up to it.

    Args:
        specs: Feasible requests with their ids.
        each: So many requests per push at most.
    """
    for push in PUSHES:
        pairs = (_pair(push, ident, spec) for ident, spec in specs)
        fitting = [pair for pair in pairs if pair is not None]
        step = max(1, len(fitting) // each)
        for over, kept in fitting[::step][:each]:
            yield over
            if kept is not None:
                yield kept


def _pair(push: Push, ident: str, spec: ScenarioSpec) -> tuple[Case, Case | None] | None:
    found: list[Case] = []
    for over in (True, False):
        changed = push.change(spec.model_dump(mode='json'), over)
        if changed is None:
            continue
        try:
            pushed = ScenarioSpec.model_validate(changed)
        except ValidationError:
            return None
        found.append(
            Case(
                id=f'{push.id}-{"over" if over else "kept"}:{ident}',
                source='push',
                prompt=spec.prompt,
                because=push.because if over else (),
                spec=pushed,
            )
        )
    if not found or not found[0].must_be_refused:
        return None
    return found[0], found[1] if len(found) > 1 else None


def _said(spec: Doc, value: float, unit: str, **more: Any) -> Doc:
    """Return a number that the prompt states: its whole length stands for where."""
    return {
        'value': value, 'unit': unit, 'low': value, 'high': value, 'provenance': 'explicit',
        'span': {'start': 0, 'end': len(spec['prompt'])}, **more,
    }  # fmt: skip


def _mission(spec: Doc, mode: str) -> Doc | None:
    return next((m for m in spec['missions'] if m['mode'] == mode), None)


def _stated(number: Doc | None) -> bool:
    return number is not None and number['provenance'] == 'explicit'


def _asks(spec: Doc, quantity: str, of: Sequence[str], op: str, number: Doc, **more: Any) -> Doc:
    """Add a condition."""
    spec['conditions'].append(
        {'id': f'pushed{len(spec["conditions"])}', 'quantity': quantity, 'of': list(of), 'op': op,
         'value': number, **more}
    )  # fmt: skip
    return spec


def _altitude(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'hover') or _mission(spec, 'track')
    about = {c['quantity'] for c in spec['conditions']} & {'altitude', 'distance'}
    if mission is None or about or spec['world']['weather'] != 'clear':
        return None
    if spec['world']['time_of_day'] != 'noon' or len(spec['missions']) > 1 or spec['links']:
        return None
    mission['altitude_m'] = _said(spec, 120.5 if over else 120.0, 'm')
    return spec


def _standoff(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'track')
    if mission is None or len(spec['missions']) > 1 or spec['conditions'] or spec['links']:
        return None
    if spec['world']['weather'] != 'clear' or spec['world']['time_of_day'] != 'noon':
        return None
    if mission.get('side') or spec['events']:
        return None
    mission['standoff_m'] = _said(spec, 151.0 if over else 150.0, 'm')
    return spec


def _wind(spec: Doc, over: bool) -> Doc | None:
    if not spec['missions']:
        return None
    spec['world']['wind_mps'] = _said(spec, 15.5 if over else 15.0, 'm/s')
    return spec


def _endurance(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'hover')
    alone = len(spec['missions']) == 1 and not spec['events'] and not spec['conditions']
    if mission is None or not alone or _stated(spec['world'].get('duration_s')):
        return None
    mission['altitude_m'] = _said(spec, 60.0, 'm')
    mission['duration_s'] = _said(spec, 1500.0 if over else 1400.0, 's')
    return spec


def _route_speed(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'navigate')
    size = (mission or {}).get('size_m') or []
    if mission is None or not size or size[0]['value'] < 260.0 or not _stated(size[0]):
        return None
    if any(c['quantity'] == 'speed' for c in spec['conditions']):
        return None
    mission['speed_mps'] = _said(spec, 18.2 if over else 18.0, 'm/s')
    return spec


def _pursuit(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'track')
    agent = next((a for a in spec['agents'] if mission and a['id'] == mission['target']), None)
    if mission is None or agent is None or spec['events']:
        return None
    if agent['type'] not in ('car', 'van', 'police'):
        return None
    if len(agent['behaviors']) > 1 or agent['placements'] or spec['conditions']:
        return None
    if any(b['kind'] != 'drive' for b in agent['behaviors']):
        return None
    if _stated(mission['standoff_m']) or _stated(mission['duration_s']):
        return None
    speed = _said(spec, 24.0 if over else 18.0, 'm/s')
    agent['behaviors'] = [{'kind': 'drive', 'speed_mps': speed}]
    return spec


def _sensing(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'track') or _mission(spec, 'hover')
    if mission is None or mission['target'] is None or mission['target'].startswith('uav'):
        return None
    if spec['conditions'] or spec['links'] or len(spec['missions']) > 1 or spec['events']:
        return None
    if _stated(mission.get('standoff_m')):
        return None
    spec['world'] |= {'weather': 'fog', 'time_of_day': 'noon'}
    mission['altitude_m'] = _said(spec, 82.0 if over else 70.0, 'm')
    return spec


def _horizon(spec: Doc, over: bool) -> Doc | None:
    durations = [m['duration_s'] for m in spec['missions'] if _stated(m.get('duration_s'))]
    if len(spec['missions']) != 1 or not durations or durations[0]['value'] < 30.0:
        return None
    if _stated(spec['world'].get('duration_s')) or spec['conditions'] or spec['events']:
        return None
    if durations[0].get('bound', 'exactly') != 'exactly':
        return None
    longest = durations[0]['value'] * (0.9 if over else 1.0) + (0.0 if over else 120.0)
    spec['world']['duration_s'] = _said(spec, longest, 's')
    return spec


def _altitude_bounds(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'track') or _mission(spec, 'hover')
    if mission is None or _stated(mission['altitude_m']) or len(spec['missions']) > 1:
        return None
    if any(c['quantity'] in ('altitude', 'distance') for c in spec['conditions']):
        return None
    low, high = (41.0, 40.0) if over else (30.0, 50.0)
    _asks(spec, 'altitude', [mission['uav']], '>=', _said(spec, low, 'm', bound='at_least'))
    return _asks(spec, 'altitude', [mission['uav']], '<=', _said(spec, high, 'm', bound='at_most'))


def _distance_bounds(spec: Doc, over: bool) -> Doc | None:
    pair = next(
        ([a['id'], b['target']] for a in spec['agents'] for b in a['behaviors']
         if b['kind'] == 'follow' and b['target'] in {x['id'] for x in spec['agents']}),
        None,
    )  # fmt: skip
    if pair is None or spec['conditions'] or spec['events']:
        return None
    low, high = (30.0, 29.0) if over else (5.0, 60.0)
    _asks(spec, 'distance', pair, '>=', _said(spec, low, 'm', bound='at_least'))
    return _asks(spec, 'distance', pair[::-1], '<=', _said(spec, high, 'm', bound='at_most'))


def _closed(spec: Doc, over: bool) -> Doc | None:
    kinds = [a['type'] for a in spec['agents'] if a['type'] not in ('pedestrian', 'rsu')]
    if len(kinds) < 2 or spec.get('counts') or spec['world']['traffic_density'] is not None:
        return None
    number = float(len(kinds) - 1 if over else len(kinds))
    spec['counts'] = [{'id': 'pushed', 'kind': 'vehicle', 'value': _said(spec, number, '1')}]
    return spec


def _moving_hover(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'hover')
    target = (mission or {}).get('target') or ''
    if mission is None or len(spec['missions']) > 1 or spec['conditions'] or spec['events']:
        return None
    if target in {a['id'] for a in spec['agents']}:
        return None
    op, value = ('>=', 6.0) if over else ('<=', 15.0)
    return _asks(spec, 'speed', [mission['uav']], op, _said(spec, value, 'm/s'))


def _radio(spec: Doc, over: bool) -> Doc | None:
    link = next(iter(spec['links']), None)
    mission = next((m for m in spec['missions'] if m['mode'] == 'track'), None)
    if link is None or mission is None or len(spec['missions']) > 1 or len(spec['links']) > 1:
        return None
    if {link['sender'], link['receiver']} != {mission['uav'], mission['target']}:
        return None
    sends = [e for e in spec['events'] if (e.get('action') or {}).get('sender') == mission['uav']]
    if len(sends) != 1 or spec['conditions'] or _stated(mission.get('standoff_m')):
        return None
    if len(spec['events']) > 1 or _stated(spec['world'].get('duration_s')) or spec.get('orders'):
        return None
    # It is sent before the drone lands: then it may be as near as it likes.
    sends[0] |= {'trigger': {'on': 'time', 'at_s': _said(spec, 50.0, 's')}, 'delay_s': None}
    mission |= {'altitude_m': _said(spec, 60.0, 'm'), 'duration_s': _said(spec, 90.0, 's')}
    link['range_m'] = _said(spec, 45.0 if over else 130.0, 'm')
    return spec


def _late(spec: Doc, over: bool) -> Doc | None:
    mission = _mission(spec, 'hover') or _mission(spec, 'track')
    if mission is None or not _stated(mission['altitude_m']) or spec['conditions']:
        return None
    altitude = mission['altitude_m']['value']
    if altitude < 25.0 or mission['altitude_m'].get('bound', 'exactly') != 'exactly':
        return None
    due = _said(spec, altitude / 5.0 * 0.9 if over else 40.0 + altitude, 's', bound='at_most')
    number = _said(spec, altitude - 0.5, 'm', bound='at_least')
    return _asks(spec, 'altitude', [mission['uav']], '>=', number, by_s=due)


def _separation(spec: Doc, over: bool) -> Doc | None:
    uavs = [u['id'] for u in spec['uavs']]
    if len(uavs) != 2 or spec['conditions'] or spec['events']:
        return None
    if any(m['mode'] != 'track' for m in spec['missions']):
        return None
    if any(_stated(m['altitude_m']) or _stated(m.get('standoff_m')) for m in spec['missions']):
        return None
    op, value = ('<=', 4.0) if over else ('>=', 6.0)
    return _asks(spec, 'separation', uavs, op, _said(spec, value, 'm'))


PUSHES = (
    Push('altitude', ('altitude_limit',), _altitude),
    Push('standoff', ('standoff',), _standoff),
    Push('wind', ('speed_limit',), _wind),
    Push('endurance', ('endurance',), _endurance),
    Push('route-speed', ('speed_limit',), _route_speed),
    Push('pursuit', ('speed_limit',), _pursuit),
    Push('sensing', ('sensing_range',), _sensing),
    Push('horizon', ('temporal_contradiction',), _horizon),
    Push('altitude-bounds', ('spatial_contradiction',), _altitude_bounds),
    Push('distance-bounds', ('spatial_contradiction',), _distance_bounds),
    Push('closed', ('count',), _closed),
    Push('moving-hover', ('spatial_contradiction',), _moving_hover),
    Push('radio', ('comm_range',), _radio),
    Push('late', ('temporal_contradiction',), _late),
    Push('separation', ('separation',), _separation),
)
