# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every word of the vocabulary is taken where it belongs, and one letter more is refused."""

from __future__ import annotations

import typing
from collections.abc import Callable, Iterable
from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.spec.parameter import Bound, Provenance, Unit
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, StatedCondition
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    ClauseStatus,
    LinkOcclusion,
    MissionMode,
    Pattern,
    Place,
    Relation,
    Role,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

Scene = dict[str, Any]
_SPAN = {'start': 0, 'end': 1}


def _number(unit: str = 'm', **changes: Any) -> Scene:
    whole = {'value': 1.0, 'unit': unit, 'low': 0.0, 'high': 9.0, 'provenance': 'default'}
    return whole | {'span': _SPAN} | changes


def _scene(**parts: Any) -> Scene:
    bodies = {'agents': [{'id': 'car1', 'type': 'car'}], 'uavs': [{'id': 'uav1'}]}
    return {'prompt': 'x', **bodies, **parts}


def _agent(**parts: Any) -> Scene:
    return _scene(agents=[{'id': 'car1', 'type': 'car', **parts}])


def _mission(**parts: Any) -> Scene:
    whole = {
        'id': 'm1',
        'uav': 'uav1',
        'mode': 'navigate',
        'target': 'car1',
        'pattern': 'line',
        'altitude_m': _number(),
        'standoff_m': _number(),
        'duration_s': _number('s'),
        'speed_mps': _number('m/s'),
    }
    return _scene(missions=[whole | parts])


def _link(**parts: Any) -> Scene:
    whole = {
        'id': 'l1',
        'sender': 'uav1',
        'receiver': 'car1',
        'loss': _number('1'),
        'latency_s': _number('s'),
        'retransmissions': _number('1'),
        'retransmission_interval_s': _number('s'),
    }
    return _scene(links=[whole | parts])


def _condition(**parts: Any) -> Scene:
    whole = {'id': 'c1', 'quantity': 'altitude', 'of': ['uav1'], 'op': '>=', 'value': _number()}
    return _scene(conditions=[whole | parts])


def _forbidden(**parts: Any) -> Scene:
    return _scene(prohibitions=[{'id': 'p1', **parts}])


def _event(**parts: Any) -> Scene:
    return _scene(events=[{'id': 'e1', **parts}, {'id': 'e2'}])


_TRIGGERS: dict[str, Scene] = {
    'distance_below': {'a': 'car1', 'b': 'uav1', 'value_m': _number()},
    'distance_above': {'a': 'car1', 'b': 'crosswalk', 'value_m': _number()},
    'time': {'at_s': _number('s')},
    'altitude_reached': {'uav': 'uav1', 'value_m': _number()},
    'visible': {'observer': 'uav1', 'target': 'car1'},
    'occluded': {'observer': 'uav1', 'target': 'car1'},
    'arrives': {'who': 'car1', 'place': 'intersection'},
    'message_received': {'by': 'car1', 'sender': 'uav1'},
    'speed_below': {'who': 'car1', 'value_mps': _number('m/s')},
    'speed_above': {'who': 'car1', 'value_mps': _number('m/s')},
    'event_done': {'event': 'e2', 'after_s': _number('s')},
    'mission_done': {'uav': 'uav1'},
}
_ACTIONS: dict[str, Scene] = {
    'send_message': {'sender': 'uav1', 'receiver': 'car1'},
    **{
        do: {'agent': 'car1', 'value_mps': _number('m/s')}
        for do in typing.get_args(AgentAction.model_fields['do'].annotation)
    },
    'land': {'uav': 'uav1'},
    'return_home': {'uav': 'uav1'},
    'ascend': {'uav': 'uav1', 'altitude_m': _number()},
    'change_mission': {'uav': 'uav1', 'mission': 'm1'},
}


def _trigger(on: str) -> Scene:
    return _event(trigger={'on': on, **_TRIGGERS.get(on, {})})


def _action(do: str) -> Scene:
    return _event(action={'do': do, **_ACTIONS.get(do, {})}) | {'missions': _mission()['missions']}


def _quantity(word: str) -> Scene:
    unit = STATED_QUANTITIES.get(word, Unit.ONE)
    return _condition(quantity=word, value=_number(unit))


