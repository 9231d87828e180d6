# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sites keep to the lanes at which vehicles were measured to stand."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from aurora_core.grounding.ground import Grounder
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.lane_samples import sample_lanes
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_records import REFUSED, STANDS, SpawnTable
from aurora_core.knowledge.settings import Settings
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.scenario import ScenarioSpec

PROMPT = 'A drone tracks a truck.'
With = Callable[[SpawnTable | None], GroundedScenario | GroundingFailure]


@pytest.fixture
def ground_with(
    map_of: Callable[[str], MapModel],
    agent_types: Mapping[str, AgentTypeRecord],
    limits: Limits,
    tolerances: Tolerances,
    settings: Settings,
    read_prompt: Callable[..., ScenarioSpec],
) -> With:
    def ground(spawns: SpawnTable | None) -> GroundedScenario | GroundingFailure:
        grounder = Grounder(
            map_of('junction'), agent_types, limits, tolerances, settings, spawns=spawns
        )
        return grounder.ground(read_prompt(PROMPT, 'junction'), 1)

    return ground


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
