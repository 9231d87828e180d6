# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is to drive slower than somebody else, or comes to a stand, by the request itself."""

from __future__ import annotations

from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import GroundAgent
from aurora_core.spec.vocabulary import BehaviorKind

_HOLDS_UP = frozenset(
    {
        BehaviorKind.BRAKE,
        BehaviorKind.SLOW,
        BehaviorKind.STOP,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
    }
)


def slower_mps(agent: GroundAgent, than_mps: float) -> float | None:
    """Return how slow the request makes an agent that is to be slower than a speed, m/s.

    Returns:
        0 for whoever stands, stops, brakes or slows down, else the least speed that is stated for
        it; None for whoever may be as fast.
    """
    if any(b.kind in _HOLDS_UP for b in agent.behaviors):
        return 0.0
    speeds = [b.speed_mps for b in agent.behaviors if b.speed_mps is not None]
    if not speeds or any(s.value >= than_mps or s.bound is Bound.AT_LEAST for s in speeds):
        return None
    return max(0.0, min(s.value for s in speeds))