_FORBIDDEN: dict[str, Scene] = {
    'world': {'weather': 'rain'},
    'agent': {'type': 'pedestrian'},
    'placement': {'agent': 'car1', 'relation': 'near', 'of': 'uav1'},
    'behavior': {'agent': 'car1', 'kind': 'overtake'},
    'mission': {'uav': 'uav1', 'mode': 'track', 'target': 'car1'},
    'link': {'sender': 'uav1', 'receiver': 'car1'},
    'event': {'action': {'do': 'land', 'uav': 'uav1'}},
    'order': {'first': 'm1', 'then': 'm2'},
    'condition': {'quantity': 'speed', 'of': ['car1'], 'op': '>', 'value': _number('m/s')},
}


def _forbids(word: str) -> Scene:
    two = _mission()['missions'] + _mission(id='m2')['missions']
    return _forbidden(forbids=word, **_FORBIDDEN.get(word, {})) | {'missions': two}


def _in_unit(unit: str) -> Scene:
    """A number in a field of its unit."""
    places: dict[str, Callable[[], Scene]] = {
        'm': lambda: _mission(altitude_m=_number('m')),
        's': lambda: _mission(duration_s=_number('s')),
        'm/s': lambda: _mission(speed_mps=_number('m/s')),
        'deg': lambda: _mission(bearing_deg=_number('deg')),
        '1': lambda: _mission(waypoint_count=_number('1')),
    }
    return places.get(unit, lambda: _mission(altitude_m=_number(unit)))()


_PLACES: list[tuple[str, Iterable[str], Callable[[str], Scene]]] = [
    ('agent type', AgentType, lambda w: _agent(type=w)),
    ('role', Role, lambda w: _agent(role=w)),
    ('relation', Relation, lambda w: _agent(placements=[{'relation': w}])),
    ('behaviour', BehaviorKind, lambda w: _agent(behaviors=[{'kind': w}])),
    ('weather', Weather, lambda w: _scene(world={'weather': w})),
    ('time of day', TimeOfDay, lambda w: _scene(world={'time_of_day': w})),
    ('traffic', TrafficDensity, lambda w: _scene(world={'traffic_density': w})),
    ('place', Place, lambda w: _mission(target=w)),
    ('mode', MissionMode, lambda w: _mission(mode=w)),
    ('pattern', Pattern, lambda w: _mission(pattern=w)),
    ('occlusion', LinkOcclusion, lambda w: _link(occlusion=w)),
    (
        'clause',
        ClauseStatus,
        lambda w: _scene(clauses=[{'text': 'x', 'span': _SPAN, 'status': w}]),
    ),
    ('provenance', Provenance, lambda w: _mission(altitude_m=_number(provenance=w))),
    ('bound', Bound, lambda w: _mission(altitude_m=_number(bound=w))),
    ('unit', [u for u in Unit if u is not Unit.METRE_PER_SECOND_SQUARED], _in_unit),
    ('quantity', STATED_QUANTITIES, _quantity),
    (
        'comparison',
        typing.get_args(StatedCondition.model_fields['op'].annotation),
        lambda w: _condition(op=w),
    ),
    ('trigger', _TRIGGERS, _trigger),
    ('action', _ACTIONS, _action),
    ('prohibition', _FORBIDDEN, _forbids),
    ('forbidden agent', [*AgentType, 'uav'], lambda w: _forbidden(forbids='agent', type=w)),
    ('forbidden weather', Weather, lambda w: _forbidden(forbids='world', weather=w)),
    ('forbidden time', TimeOfDay, lambda w: _forbidden(forbids='world', time_of_day=w)),
    (
        'forbidden traffic',
        TrafficDensity,
        lambda w: _forbidden(forbids='world', traffic_density=w),
    ),
    ('forbidden mission', MissionMode, lambda w: _forbidden(forbids='mission', mode=w)),
]
_ALL = [
    pytest.param(str(word), make, id=f'{name}: {word}')
    for name, words, make in _PLACES
    for word in words
]


@pytest.mark.parametrize(('word', 'make'), _ALL)
def test_the_word_is_taken_and_one_letter_more_is_refused(
    word: str, make: Callable[[str], Scene]
) -> None:
    assert f"'{word}'" in repr(ScenarioSpec.model_validate(make(word)))
    with pytest.raises(ValidationError):
        ScenarioSpec.model_validate(make(f'{word}x'))
