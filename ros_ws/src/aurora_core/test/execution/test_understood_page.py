# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""docs/understood.md says of every word of the vocabulary what the code does with it."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast, get_args

import pytest

from aurora_core.execution.capabilities import NOT_CARRIED_OUT, unsupported
from aurora_core.grounding.grounded import GroundedScenario
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import AgentAction, ScenarioSpec, SendMessage, UavAction
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Pattern,
    Place,
    Relation,
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


def test_every_behaviour_stands_where_it_belongs() -> None:
    rows = _rows('behaviour of an agent')
    assert set(rows) == {kind.value for kind in BehaviorKind}
    undone = {word for word, said in rows.items() if said.startswith('no')}
    assert undone == {kind.value for kind in NOT_CARRIED_OUT}


class _Grounded:
    """A grounding that everything could be placed in."""

    unsupported = ()
    agents = (SimpleNamespace(id='car1'),)


def _is_carried_out(do: str) -> bool:
    action: dict[str, Any] = {'do': do, 'agent': 'car1'}
    if do == 'send_message':
        action = {'do': do, 'sender': 'uav1', 'receiver': 'car1'}
    elif do in get_args(UavAction.model_fields['do'].annotation):
        action = {'do': do, 'uav': 'uav1'}
        altitude = {'value': 50, 'unit': 'm', 'low': 3, 'high': 120, 'provenance': 'inferred'}
        action |= {'altitude_m': altitude} if do == 'ascend' else {}
        action |= {'mission': 'm1'} if do == 'change_mission' else {}
    at = {'value': 5, 'unit': 's', 'low': 0, 'high': 60, 'provenance': 'inferred'}
    height = {'value': 30, 'unit': 'm', 'low': 3, 'high': 120, 'provenance': 'default'}
    mission = {'id': 'm1', 'uav': 'uav1', 'mode': 'hover', 'altitude_m': height, 'duration_s': at}
    spec = ScenarioSpec.model_validate(
        {
            'prompt': 'x',
            'agents': [{'id': 'car1', 'type': 'car'}],
            'uavs': [{'id': 'uav1'}],
            'missions': [mission],
            'events': [{'id': 'e1', 'trigger': {'on': 'time', 'at_s': at}, 'action': action}],
        }
    )
    return not unsupported(spec, cast(GroundedScenario, _Grounded()))


def test_every_action_stands_where_it_belongs() -> None:
    rows = _rows('action of an event')
    assert set(rows) == set(ACTIONS)
    for do, said in rows.items():
        assert said.startswith('yes') == _is_carried_out(do), do


@pytest.mark.parametrize(
    'words',
    [AgentType, MissionMode, Pattern, Place, Relation, Weather, TimeOfDay, TrafficDensity],
)
def test_the_page_knows_the_whole_vocabulary(words: type[StrEnum]) -> None:
    said = ','.join(_rows('understood').values()).replace(';', ',').replace(' ', '')
    assert {word.value for word in words} <= set(said.split(','))


def test_the_page_knows_every_quantity() -> None:
    assert set(STATED_QUANTITIES) == {
        word.strip() for word in _rows('understood')['conditions'].split(',')
    }
