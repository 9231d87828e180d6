# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""All success conditions of a request, derived before the run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from aurora_core.conditions.behaviors import behavior_conditions
from aurora_core.conditions.events import event_conditions
from aurora_core.conditions.missions import mission_conditions
from aurora_core.conditions.orders import order_conditions
from aurora_core.conditions.placements import placement_conditions
from aurora_core.conditions.prohibited import prohibition_conditions
from aurora_core.conditions.safety import safety_conditions
from aurora_core.conditions.scene import scene_conditions
from aurora_core.conditions.stated import stated_conditions
from aurora_core.conditions.unsaid import unsaid
from aurora_core.errors import VerificationError
from aurora_core.judging.build import Inputs, Underivable
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.schedule import PlanFacts
from aurora_core.spec.scenario import ScenarioSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Derivation:
    """What a request asks for.

    Attributes:
        conditions: In a fixed order: stated, missions, placements, behaviours, events,
            orders, scene, prohibitions, safety.
        underivable: Elements that no condition can express yet; their clauses are `incomplete`.
    """

    conditions: tuple[Condition, ...]
    underivable: tuple[Underivable, ...]


def derive_conditions(
    spec: ScenarioSpec,
    facts: PlanFacts,
    limits: Limits,
    tolerances: Tolerances,
    agent: str | None = None,
) -> Derivation:
    """Return the success conditions of a request.

    Args:
        spec: The request.
        facts: What grounding chose.
        limits: Limits in force.
        tolerances: Tolerances and defaults of implied conditions.
        agent: Only those of the placements and behaviours of this ground agent.

    Raises:
        VerificationError: Specification and facts do not fit each other.
    """
    inputs = Inputs(spec=spec, facts=facts, limits=limits, tolerances=tolerances)
    conditions: list[Condition] = []
    underivable: list[Underivable] = []
    for item in _all(inputs) if agent is None else _of_agent(inputs, agent):
        if isinstance(item, Condition):
            conditions.append(item)
        else:
            underivable.append(item)
    ids = [condition.id for condition in conditions]
    repeated = sorted(i for i, count in Counter(ids).items() if count > 1)
    if repeated:
        raise VerificationError(f'condition ids must be unique, repeated: {", ".join(repeated)}')
    return Derivation(conditions=tuple(conditions), underivable=tuple(underivable))


def _of_agent(inputs: Inputs, name: str) -> Iterator[Condition | Underivable]:
    agent = inputs.agent(name)
    if agent is not None:
        yield from placement_conditions(inputs, (agent,))
        yield from behavior_conditions(inputs, (agent,))


def _all(inputs: Inputs) -> Iterator[Condition | Underivable]:
    parts: tuple[Iterable[Condition | Underivable], ...] = (
        stated_conditions(inputs),
        mission_conditions(inputs),
        placement_conditions(inputs, inputs.spec.agents),
        behavior_conditions(inputs, inputs.spec.agents),
        event_conditions(inputs),
        order_conditions(inputs),
        scene_conditions(inputs),
        prohibition_conditions(inputs),
        safety_conditions(inputs),
        unsaid(inputs),
    )
    for part in parts:
        yield from part
