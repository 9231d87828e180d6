# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""docs/understood.md says of every word of the vocabulary what the code does with it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any, cast, get_args

import pytest

from aurora_core.conditions.capabilities import unsupported
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import (
    AgentAction,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    UavAction,
)
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Pattern,
    Place,
    Relation,
    RelativeWind,
    Side,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

PAGE = (Path(__file__).parents[5] / 'docs' / 'understood.md').read_text(encoding='utf-8')
ACTIONS = tuple(
    do
    for kind in (AgentAction, UavAction, SendMessage)
    for do in get_args(kind.model_fields['do'].annotation)
)


def _rows(heading: str) -> dict[str, str]:
    """Return the words of the first column of a table, each with its second column."""
    lines = PAGE.splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith(f'| {heading} |'))
    found: dict[str, str] = {}
    for line in lines[start + 2 :]:
        if not line.startswith('|'):
            break
        words, said = (cell.strip() for cell in line.strip('|').split('|'))
        found |= dict.fromkeys((word.strip() for word in words.split(',')), said)
    return found


@dataclass(frozen=True, kw_only=True)
class _Everywhere:
    """A grounding that everything could be placed in."""

    agents: tuple[GroundAgent, ...]
    unsupported: tuple[str, ...] = ()


def _is_carried_out(
    behaviors: tuple[dict[str, Any], ...] = (),
    events: tuple[dict[str, Any], ...] = (),
    *,
    on_foot: bool = False,
) -> bool:
    who = 'pedestrian' if on_foot else 'car'
    spec = ScenarioSpec.model_validate(
        {
            'prompt': 'x',
            'agents': [
                {'id': 'ego', 'type': 'car', 'role': 'ego'},
                {'id': 'body1', 'type': who, 'behaviors': behaviors},
            ],
            'uavs': [{'id': 'uav1'}],
            'missions': [
                {
                    'id': 'm1',
                    'uav': 'uav1',
                    'mode': 'hover',
                    'altitude_m': _number(30, 'm'),
                    'duration_s': _number(5, 's'),
                }
            ],
            'events': events,
        }
    )
    return unsupported(spec, cast(GroundedScenario, _Everywhere(agents=spec.agents))) == ()


def _number(value: float, unit: str) -> dict[str, Any]:
    return {'value': value, 'unit': unit, 'low': 0, 'high': 120, 'provenance': 'default'}


def _action(do: str) -> dict[str, Any]:
    if do == 'send_message':
        return {'do': do, 'sender': 'uav1', 'receiver': 'body1'}
    if do not in get_args(UavAction.model_fields['do'].annotation):
        return {'do': do, 'agent': 'body1'}
    more: dict[str, Any] = {'altitude_m': _number(50, 'm')} if do == 'ascend' else {}
    return {'do': do, 'uav': 'uav1', **more, **({'mission': 'm1'} if 'mission' in do else {})}


def test_every_behaviour_stands_where_it_belongs() -> None:
    rows = _rows('behaviour of an agent')
    assert set(rows) == {kind.value for kind in BehaviorKind}
    for kind, said in rows.items():
        on_foot = 'on foot' in said
        done = _is_carried_out(behaviors=({'kind': kind, 'target': 'ego'},), on_foot=on_foot)
        assert said.startswith('yes') == done, kind


def test_every_action_stands_where_it_belongs() -> None:
    rows = _rows('action of an event')
    assert set(rows) == set(ACTIONS)
    for do, said in rows.items():
        at = {'on': 'time', 'at_s': _number(5, 's')}
        event = {'id': 'e1', 'trigger': at, 'action': _action(do)}
        done = _is_carried_out(events=(event,), on_foot='on foot' in said)
        assert said.startswith('yes') == done, do


@pytest.mark.parametrize(
    'words',
    [
        *(AgentType, MissionMode, Pattern, Side, Place, Relation),
        *(Weather, TimeOfDay, TrafficDensity, RelativeWind),
    ],
)
def test_the_page_knows_the_whole_vocabulary(words: type[StrEnum]) -> None:
    said = ','.join(_rows('understood').values()).replace(';', ',').replace(' ', '')
    assert {word.value for word in words} <= set(said.split(','))


def test_the_page_knows_every_quantity() -> None:
    assert set(STATED_QUANTITIES) == {
        word.strip() for word in _rows('understood')['conditions'].split(',')
    }
