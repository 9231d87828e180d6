# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words that ask for something are admitted unless something carries them."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('City Hall',))


def _unread(prompt: str) -> list[str]:
    outcome = parse_offline(prompt, CONTEXT)
    return [c.text for c in outcome.clauses if c.status is ClauseStatus.NOT_ENCODED]


@pytest.mark.parametrize(
    ('prompt', 'quoted'),
    [
        ('Two drones hover at 30 m and 50 m for 20 s, one after the other.', 'one after'),
        ('Two drones hover at 30 m and 50 m for 20 s and land together.', 'together'),
        ('A drone hovers at 40 m for 20 s, lands and takes off again.', 'takes off'),
        ('A drone hovers at 40 m for 20 s, lands, waits 10 s and takes off.', 'lands, waits'),
        ('A drone lands and then hovers over City Hall at 40 m.', 'lands and then hovers'),
        ('A drone hovers at 40 m for 20 s and repeats this.', 'repeats this'),
        ('A drone hovers at 40 m for 20 s, and so does another one at 60 m.', 'so does another'),
        ('A drone starts at 40 m and hovers over City Hall for 20 s.', 'starts at 40 m'),
        ('A drone, already in the air, hovers over City Hall.', 'already in the air'),
        ('A drone starts on a rooftop and hovers over City Hall.', 'on a rooftop'),
        ('A drone hovers over City Hall for 20 s and lands on the road.', 'lands on the road'),
        ('On a foggy morning a drone hovers over City Hall.', 'morning'),
        ('A drone tracks a speeding car.', 'speeding'),
        ('A drone tracks a slow bus.', 'slow'),
        ('A car follows a bus closely.', 'closely'),
        ('A car drives at full speed.', 'full speed'),
        ('A car drives straight ahead; a drone tracks it.', 'straight ahead'),
        ('A car accelerates by 4 m/s after 20 s.', 'by 4 m/s'),
        ('A van overtakes a bus; afterwards the bus stops.', 'the bus stops'),
        ('A van overtakes a bus before the bus stops.', 'before the bus stops'),
        ('A car changes into the left lane after 10 s.', 'into the left'),
        ('A bus stops and a car stops, in this order.', 'in this order'),
        ('A drone is the only vehicle in the air and hovers over City Hall.', 'only vehicle'),
    ],
)
def test_admitted(prompt: str, quoted: str) -> None:
    assert any(quoted in text for text in _unread(prompt)), _unread(prompt)


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone hovers over City Hall, tracks a bus for 20 s, then hovers over City Hall again.',
        'A police car follows a speeding motorcycle, which drives at 20 m/s.',
        'A van tailgates the ego car closely.',
        'A foggy evening; a drone hovers over City Hall.',
        'A drone hovers over City Hall, tracks a bus and lands, in this order.',
        'A drone hovers over City Hall for 20 s and then lands.',
        'A car drives at most 15 m behind a bus at all times.',
        'A car always stays 20 m behind a bus.',
        'A car follows a bus at a constant distance of 20 m.',
        'A drone tracks a bus at 40 m the whole time.',
        'The bus brakes after 20 s; afterwards the drone lands. The drone hovers over City Hall.',
    ],
)
def test_what_something_carries_is_read(prompt: str) -> None:
    assert _unread(prompt) == []
