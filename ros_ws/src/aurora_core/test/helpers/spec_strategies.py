# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Hypothesis strategies: any specification that the schema allows, with every field in use."""

from __future__ import annotations

import typing
from typing import Any

from hypothesis import strategies as st

from aurora_core.spec.parameter import Bound, Provenance, Unit
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import AgentAction, ScenarioSpec
from aurora_core.spec.seed import SEED_MAX
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    ClauseStatus,
    LinkOcclusion,
    MissionMode,
    Pattern,
    Place,
    Relation,
    RelativeWind,
    Role,
    Side,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

_Document = dict[str, Any]
_NUMBERS = st.floats(allow_nan=False, allow_infinity=False, width=64)
_TEXT = st.text(st.characters(exclude_categories=['Cs'], exclude_characters='\x00'), max_size=20)
_PLACES = st.sampled_from([*(p.value for p in Place), 'landmark:City Hall', 'landmark:Brücke 7'])
_OPS = st.sampled_from(['<=', '<', '>=', '>', '=='])
_AGENT_ACTIONS = st.sampled_from(typing.get_args(AgentAction.model_fields['do'].annotation))


class _Scene:
    """Draws one specification; every reference is to something that is there."""

    def __init__(self, draw: st.DrawFn) -> None:
        self.draw = draw
        self.prompt = draw(_TEXT) + 'p'
        self.agents = self._ids('agent', 4)
        self.uavs = self._ids('uav', 3)
        self.missions = [f'm{k}' for k in range(draw(st.integers(0, 4)))] if self.uavs else []
        self.flown = {m: draw(st.sampled_from(self.uavs)) for m in self.missions}
        self.links = self._ids('link', 2) if len(self.bodies) > 1 else []
        self.events = self._ids('e', 3)

    def _ids(self, stem: str, most: int) -> list[str]:
        numbers = self.draw(st.sets(st.integers(0, 99), max_size=most))
        return [f'{stem}{k}' for k in sorted(numbers, key=lambda k: -k)]

    @property
    def bodies(self) -> list[str]:
        return [*self.agents, *self.uavs]

    def whole(self) -> _Document:
        return {
            'prompt': self.prompt,
            'world': self.world(),
            'agents': [self.agent(k, name) for k, name in enumerate(self.agents)],
            'uavs': [
                {'id': u, 'group': self.maybe(st.just('swarm')), **self.span()} for u in self.uavs
            ],
            'missions': [self.mission(m) for m in self.missions],
            'links': [self.link(name) for name in self.links],
            'events': [{'id': e, **self.event(e)} for e in self.events],
            'conditions': self.some('c', self.condition, self.bodies),
            'orders': self.some('o', self.order, self.moments[1:]),
            'prohibitions': self.some('p', self.prohibition, ['always']),
            'clauses': [self.clause() for _ in range(self.draw(st.integers(0, 2)))],
        }

    # -- pieces ----------------------------------------------------------------------------------

    def some(self, stem: str, make: Any, needs: list[str]) -> list[_Document]:
        most = 3 if needs else 0
        return [{'id': f'{stem}{k}', **make()} for k in range(self.draw(st.integers(0, most)))]

    @property
    def moments(self) -> list[str]:
        return [*self.events, *self.missions]

    def maybe(self, strategy: st.SearchStrategy[Any]) -> Any:
        return self.draw(st.none() | strategy)

    def span_value(self) -> _Document:
        start = self.draw(st.integers(0, len(self.prompt) - 1))
        return {'start': start, 'end': self.draw(st.integers(start + 1, len(self.prompt)))}

    def span(self) -> _Document:
        return {'span': self.span_value() if self.draw(st.booleans()) else None}

    def number(self, unit: Unit) -> _Document:
        low, value, high = sorted(self.draw(st.tuples(_NUMBERS, _NUMBERS, _NUMBERS)))
        provenance = self.draw(st.sampled_from(Provenance))
        stated = provenance is Provenance.EXPLICIT
        if stated:
            value = self.draw(_NUMBERS)
        return {
            'value': value,
            'unit': unit,
            'low': low,
            'high': high,
            'provenance': provenance,
            'span': self.span_value() if stated else self.span()['span'],
            'bound': self.draw(st.sampled_from(Bound)),
            'approximate': self.draw(st.booleans()),
        }

    def maybe_number(self, unit: Unit) -> _Document | None:
        return self.number(unit) if self.draw(st.booleans()) else None

    def body(self) -> str:
        return self.draw(st.sampled_from(self.bodies))

    def anyone(self) -> str:
        """Return a body or a place."""
        return self.draw(st.sampled_from(self.bodies) | _PLACES if self.bodies else _PLACES)

    def other_than(self, name: str | None) -> str:
        choices = [b for b in self.bodies if b != name]
        return self.draw(st.sampled_from(choices) | _PLACES if choices else _PLACES)

    def two_bodies(self) -> tuple[str, str]:
        first, second = self.draw(st.permutations(self.bodies))[:2]
        return first, second

    # -- elements --------------------------------------------------------------------------------

    def world(self) -> _Document:
        return {
            'map_name': self.draw(_TEXT),
            'weather': self.draw(st.sampled_from(Weather)),
            'weather_span': self.span()['span'],
            'time_of_day': self.draw(st.sampled_from(TimeOfDay)),
            'time_of_day_span': self.span()['span'],
            'traffic_density': self.maybe(st.sampled_from(TrafficDensity)),
            'duration_s': self.maybe_number(Unit.SECOND),
            'wind_mps': self.maybe_number(Unit.METRE_PER_SECOND),
            'wind_from_deg': self.maybe_number(Unit.DEGREE),
            'wind': self.maybe(st.sampled_from(RelativeWind)),
            'wind_span': self.span()['span'],
            'seed': self.maybe(st.integers(0, SEED_MAX)),
            **self.span(),
        }

    def agent(self, index: int, name: str) -> _Document:
        return {
            'id': name,
            'type': self.draw(st.sampled_from(AgentType)),
            'role': self.draw(
                st.sampled_from([r for r in Role if r is not Role.EGO or index == 0])
            ),
            'group': self.maybe(st.just('cars')),
            'placements': [self.placement() for _ in range(self.draw(st.integers(0, 2)))],
            'behaviors': [self.behavior() for _ in range(self.draw(st.integers(0, 2)))],
            **self.span(),
        }

    def placement(self) -> _Document:
        return {
            'relation': self.draw(st.sampled_from(Relation)),
            'of': self.anyone() if self.draw(st.booleans()) else None,
            'distance_m': self.maybe_number(Unit.METRE),
            'bearing_deg': self.maybe_number(Unit.DEGREE),
            'kept_in_motion': self.draw(st.booleans()),
            **self.span(),
        }

    def behavior(self) -> _Document:
        return {
            'kind': self.draw(st.sampled_from(BehaviorKind)),
            'target': self.anyone() if self.draw(st.booleans()) else None,
            'speed_mps': self.maybe_number(Unit.METRE_PER_SECOND),
            'closing_from_m': self.maybe_number(Unit.METRE),
            **self.span(),
        }

    def mission(self, name: str) -> _Document:
        mode = self.draw(st.sampled_from(MissionMode))
        route, track = mode is MissionMode.NAVIGATE, mode is MissionMode.TRACK
        size = (self.number(Unit.METRE), self.number(Unit.METRE))
        pattern = self.draw(st.sampled_from(Pattern)) if route else None
        return {
            'id': name,
            'uav': self.flown[name],
            'mode': mode,
            'target': self.other_than(self.flown[name])
            if track or self.draw(st.booleans())
            else None,
            'target_inferred': self.draw(st.booleans()),
            'altitude_m': self.number(Unit.METRE),
            'standoff_m': self.number(Unit.METRE) if track else self.maybe_number(Unit.METRE),
            'bearing_deg': self.maybe_number(Unit.DEGREE),
            'side': self.maybe(st.sampled_from(Side)) if track else None,
            'duration_s': self.maybe_number(Unit.SECOND) if route else self.number(Unit.SECOND),
            'pattern': pattern,
            'size_m': self.maybe(st.just(size)),
            'radius_m': self.maybe_number(Unit.METRE),
            'waypoint_count': self.maybe_number(Unit.ONE),
            'turns': self.maybe_number(Unit.ONE) if pattern is Pattern.ORBIT else None,
            'speed_mps': self.number(Unit.METRE_PER_SECOND) if route else None,
            'dwell_s': self.maybe_number(Unit.SECOND) if route else None,
            'over_streets': self.draw(st.booleans()),
            'ends_in_flight': self.draw(st.booleans()),
            **self.span(),
        }

    def link(self, name: str) -> _Document:
        sender, receiver = self.two_bodies()
        return {
            'id': name,
            'sender': sender,
            'receiver': receiver,
            'loss': self.number(Unit.ONE),
            'latency_s': self.number(Unit.SECOND),
            'range_m': self.maybe_number(Unit.METRE),
            'retransmissions': self.number(Unit.ONE),
            'retransmission_interval_s': self.number(Unit.SECOND),
            'occlusion': self.draw(st.sampled_from(LinkOcclusion)),
            **self.span(),
        }

    def event(self, name: str) -> _Document:
        return {
            'trigger': self.trigger(name) if self.draw(st.booleans()) else None,
            'action': self.action() if self.draw(st.booleans()) else None,
            'delay_s': self.maybe_number(Unit.SECOND),
            **self.span(),
        }

    def trigger(self, event: str) -> _Document:
        kinds = ['time']
        others = [e for e in self.events if e != event]
        kinds += ['event_done'] if others else []
        if self.bodies:
            kinds += ['distance_below', 'distance_above', 'arrives', 'message_received']
            kinds += ['speed_below', 'speed_above']
        if self.uavs:
            kinds += ['altitude_reached', 'visible', 'occluded', 'mission_done']
        on = self.draw(st.sampled_from(kinds))
        uav = self.draw(st.sampled_from(self.uavs)) if self.uavs else ''
        fields: _Document = {}
        if on == 'time':
            fields = {'at_s': self.number(Unit.SECOND)}
        elif on == 'event_done':
            fields = {'event': self.draw(st.sampled_from(others))}
            fields['after_s'] = self.maybe_number(Unit.SECOND)
        elif on.startswith('distance'):
            fields = {'a': self.body(), 'b': self.anyone(), 'value_m': self.number(Unit.METRE)}
        elif on.startswith('speed'):
            fields = {'who': self.body(), 'value_mps': self.number(Unit.METRE_PER_SECOND)}
        elif on == 'arrives':
            fields = {'who': self.body(), 'place': self.draw(_PLACES)}
        elif on == 'message_received':
            by = self.body()
            senders = [b for b in self.bodies if b != by]
            fields = {
                'by': by,
                'sender': self.maybe(st.sampled_from(senders)) if senders else None,
            }
        elif on == 'altitude_reached':
            fields = {'uav': uav, 'value_m': self.number(Unit.METRE)}
        elif on == 'mission_done':
            fields = {'uav': uav}
        else:
            fields = {'observer': uav, 'target': self.other_than(uav)}
        return {'on': on, **fields}

    def action(self) -> _Document | None:
        kinds = ['agent'] if self.agents else []
        kinds += ['send_message'] if len(self.bodies) > 1 else []
        kinds += ['land', 'return_home', 'ascend'] if self.uavs else []
        kinds += ['change_mission'] if self.missions else []
        if not kinds:
            return None
        do = self.draw(st.sampled_from(kinds))
        if do == 'agent':
            return {
                'do': self.draw(_AGENT_ACTIONS),
                'agent': self.draw(st.sampled_from(self.agents)),
                'value_mps': self.maybe_number(Unit.METRE_PER_SECOND),
            }
        if do == 'send_message':
            sender, receiver = self.two_bodies()
            return {'do': do, 'sender': sender, 'receiver': receiver}
        if do == 'change_mission':
            mission = self.draw(st.sampled_from(self.missions))
            return {'do': do, 'uav': self.flown[mission], 'mission': mission}
        altitude = self.number(Unit.METRE) if do == 'ascend' else None
        return {'do': do, 'uav': self.draw(st.sampled_from(self.uavs)), 'altitude_m': altitude}

    def condition(self) -> _Document:
        quantity = self.draw(st.sampled_from(sorted(STATED_QUANTITIES)))
        of = [*self.bodies, *self.events, *self.missions, *self.links]
        return {
            'quantity': quantity,
            'of': self.draw(st.lists(st.sampled_from(of) | _PLACES, min_size=1, max_size=2)),
            'op': self.draw(_OPS),
            'value': self.number(STATED_QUANTITIES[quantity]),
            'hold_s': self.maybe_number(Unit.SECOND),
            'by_s': self.maybe_number(Unit.SECOND),
            'fraction': self.maybe_number(Unit.ONE),
            **self.span(),
        }

    def order(self) -> _Document:
        first, then = self.draw(st.permutations(self.moments))[:2]
        within = self.maybe_number(Unit.SECOND)
        return {'first': first, 'then': then, 'within_s': within, **self.span()}

    def prohibition(self) -> _Document:
        kinds = ['world', 'agent', 'mission', 'event']
        kinds += ['placement', 'behavior'] if self.agents else []
        kinds += ['link'] if len(self.bodies) > 1 else []
        kinds += ['condition'] if self.bodies else []
        kinds += ['order'] if len(self.moments) > 1 else []
        kind = self.draw(st.sampled_from(kinds))
        fields: _Document = {}
        if kind == 'world':
            fields = self.draw(
                st.sampled_from(Weather).map(lambda v: {'weather': v})
                | st.sampled_from(TimeOfDay).map(lambda v: {'time_of_day': v})
                | st.sampled_from(TrafficDensity).map(lambda v: {'traffic_density': v})
                | _TEXT.map(lambda v: {'map_name': v})
            )
        elif kind == 'agent':
            fields = {'type': self.draw(st.sampled_from([*AgentType, 'uav']))}
        elif kind == 'mission':
            uav = self.maybe(st.sampled_from(self.uavs)) if self.uavs else None
            fields = {'uav': uav, 'mode': self.draw(st.sampled_from(MissionMode))}
            fields['target'] = self.other_than(uav) if self.draw(st.booleans()) else None
        elif kind == 'link':
            fields['sender'], fields['receiver'] = self.two_bodies()
        elif kind in ('placement', 'behavior'):
            part = self.placement() if kind == 'placement' else self.behavior()
            fields = {'agent': self.draw(st.sampled_from(self.agents)), **part}
        elif kind == 'event':
            fields = self.event('')
        elif kind == 'condition':
            fields = self.condition()
        else:
            fields = self.order()
        return {'forbids': kind, **self.span(), **fields}

    def clause(self) -> _Document:
        return {
            'text': self.draw(_TEXT),
            'span': self.span_value(),
            'status': self.draw(st.sampled_from(ClauseStatus)),
            'ids': self.draw(st.lists(_TEXT, max_size=2)),
            'note': self.draw(_TEXT),
        }


@st.composite
def specifications(draw: st.DrawFn) -> ScenarioSpec:
    """Draw a valid specification."""
    return ScenarioSpec.model_validate(_Scene(draw).whole())
