# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sites keep to the lanes at which vehicles were measured to stand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from aurora_core.grounding.ground import Grounder
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.lane_samples import NO_LANE, sample_lanes
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import REFUSED, STANDS, SpawnTable, WalkTable
from aurora_core.knowledge.settings import Settings
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.pipeline.knowledge import installed_knowledge
from aurora_core.spec.scenario import ScenarioSpec

PROMPT = 'A drone tracks a truck.'
Ground = Callable[..., GroundedScenario | GroundingFailure]
With = Callable[[SpawnTable | None], GroundedScenario | GroundingFailure]


@pytest.fixture
def ground_on(
    map_of: Callable[[str], MapModel],
    agent_types: Mapping[str, AgentTypeRecord],
    limits: Limits,
    tolerances: Tolerances,
    settings: Settings,
    read_prompt: Callable[..., ScenarioSpec],
) -> Ground:
    """Ground a prompt on a map with records of it."""

    def ground(
        map_name: str,
        prompt: str,
        *,
        spawns: SpawnTable | None = None,
        walks: WalkTable | None = None,
    ) -> GroundedScenario | GroundingFailure:
        grounder = Grounder(
            map_of(map_name), agent_types, limits, tolerances, settings, spawns=spawns, walks=walks
        )
        return grounder.ground(read_prompt(prompt, map_name), 1)

    return ground


@pytest.fixture
def ground_with(ground_on: Ground) -> With:
    return lambda spawns: ground_on('junction', PROMPT, spawns=spawns)


def _table(model: MapModel, type_name: str, *refused: str) -> SpawnTable:
    samples = sample_lanes(model)
    table = np.full((1, len(samples)), STANDS, dtype=np.uint8)
    for lane_id in refused:
        first, end = samples.first[lane_id]
        table[0, first:end] = REFUSED
    return SpawnTable(type_names=(type_name,), samples=samples, table=table)


def test_a_refused_lane_is_left_for_another(
    map_of: Callable[[str], MapModel], ground_with: With
) -> None:
    free = ground_with(None)
    assert isinstance(free, GroundedScenario)
    assert ground_with(_table(map_of('junction'), 'truck')) == free
    lane = free.agents[0].lane_id
    moved = ground_with(_table(map_of('junction'), 'truck', lane))
    assert isinstance(moved, GroundedScenario)
    assert moved.agents[0].lane_id != lane
    # Where only another type is refused, nothing changes.
    assert ground_with(_table(map_of('junction'), 'bus', lane)) == free


def test_where_no_lane_is_left_grounding_fails(
    map_of: Callable[[str], MapModel], ground_with: With
) -> None:
    model = map_of('junction')
    lanes = sample_lanes(model).lane_ids
    assert isinstance(ground_with(_table(model, 'truck', *lanes)), GroundingFailure)


@pytest.mark.parametrize(
    'prompt',
    [
        'A bus drives 30 m ahead of the ego car and a truck follows 25 m behind it; a drone '
        'hovers over the ego car at 60 m.',
        'A drone hovers over the ego car at 60 m while twelve background cars circulate.',
        'Traffic is dense. A drone tracks a fire truck at 60 m.',
    ],
)
def test_nobody_is_placed_where_its_type_was_refused(
    prompt: str, read_prompt: Callable[..., ScenarioSpec]
) -> None:
    known = installed_knowledge()
    measured = known.measured('helsinki')
    assert measured is not None
    spec = read_prompt(prompt, 'helsinki')
    for seed in (1, 2):
        found = known.grounder('helsinki').ground(spec, seed)
        assert isinstance(found, GroundedScenario)
        assert len(found.agents) > 1 or 'dense' not in prompt
        for agent in found.agents:
            assert measured.spawns.accepts(agent.type_name, agent.lane_id, agent.lane_position_m)


def test_nobody_crosses_where_nobody_gets_over(
    map_of: Callable[[str], MapModel], ground_on: Ground
) -> None:
    model = map_of('downtown')
    prompt = 'A pedestrian crosses at the crosswalk while a drone hovers over it at 30 m.'

    def begins(blocked: str = '', *, crossings: bool = True) -> str:
        shut = {} if crossings else {crossing.id: 0.0 for crossing in model.network.crossings}
        walks = WalkTable(sidewalk_s={blocked: 0.0}, crossing_s=shut)
        found = ground_on('downtown', prompt, walks=walks)
        if isinstance(found, GroundingFailure):
            return found.reason
        return found.agents[0].lane_id

    usual = begins()
    assert begins(usual) not in (usual, 'sidewalk')
    assert begins(crossings=False) == 'sidewalk'


def test_traffic_and_free_vehicles_leave_a_refused_lane(
    map_of: Callable[[str], MapModel], ground_on: Ground
) -> None:
    model = map_of('downtown')
    prompt = (
        'Traffic is light. A drone hovers over the ego car at 60 m while six background cars '
        'circulate.'
    )

    def lanes(spawns: SpawnTable | None) -> list[str]:
        found = ground_on('downtown', prompt, spawns=spawns)
        assert isinstance(found, GroundedScenario)
        return [agent.lane_id for agent in found.agents]

    usual = lanes(None)
    assert len(usual) > 6
    assert lanes(_table(model, 'car')) == usual
    some = sorted(set(usual))[::2]
    assert not set(some) & set(lanes(_table(model, 'car', *some)))


def test_oncoming_vehicles_are_where_the_records_have_the_other_direction(
    map_of: Callable[[str], MapModel], ground_on: Ground
) -> None:
    model = map_of('downtown')
    prompt = 'A drone tracks a bus. A van comes towards the bus in the oncoming lane.'
    measured = _table(model, 'bus')

    def found(spawns: SpawnTable | None) -> GroundedScenario | GroundingFailure:
        return ground_on('downtown', prompt, spawns=spawns)

    usual = found(measured)
    assert isinstance(usual, GroundedScenario)
    assert found(None) == usual
    (van,) = [agent for agent in usual.agents if agent.type_name == 'van']
    samples = measured.samples
    assert van.lane_id in {samples.lane_ids[k] for k in samples.opposite if k != NO_LANE}
    alone = replace(samples, opposite=np.full_like(samples.opposite, NO_LANE))
    refused = found(replace(measured, samples=alone))
    assert isinstance(refused, GroundingFailure)
    assert refused.reason == 'oncoming'


def test_further_groups_leave_a_refused_lane(
    map_of: Callable[[str], MapModel], ground_on: Ground
) -> None:
    model = map_of('downtown')
    prompt = (
        'The truck is 30 m before the intersection. The bus is 20 m before the hospital. '
        'A drone tracks the truck.'
    )

    def lanes(spawns: SpawnTable) -> dict[str, str]:
        found = ground_on('downtown', prompt, spawns=spawns)
        assert isinstance(found, GroundedScenario)
        return {agent.id: agent.lane_id for agent in found.agents}

    usual = lanes(_table(model, 'bus'))
    assert usual['truck1'] != usual['bus1']
    refused = lanes(_table(model, 'bus', usual['bus1']))
    assert refused['bus1'] != usual['bus1']
