# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A place whose name does not say what it is can be called by what the map says it is."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline

PLACES = {
    'Ateneum': 'museum',
    'Kiasma': 'museum',
    'Otsonkallio': 'school',
    'Erottajan paloasema': 'fire_station',
    'Mercy Hospital': 'building',
    'Haartman': 'hospital',
}
TOWN = ParseContext(
    map_name='town', landmark_names=tuple(PLACES), landmark_kinds=tuple(PLACES.values())
)


@pytest.mark.parametrize(
    ('word', 'name'),
    [
        ('school', 'Otsonkallio'),
        ('fire station', 'Erottajan paloasema'),
        # A name that says it goes before what the map calls another place.
        ('hospital', 'Mercy Hospital'),
    ],
)
def test_the_only_place_of_a_kind_is_meant(word: str, name: str) -> None:
    outcome = parse_offline(f'A drone hovers over the {word} at 60 m for 10 seconds.', TOWN)
    assert outcome.spec is not None
    assert outcome.spec.missions[0].target == f'landmark:{name}'


def test_of_several_one_is_asked_for_and_none_is_refused() -> None:
    prompt = 'A drone hovers over the {} at 60 m for 10 seconds.'
    several = parse_offline(prompt.format('museum'), TOWN)
    assert several.spec is None
    assert several.question is not None
    assert 'Ateneum or Kiasma' in several.question
    (refusal,) = parse_offline(prompt.format('stadium'), TOWN).refusals
    assert refusal.word == 'stadium'
    blind = TOWN.model_copy(update={'landmark_kinds': ()})
    assert parse_offline(prompt.format('school'), blind).refusals
