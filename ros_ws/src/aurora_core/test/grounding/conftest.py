# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Agents as grounding places them."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Agents = Callable[[str], dict[str, GroundedAgent]]


@pytest.fixture
def agents(
    read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> Agents:
    """Ground a request on the downtown map, return its agents by name."""

    def agents_of(prompt: str) -> dict[str, GroundedAgent]:
        found = ground(read_prompt(prompt, 'downtown'), 'downtown')
        return {agent.id: agent for agent in found.agents}

    return agents_of
