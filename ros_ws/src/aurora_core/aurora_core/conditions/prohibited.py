# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions on what must not be so: who is not there, which world it is not, what nobody does."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.judging.build import Inputs, Underivable
from aurora_core.judging.quantities import count, delivered, undone, world_setting
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Span
from aurora_core.spec.prohibitions import (
    ForbiddenAgent,
    ForbiddenBehavior,
    ForbiddenEvent,
    ForbiddenLink,
    ForbiddenWorld,
    Prohibition,
)
from aurora_core.spec.scenario import AgentAction


def prohibition_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all prohibitions, or what cannot be judged of them."""
    for prohibition in inputs.spec.prohibitions:
        found = _condition(inputs, prohibition)
        what = f'a forbidden {prohibition.forbids}'
        yield found or Underivable(element=prohibition.id, what=what, span=prohibition.span)


def _condition(inputs: Inputs, prohibition: Prohibition) -> Condition | None:
    match prohibition:
        case ForbiddenAgent():
            return count.absent(inputs, prohibition)
        case ForbiddenWorld():
            return world_setting.absent(inputs, prohibition)
        case ForbiddenBehavior(agent=agent, kind=kind, target=target, speed_mps=None):
            return _deed(inputs, prohibition.id, agent, kind.value, target, prohibition.span)
        case ForbiddenEvent(trigger=None, action=AgentAction(agent=agent, do=do, value_mps=None)):
            return _deed(inputs, prohibition.id, agent, do, None, prohibition.span)
        case ForbiddenLink(sender=sender, receiver=receiver):
            return delivered.never_sent(inputs, prohibition.id, sender, receiver, prohibition.span)
        case _:
            return None


def _deed(
    inputs: Inputs, id: str, agent: str, deed: str, other: str | None, span: Span | None
) -> Condition | None:
    if inputs.agent(agent) is None or not undone.can_be_forbidden(deed, other):
        return None
    if other is not None and inputs.agent(other) is None:
        return None
    return undone.forbidden(inputs, id, agent, deed, other, span)
