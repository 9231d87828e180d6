# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The values that the prompt leaves open, as this scenario needs them."""

from __future__ import annotations

from aurora_core.grounding.durations import lasting
from aurora_core.grounding.layers import layered
from aurora_core.knowledge.limits import Limits
from aurora_core.spec.scenario import ScenarioSpec


def chosen(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return the specification with the durations and altitudes that its UAVs will fly.

    Args:
        spec: The request; it is not changed.
        limits: Limits in force.
    """
    return layered(lasting(spec), limits)
