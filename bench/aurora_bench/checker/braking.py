# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How hard somebody braked: the slope of the speed while it fell."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, does_not, graded
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.numbers import Wanted, wanted
from aurora_bench.checker.recording import FloatArray
from aurora_bench.checker.scene import runs_of

FIELD = 'action.deceleration_mps2'
# Where a braking is fully developed: between these shares of the speed that is lost.
_FULL = (0.8, 0.1)
# A fit over few samples is off by so much of the value.
_DOUBT = 0.1


def asked(case: Case, requirement: Requirement, action: Mapping[str, Any]) -> Wanted | None:
    """Return the deceleration that an event's action states, None where it states none."""
    stated = {**requirement, FIELD: action.get('deceleration_mps2')}
    return wanted(stated, FIELD, case.variation, limits.DECELERATION)


def braked(case: Case, agent: str, since_s: float, number: Wanted) -> Judged:
    """Return whether the braking that an agent begins at a time is as hard as is asked."""
    speed = case.scene.speed(agent)
    falls = np.concatenate([np.diff(speed) < -1e-6, [False]])
    near = case.scene.tick(since_s)
    runs = [(a, b) for a, b in runs_of(falls) if b >= near - 2 and speed[a] - speed[b] > 0.5]
    if not runs:
        return does_not(f'{agent} loses no speed from {since_s:.2f} s on')
    first, last = runs[0]
    slope = _slope(speed[first : last + 1], case.scene.dt_s)
    why = f'{agent} brakes with {slope:.2f} m/s^2, asked {number.text()}'
    off = number.off(slope)
    return graded(number.counts(slope), off <= _DOUBT * number.value, why)


def _slope(speed: FloatArray, dt_s: float) -> float:
    """Return the loss of speed per second where a braking is fully developed, m/s^2."""
    lost = float(speed[0] - speed[-1])
    high, low = (float(speed[-1]) + share * lost for share in _FULL)
    inside = np.flatnonzero((speed <= high + 1e-9) & (speed >= low - 1e-9))
    if len(inside) < 3:
        return lost / ((len(speed) - 1) * dt_s)
    return float(-np.polyfit(inside * dt_s, speed[inside], 1)[0])
