# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an event waits for, in the words that people choose for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.spec.scenario import AgentAction, ScenarioSpec

BEFORE = (
    'A van follows a bus. A drone hovers at 40 m over the intersection and sends the bus '
    'a message at 3 s.'
)
VISIBLE = {'on': 'visible', 'observer': 'uav1', 'target': 'van1'}
OCCLUDED = {'on': 'occluded', 'observer': 'uav1', 'target': 'van1'}
RECEIVED = {'on': 'message_received', 'by': 'bus1', 'sender': 'uav1'}
DONE = {'on': 'mission_done', 'uav': 'uav1'}
AT_20 = {'on': 'time', 'at_s': 20.0}
NEAR = {'on': 'distance_below', 'a': 'van1', 'b': 'bus1', 'value_m': 30.0}
CAUSES: list[tuple[str, dict[str, Any]]] = [
    ('when 20 s have passed since the start', AT_20),
    ('when the clock shows 20 s', AT_20),
    ('once twenty seconds of the run are over', AT_20),
    ("when the van comes into the drone's view", VISIBLE),
    ("when the van is in the drone's field of view", VISIBLE),
    ('as soon as the drone has the van on camera', VISIBLE),
    ("when the van shows up on the drone's camera", VISIBLE),
    ('when the drone catches sight of the van', VISIBLE),
    ('when the drone can no longer see the van', OCCLUDED),
    ("when the drone's view of the van is blocked", OCCLUDED),
    ("when the van disappears from the drone's view", OCCLUDED),
    ("once the van is out of the drone's sight", OCCLUDED),
    ('when the bus gets the message from the drone', RECEIVED),
    ("when the drone's message reaches the bus", RECEIVED),
    ('when the warning has come in at the bus', RECEIVED),
    ("when the drone's mission is over", DONE),
    ('when the drone has finished its hover', DONE),
    (
        'when the van passes the crosswalk',
        {'on': 'arrives', 'who': 'van1', 'place': 'crosswalk'},
    ),
    ('the moment the van is inside a 30 m radius of the bus', NEAR),
    ('when the distance that separates the van from the bus shrinks to 30 m', NEAR),
    ('when the van comes as near as 30 m to the bus', NEAR),
    ('when the van gets nearer to the bus than 30 m', NEAR),
    ('when less than 30 m are left between the van and the bus', NEAR),
]


def plain(trigger: Any) -> dict[str, Any]:
    told = trigger.model_dump(exclude_none=True)
    return {k: v['value'] if isinstance(v, dict) else v for k, v in told.items()}


@pytest.mark.parametrize(('cause', 'meant'), CAUSES)
@pytest.mark.parametrize('form', ['{0}, the bus accelerates.', 'The bus accelerates {0}.'])
def test_a_cause(
    cause: str, meant: dict[str, Any], form: str, read_prompt: Callable[..., ScenarioSpec]
) -> None:
    told = form.format(cause)
    spec = read_prompt(f'{BEFORE} {told[0].upper()}{told[1:]}')
    (event,) = [e for e in spec.events if isinstance(e.action, AgentAction)]
    assert plain(event.trigger) == meant


@pytest.mark.parametrize(
    'cause',
    [
        'when the van hums past the crosswalk',
        'when the rain has gone from the view of the van',
        'when the drone has a van',
    ],
)
def test_a_word_without_a_place_keeps_a_clause_from_being_a_cause(
    cause: str, read_prompt: Callable[..., ScenarioSpec]
) -> None:
    spec = read_prompt(f'{BEFORE} The bus accelerates {cause}.')
    events = [e for e in spec.events if isinstance(e.action, AgentAction)]
    assert all(e.trigger is None for e in events)
