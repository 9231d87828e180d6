# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Complete a request: what it leaves open gets the values that this scenario needs.

Called once, when a prompt was read; every later stage takes the request as it is here. What the
prompt states is never touched.
"""

from __future__ import annotations

from aurora_core.knowledge.limits import Limits
from aurora_core.planning.durations import lasting
from aurora_core.planning.idle_uavs import hovering
from aurora_core.planning.layers import layered
from aurora_core.spec.scenario import ScenarioSpec


def complete(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return a request with a mission for every UAV, and the durations and altitudes to be flown.

    Args:
        spec: The request, whoever read it; it is not changed.
        limits: Limits in force.
    """
    return layered(lasting(hovering(spec)), limits)
