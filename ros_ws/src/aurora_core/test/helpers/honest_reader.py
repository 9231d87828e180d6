# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The reading that an honest model would give: a specification told in quotes of its prompt."""

from __future__ import annotations

from typing import Any

from aurora_core.spec.parameter import Parameter, Provenance, Span
from aurora_core.spec.prohibitions import ForbiddenBehavior
from aurora_core.spec.scenario import ScenarioSpec, Trigger
from aurora_core.spec.vocabulary import ClauseStatus


def honest_reading(spec: ScenarioSpec) -> dict[str, Any]:
    """Return the reading of a specification."""

    def quote(span: Span | None) -> str:
        return spec.prompt[span.start : span.end] if span is not None else spec.prompt

    def number(value: Parameter | None) -> dict[str, Any] | None:
        if value is None or value.provenance is Provenance.DEFAULT:
            return None
        stated = value.provenance is Provenance.EXPLICIT
        return {
            'value': value.value,
            'unit': value.unit.value,
            'provenance': value.provenance.value,
            'quote': quote(value.span) if stated else '',
        }

    def numbers(element: Any, *names: str) -> dict[str, Any]:
        return {name: number(getattr(element, name)) for name in names}

    def trigger(cause: Trigger) -> dict[str, Any]:
        fields = dict(cause)
        subject = next(
            (fields[n] for n in ('a', 'uav', 'observer', 'who', 'by') if n in fields), None
        )
        other = next(
            (fields[n] for n in ('b', 'target', 'place', 'sender', 'event') if n in fields), None
        )
        value = next((v for v in fields.values() if isinstance(v, Parameter)), None)
        return {'on': cause.on, 'subject': subject, 'other': other, 'value': number(value)}

    def action(effect: Any) -> dict[str, Any]:
        fields = dict(effect)
        subject = next(fields[n] for n in ('sender', 'agent', 'uav') if n in fields)
        value = next((v for v in fields.values() if isinstance(v, Parameter)), None)
        return {
            'do': effect.do,
            'subject': subject,
            'receiver': fields.get('receiver'),
            'mission': fields.get('mission'),
            'value': number(value),
        }

    world = spec.world
    # The scene rules add what no clause says.
    cited = {one for clause in spec.clauses for one in clause.ids}
    return {
        'world': {
            'weather': world.weather.value if world.weather_span else None,
            'time_of_day': world.time_of_day.value if world.time_of_day_span else None,
            'traffic_density': world.traffic_density.value if world.traffic_density else None,
            'duration_s': number(world.duration_s),
        },
        'agents': [
            {
                'id': a.id,
                'type': a.type.value,
                'quote': quote(a.span),
                'placements': [
                    {
                        'relation': p.relation.value,
                        'of': p.of,
                        **numbers(p, 'distance_m', 'bearing_deg'),
                        'kept_in_motion': p.kept_in_motion,
                        'quote': quote(p.span),
                    }
                    for p in a.placements
                ],
                'behaviors': [
                    {
                        'kind': b.kind.value,
                        'target': b.target,
                        **numbers(b, 'speed_mps', 'closing_from_m', 'duration_s'),
                        'quote': quote(b.span),
                    }
                    for b in a.behaviors
                ],
            }
            for a in spec.agents
        ],
        'uavs': [{'id': u.id, 'quote': quote(u.span)} for u in spec.uavs],
        'missions': [
            {
                'id': m.id,
                'uav': m.uav,
                'mode': m.mode.value,
                'target': None if m.target_inferred else m.target,
                **numbers(m, 'altitude_m', 'standoff_m', 'bearing_deg', 'duration_s', 'radius_m'),
                **numbers(m, 'waypoint_count', 'turns', 'speed_mps'),
                'length_m': number(m.size_m[0]) if m.size_m else None,
                'width_m': number(m.size_m[1]) if m.size_m and m.size_m[1].value else None,
                'side': None if m.side is None else m.side.value,
                'pattern': m.pattern.value if m.pattern else None,
                'over_streets': m.over_streets,
                'ends_in_flight': m.ends_in_flight,
                'quote': quote(m.span),
            }
            for m in spec.missions
            if m.id in cited
        ],
        'links': [
            {
                'id': k.id,
                'sender': k.sender,
                'receiver': k.receiver,
                **numbers(k, 'loss', 'latency_s', 'range_m', 'retransmissions', 'rate_hz'),
                'quote': quote(k.span),
            }
            for k in spec.links
        ],
        'events': [
            {
                'id': e.id,
                'trigger': trigger(e.trigger),
                'action': action(e.action),
                'delay_s': number(e.delay_s),
                'quote': quote(e.span),
            }
            for e in spec.events
            if e.trigger is not None and e.action is not None
        ],
        'conditions': [
            {
                'id': c.id,
                'quantity': c.quantity,
                'of': list(c.of),
                'op': c.op,
                'value': number(c.value)
                or {'value': c.value.value, 'unit': c.value.unit.value, 'provenance': 'inferred'},
                **numbers(c, 'hold_s', 'by_s', 'fraction'),
                'quote': quote(c.span),
            }
            for c in spec.conditions
        ],
        'counts': [
            {
                'id': c.id,
                'kind': str(c.kind),
                'value': number(c.value)
                or {'value': c.value.value, 'unit': c.value.unit.value, 'provenance': 'inferred'},
                'quote': quote(c.span),
            }
            for c in spec.counts
        ],
        'forbidden': [
            {
                'id': f.id,
                'agent': f.agent,
                'kind': f.kind.value,
                'target': f.target,
                'quote': quote(f.span),
            }
            for f in spec.prohibitions
            if isinstance(f, ForbiddenBehavior)
        ],
        'clauses': [
            {
                'quote': c.text,
                'status': c.status.value,
                'ids': list(c.ids) if c.status is ClauseStatus.ENCODED else [],
                'note': c.note[:300],
            }
            for c in spec.clauses
        ],
    }
