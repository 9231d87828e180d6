# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The conditions of a grounded request: derived, judged, and traced back to what was stated."""

from __future__ import annotations

from dataclasses import dataclass, replace

from aurora_core.agsg.judged import unjudged
from aurora_core.conditions.capabilities import judgeable, unsupported
from aurora_core.conditions.derive import Derivation, derive_conditions
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import Unjudged
from aurora_core.outcomes.schedule import Schedule
from aurora_core.outcomes.triggers import as_realised
from aurora_core.spec.scenario import ScenarioSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedConditions:
    """What a run will be judged by.

    Attributes:
        conditions: Derived from the request and judged.
        missing: What of the request nobody carries out or judges, as `id: what`.
        unjudged: What the request states and no condition depends on.
    """

    conditions: tuple[Condition, ...]
    missing: tuple[str, ...]
    unjudged: tuple[Unjudged, ...]


def plan_conditions(
    spec: ScenarioSpec,
    grounded: GroundedScenario,
    schedule: Schedule,
    limits: Limits,
    tolerances: Tolerances,
) -> PlannedConditions:
    """Return the conditions of a grounded request, and what they leave out."""
    spec = as_realised(spec, grounded)

    def derive(asked: ScenarioSpec, agent: str | None = None) -> Derivation:
        made = derive_conditions(asked, schedule.facts, limits, tolerances, agent)
        return replace(made, conditions=judgeable(made.conditions, asked, grounded, agent))

    derivation = derive(spec)
    return PlannedConditions(
        conditions=derivation.conditions,
        missing=(
            *unsupported(spec, grounded),
            *(f'{u.element}: {u.what}' for u in derivation.underivable),
        ),
        unjudged=unjudged(
            spec,
            derivation.conditions,
            lambda asked: derive(asked).conditions,
            lambda asked, agent: derive(asked, agent).conditions,
        ),
    )
