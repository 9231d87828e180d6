# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A value that a model is shown is the value that checks, grounding and verifier use."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from aurora_core.conditions.derive import derive_conditions
from aurora_core.feasibility.limits import check_limits
from aurora_core.knowledge.config_files import ENVIRONMENT_VARIABLE, config_root
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.parsing.values import default
from aurora_core.pipeline.background import background, map_records, registries
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.pipeline.stages import RunRequest
from aurora_core.retrieval.background import Amounts, Background
from aurora_core.retrieval.episodes import Episode, EpisodeStore
from aurora_core.retrieval.ranking import LexicalRanker
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time

AMOUNTS = Amounts(assets=12, spawns=4, episodes=2, fusion_k=60.0)
MAP = 'junction'


@pytest.fixture
def config(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the configuration that a test may change."""
    copy = tmp_path / 'config'
    for folder in ('knowledge', 'maps'):
        shutil.copytree(config_root() / folder, copy / folder, ignore_dangling_symlinks=True)
    files = ('limits.json', 'tolerances.json', 'settings.json', 'multirotor.json', 'repair.yaml')
    for file in files:
        shutil.copy(config_root() / file, copy)
    monkeypatch.setenv(ENVIRONMENT_VARIABLE, str(copy))
    return copy


def change(file: Path, **values: Any) -> None:
    file.write_text(json.dumps(json.loads(file.read_text()) | values))


def shown(prompt: str = 'A drone hovers in fog over the ego car.') -> Background:
    return background(
        installed_knowledge(), RunRequest(prompt=prompt, map_name=MAP), [LexicalRanker], AMOUNTS
    )


def spec_of(prompt: str) -> ScenarioSpec:
    spec = parse_offline(prompt, ParseContext(map_name=MAP)).spec
    assert spec is not None
    return spec


@pytest.mark.parametrize(
    ('limit', 'value', 'prompt'),
    [
        ('uav_altitude_max_m', 77.0, 'A drone hovers over the ego car at 100 m.'),
        ('uav_altitude_min_m', 41.0, 'A drone hovers over the ego car at 40 m.'),
        ('uav_speed_max_mps', 7.0, 'A drone patrols a rectangle over the streets at 9 m/s.'),
        ('uav_endurance_s', 90.0, 'A drone hovers over the ego car for 100 seconds.'),
        ('uav_standoff_max_m', 33.0, 'A drone tracks the ego car from 50 m.'),
        ('vehicle_speed_max_mps', 20.0, 'A car drives at 25 m/s. A drone tracks it.'),
        ('duration_max_s', 200.0, 'The scenario lasts 250 seconds. A drone hovers.'),
        ('uavs_max', 1, 'Two drones hover over the ego car.'),
    ],
)
def test_a_changed_limit_changes_context_and_check(
    config: Path, limit: str, value: float, prompt: str
) -> None:
    before = check_limits(
        spec_of(prompt), installed_knowledge().limits, installed_knowledge().types
    )
    assert before.certificates == ()
    change(config / 'limits.json', **{limit: value})
    known = installed_knowledge()
    told = json.loads(shown().registries_text())['limits'][limit]
    (certificate,) = check_limits(spec_of(prompt), known.limits, known.types).certificates
    assert told == value == certificate.limit


def test_a_changed_size_and_speed_of_a_type_change_context_and_check(config: Path) -> None:
    file = config / 'knowledge' / 'measured' / 'agent_types.json'
    rows = json.loads(file.read_text())['types']
    change(
        file,
        types=[
            row | {'max_speed_mps': 9.0, 'length_m': 4.4} if row['name'] == 'car' else row
            for row in rows
        ],
    )
    known = installed_knowledge()
    background_ = shown('A car drives.')
    told = json.loads(background_.registries_text())['agent_types']['car']
    (asset,) = [r for r in background_.selected if r.id == 'car']
    spec = spec_of('A car drives at 12 m/s. A drone tracks it.')
    (certificate,) = check_limits(spec, known.limits, known.types).certificates
    assert told['max_speed_mps'] == asset.data['max_speed_mps'] == certificate.limit == 9.0
    grounded = known.grounder(MAP).ground(spec_of('A drone tracks a car.'), 1)
    assert isinstance(grounded, GroundedScenario)
    (body,) = [a for a in grounded.agents if a.id == 'car1']
    assert told['length_m'] == asset.data['length_m'] == body.length_m == 4.4


def test_a_changed_limit_changes_context_and_verifier(config: Path) -> None:
    change(config / 'limits.json', separation_min_m=6.5)
    known = installed_knowledge()
    spec = spec_of('Two drones hover over the ego car.')
    grounded = known.grounder(MAP).ground(spec, 1)
    assert isinstance(grounded, GroundedScenario)
    facts = plan_time(spec, grounded, known.limits, known.tolerances).facts
    conditions = derive_conditions(spec, facts, known.limits, known.tolerances).conditions
    told = json.loads(shown().registries_text())['limits']['separation_min_m']
    assert told == 6.5
    assert {c.threshold for c in conditions if 'separation' in c.id} == {6.5}


def test_sensing_range_of_the_weather_is_that_of_the_limits(config: Path) -> None:
    limits = json.loads((config / 'limits.json').read_text())
    change(config / 'limits.json', sensing_range_m=limits['sensing_range_m'] | {'fog': 66.0})
    (fog,) = [r for r in shown().selected if r.id == 'fog']
    assert (
        fog.data['sensing_range_m']
        == installed_knowledge().limits.sensing_range('fog', 'noon')
        == 66.0
    )


def test_templates_are_what_the_parser_fills_in() -> None:
    templates = json.loads(shown().registries_text())['mission_templates']
    spec = spec_of('A drone hovers over the ego car.')
    told = templates['modes']['hover']
    assert told['altitude'] == spec.missions[0].altitude_m.value == default('altitude').value


def test_every_map_and_landmark_is_there() -> None:
    known = installed_knowledge()
    told = {r.id: r.data for r in registries(known, 'downtown')}['maps']
    assert told['all'] == ['downtown', 'helsinki', 'junction']
    ids = {record.id for record in map_records(known, 'downtown')}
    assert {f'landmark:{mark.name}' for mark in known.map('downtown').landmarks} <= ids


def test_history_is_shown_where_it_is_named(tmp_path: Path) -> None:
    prompt = 'A drone follows a bus.'
    episode = Episode(
        id='r1',
        prompt='A quadcopter follows a bus.',
        map_name=MAP,
        status='verified',
        elements=('track bus1',),
        conditions=(),
        worst_normalised=0.1,
        trace_sha256='ab',
    )
    EpisodeStore(tmp_path).add(episode)
    request = RunRequest(prompt=prompt, map_name=MAP, history=tmp_path)
    found = background(installed_knowledge(), request, [LexicalRanker], AMOUNTS)
    (told,) = json.loads(found.selected_text())['episode']
    assert told['prompt'] == episode.prompt
    assert json.loads(shown(prompt).selected_text())['episode'] == []
