# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause says and its elements do not is admitted; what they do say is not doubted."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('City Hall', 'Harbor Market'))


def _unread(prompt: str) -> list[str]:
    outcome = parse_offline(prompt, CONTEXT)
    return [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]


_TRACKS = 'A drone tracks a van at 40 m for 30 seconds'
_NEAR = 'when the van comes within 30 m of the ego car'


@pytest.mark.parametrize(
    ('prompt', 'quoted'),
    [
        (f'{_TRACKS} and warns the ego car of a bus after 20 seconds.', 'a bus'),
        (f'{_TRACKS} and reports the stopped truck to the ego car {_NEAR}.', 'the stopped truck'),
        (f'{_TRACKS} and sends its speed to the ego car {_NEAR}.', 'sends its speed'),
        (
            'A drone tracks a van and informs a second drone, which hovers at 60 m, when the van '
            'stops.',
            'hovers at 60 m',
        ),
        (f'{_TRACKS} and no other vehicle comes within 30 m of the van.', 'no other vehicle'),
        (
            'A drone alerts the ego car when a van comes within 30 m of it and climbs to 60 m.',
            'climbs',
        ),
        ('A drone hovers over City Hall at 50 m for 30 s and watches a bus.', 'watches a bus'),
        ('Two drones hover at 40 m and 60 m for 20 s, the first one at 60 m.', 'the first one'),
        ('A drone alerts the ego car while it climbs to 60 m and then tracks a van.', 'alerts'),
        ('A van stops and lets a pedestrian cross while a drone tracks the van.', 'lets a'),
        (f'A drone tracks a van and alerts the ego car at Harbor Market {_NEAR}.', 'at Harbor'),
    ],
)
def test_what_no_element_says_is_admitted(prompt: str, quoted: str) -> None:
    assert any(quoted in text or text in quoted for text in _unread(prompt))


@pytest.mark.parametrize(
    'prompt',
    [
        f'{_TRACKS} and alerts the ego car {_NEAR}.',
        f'{_TRACKS} and reports the van to the ego car {_NEAR}.',
        'When a van comes within 30 m of the ego car, a drone alerts it and climbs to 60 m.',
        'A drone hovers over City Hall at 50 m for 30 s and then tracks a bus for 20 s.',
        'Two UAVs track a truck, one at 25 m and the other at 35 m.',
        'A bus, which a police car is following, drives at 10 m/s.',
        'Drone B hovers over City Hall at 55 m, drone A tracks a truck at 40 m.',
        'The ego car is sandwiched between a truck 15 m ahead and a bus 20 m behind.',
        'A pedestrian stands beside a roadside unit at Harbor Market.',
    ],
)
def test_what_elements_say_is_not_doubted(prompt: str) -> None:
    assert _unread(prompt) == []
