# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The grounded graphs of the paper's prompts."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.conditions.derive import derive_conditions
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.agsg import Agsg, Stage
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time


@pytest.fixture(scope='session')
def full(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
    tolerances: Tolerances,
) -> Callable[[str], Agsg]:
    """Build the grounded graph of a prompt with its conditions."""

    def build(name: str) -> Agsg:
        spec = read_prompt(name)
        grounded = ground(spec)
        schedule = plan_time(spec, grounded, limits, tolerances)
        conditions = derive_conditions(spec, schedule.facts, limits, tolerances).conditions
        return build_agsg(
            spec,
            map_digest=grounded.map_digest,
            stage=Stage.GROUNDED,
            grounding=grounded,
            schedule=schedule,
            conditions=conditions,
        )

    return build
