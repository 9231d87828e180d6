# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The bundled real city: its licence stands with it, it is small, and prompts find their place."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.map_records import load_measured_map
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec


@pytest.fixture(scope='module')
def helsinki() -> MapModel:
    return load_map('helsinki')


def test_its_licence_stands_with_it(helsinki: MapModel) -> None:
    assert helsinki.licence == 'ODbL-1.0'
    told = (helsinki.folder / 'ATTRIBUTION.md').read_text(encoding='utf-8')
    assert '(c) OpenStreetMap contributors' in told
    assert 'https://www.openstreetmap.org/copyright' in told


def test_it_is_small(helsinki: MapModel) -> None:
    files = [path for path in helsinki.folder.iterdir() if path.is_file()]
    assert sum(path.stat().st_size for path in files) < 600_000


def test_it_has_what_a_city_has(helsinki: MapModel) -> None:
    network = helsinki.network
    assert {'Aleksanterinkatu', 'Mannerheimintie'} <= set(network.street_names)
    assert len(helsinki.buildings) > 400
    assert len(helsinki.landmarks) > 50
    assert sum(junction.has_signal for junction in network.junctions.values()) > 10
    assert helsinki.landmark('Ateneum').kind == 'museum'


def test_its_sidewalks_and_crossings_are_walked_and_refusals_are_few(helsinki: MapModel) -> None:
    found = load_measured_map(helsinki, 0.05, 5.0)
    assert found is not None
    records = found.records
    assert records.sidewalks.walked == records.sidewalks.tried > 300
    assert records.crossings.walked == records.crossings.tried > 250
    for row in records.spawns:
        assert 0.95 * row.tried < row.stands < row.tried
        assert row.failures


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone tracks a car for 20 seconds at 40 m.',
        'A van follows the ego car 25 m behind it; a drone hovers over the ego car at 50 m.',
        'A drone hovers over Ateneum at 60 m for 10 seconds.',
    ],
)
def test_prompts_find_their_place(
    prompt: str, read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> None:
    found = ground(read_prompt(prompt, 'helsinki'), 'helsinki')
    assert found.map_name == 'helsinki'
    assert found.uavs
