# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bound of something else, or on the other side, than its sentence says is admitted."""

from __future__ import annotations

import pytest
from unread import unread

_TRACKS = 'A drone tracks a van at 30 m altitude.'


@pytest.mark.parametrize(
    ('said', 'quoted'),
    [
        ('The distance between them is always below 60 m and always above 40 m.', '40 m'),
        ('Its distance to the van is always above 20 m, and always below 60 m.', '60 m'),
        ('The gap between them is never below 20 m and never above 60 m.', '60 m'),
        ('The gap between them is never below 20 m or above 60 m.', '60 m'),
        ('Then it flies to the intersection at least 60 m high.', '60 m high'),
        (
            'The horizontal distance to the van stays below 40 m and must never be below 10 m.',
            '40 m',
        ),
    ],
)
def test_a_bound_of_a_distance_is_none_of_a_height_and_keeps_its_side(
    said: str, quoted: str
) -> None:
    assert any(quoted in text for text in unread(f'{_TRACKS} {said}'))


@pytest.mark.parametrize(
    'said',
    [
        'The gap between them never falls below 20 m nor exceeds 60 m.',
        'It is never more than 60 m from the van.',
        'It must not fly above 60 m or below 20 m.',
        'The distance between them is always above 20 m, and the drone never flies above 60 m.',
        'No drone may come closer than 15 m to the van.',
        'It shouldnt ever sink below 20 m.',
        'It sees the van during more than 90 % of the time.',
    ],
)
def test_a_bound_that_is_read_as_it_stands_is_not_doubted(said: str) -> None:
    assert unread(f'{_TRACKS} {said}') == []
