# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What somebody does because of, in spite of or during something is admitted when untied."""

from __future__ import annotations

import pytest
from unread import unread

LANDMARKS = ('City Hall',)


@pytest.mark.parametrize(
    ('prompt', 'quoted'),
    [
        ('A drone tracks a bus and alerts my car when the bus stops. My car brakes.', 'brakes'),
        (
            'A drone tracks a cyclist and calls a taxi when the cyclist stops. The taxi drives to '
            'City Hall.',
            'drives to City Hall',
        ),
        (
            'The ego car sends a message to the drone when it has stopped, and the drone lands.',
            'lands',
        ),
        ('The ego car keeps driving although the drone warns it.', 'keeps driving although'),
        ('The bus stands for 20 seconds while a drone orbits it.', 'while'),
        (
            'A drone hovers for 15 s and a second drone waits on the ground until the first one '
            'has landed.',
            'waits on the ground until',
        ),
        ('When the leading car brakes, the ego car stops within 5 seconds.', 'leading car'),
    ],
)
def test_what_is_tied_to_nothing_is_admitted(prompt: str, quoted: str) -> None:
    assert any(quoted in text for text in unread(prompt, *LANDMARKS))


@pytest.mark.parametrize(
    'prompt',
    [
        'The ego car drives along the main road. A drone tracks a bus and alerts it when the bus '
        'stops.',
        'A drone tracks a bus and alerts the ego car when the bus stops. The ego car then brakes.',
        'The ego car sends a message to the drone at 20 s. When the drone gets it, it lands.',
        'The ego car waits while a drone tracks a bus.',
        'The leading car drives 20 m ahead of the ego car.',
    ],
)
def test_what_is_tied_is_not_doubted(prompt: str) -> None:
    assert unread(prompt, *LANDMARKS) == []
