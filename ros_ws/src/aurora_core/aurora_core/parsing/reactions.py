# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What ground agents do at once, as the action of an event."""

from __future__ import annotations

from typing import get_args

from aurora_core.spec.events import AgentDo
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction

REACTIONS: tuple[AgentDo, ...] = get_args(AgentDo)


def reaction(do: str, agent: str, speed: Parameter | None) -> AgentAction:
    """Return the action of an agent that was told to do so without a cause."""
    return AgentAction.model_validate({'do': do, 'agent': agent, 'value_mps': speed})
