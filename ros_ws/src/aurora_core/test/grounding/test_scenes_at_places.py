# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes whose bodies stand at, beside or before places: each where the request says."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import dist
from typing import Any

import pytest

from aurora_core.conditions.capabilities import unsupported
from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.scenario import ScenarioSpec

CITY_HALL = 'landmark:City Hall'
Placed = Mapping[str, Sequence[Mapping[str, Any]]]


class Scenes:
    """Grounds requests on the downtown map, with placements as a model may state them."""

    def __init__(self, read: Callable[..., ScenarioSpec], ground: Callable[..., Any]) -> None:
        self._read = read
        self._ground = ground

    def spec(self, prompt: str, placed: Placed) -> ScenarioSpec:
        spec = self._read(prompt, 'downtown')
        agents = [
            a.model_dump() | ({'placements': placed[a.id]} if a.id in placed else {})
            for a in spec.agents
        ]
        return ScenarioSpec.model_validate({**spec.model_dump(), 'agents': agents})

    def failure(self, prompt: str, placed: Placed) -> GroundingFailure:
        found = self._ground(self.spec(prompt, placed), 'downtown')
        assert isinstance(found, GroundingFailure), found
        return found

    def agents(self, prompt: str, placed: Placed) -> dict[str, GroundedAgent]:
        spec = self.spec(prompt, placed)
        found = self._ground(spec, 'downtown')
        assert isinstance(found, GroundedScenario), found
        assert unsupported(spec, found) == ()
        return {agent.id: agent for agent in found.agents}


@pytest.fixture
def scenes(read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., Any]) -> Scenes:
    return Scenes(read_prompt, ground)


def xy(agent: GroundedAgent) -> tuple[float, float]:
    return agent.x_m, agent.y_m


@pytest.mark.parametrize(
    'prompt', ['A van waits. A drone hovers at 40 m.', 'A pedestrian waits while a bus drives.']
)
def test_who_is_beside_a_landmark_is_at_it(
    scenes: Scenes, map_of: Callable[[str], MapModel], tolerances: Tolerances, prompt: str
) -> None:
    who = 'van1' if 'van' in prompt else 'pedestrian1'
    found = scenes.agents(prompt, {who: [{'relation': 'beside', 'of': CITY_HALL}]})
    street = MapPlaces(map_of('downtown')).point(CITY_HALL, (0.0, 0.0))
    assert dist(xy(found[who]), street) <= tolerances.arrival_m
