# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A prompt with the good reading of it, and the judge of readings."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.llm.check import Judgement, judge
from aurora_core.parsing.llm.facts import PromptFacts

CONTEXT = ParseContext(landmark_names=('clock_tower',))
PROMPT = (
    'In fog, a drone tracks a bus from 25 m below 40 m altitude near the clock tower. '
    'When a car comes within 20 m of the bus, the drone warns my car. Two vans circulate.'
)
GOOD: dict[str, Any] = {
    'world': {'weather': 'fog'},
    'agents': [
        {
            'id': 'bus1',
            'type': 'bus',
            'quote': 'a bus',
            'placements': [
                {'relation': 'near', 'of': 'landmark:clock_tower', 'quote': 'near the clock tower'}
            ],
        },
        {'id': 'car1', 'type': 'car', 'quote': 'a car'},
        {'id': 'ego', 'type': 'car', 'quote': 'my car'},
        {
            'id': 'van1',
            'type': 'van',
            'quote': 'Two vans',
            'behaviors': [{'kind': 'circulate', 'quote': 'circulate'}],
        },
        {
            'id': 'van2',
            'type': 'van',
            'quote': 'Two vans',
            'behaviors': [{'kind': 'circulate', 'quote': 'circulate'}],
        },
    ],
    'uavs': [{'id': 'uav1', 'quote': 'a drone'}],
    'missions': [
        {
            'id': 'm1',
            'uav': 'uav1',
            'mode': 'track',
            'target': 'bus1',
            'standoff_m': {'value': 25, 'unit': 'm', 'quote': '25 m'},
            'altitude_m': {'value': 40, 'unit': 'm', 'quote': '40 m'},
            'quote': 'a drone tracks a bus',
        }
    ],
    'events': [
        {
            'id': 'e1',
            'trigger': {
                'on': 'distance_below',
                'subject': 'car1',
                'other': 'bus1',
                'value': {'value': 20, 'unit': 'm', 'quote': 'within 20 m'},
            },
            'action': {'do': 'send_message', 'subject': 'uav1', 'receiver': 'ego'},
            'quote': 'the drone warns my car',
        }
    ],
    'clauses': [
        {'quote': 'In fog', 'status': 'encoded', 'ids': ['world']},
        {
            'quote': 'a drone tracks a bus from 25 m below 40 m altitude near the clock tower',
            'status': 'encoded',
            'ids': ['m1', 'bus1'],
        },
        {
            'quote': 'When a car comes within 20 m of the bus, the drone warns my car',
            'status': 'encoded',
            'ids': ['e1', 'car1', 'ego'],
        },
        {'quote': 'Two vans circulate', 'status': 'encoded', 'ids': ['van1', 'van2']},
    ],
}


@pytest.fixture
def good() -> dict[str, Any]:
    """A reading that says all that the prompt says, free to be changed."""
    return copy.deepcopy(GOOD)


@pytest.fixture(scope='session')
def judged() -> Callable[..., Judgement]:
    """Judge a reading of a prompt, of the one that the good reading is of by default."""

    def judged(reading: dict[str, Any], prompt: str = PROMPT) -> Judgement:
        return judge(json.dumps(reading), PromptFacts(prompt, CONTEXT))

    return judged
