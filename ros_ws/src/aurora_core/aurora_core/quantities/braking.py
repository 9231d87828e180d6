# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How hard somebody brakes: what is commanded, and what the speeds of a braking show."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.limits import Tolerance
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec

FloatArray = npt.NDArray[np.float64]

# Between these shares of the speed that is lost a braking is fully developed: UN Regulation No. 13
# (annex 4, 3.1.1) measures the mean fully developed deceleration from 0.8 to 0.1 of the speed.
_FULL, _ENDING = 0.8, 0.1
# A bound is kept by this share of its tolerance.
_INSIDE_SHARE = 0.5
# A braking shows once it is as hard as this share of what is asked.
_SHOWS_SHARE = 0.5
# Nobody can be told to brake less hard (m/s^2).
_LEAST_MPS2 = 0.05


def mean_deceleration(speeds_mps: FloatArray, dt_s: float) -> float | None:
    """Return the mean fully developed deceleration of a braking, m/s^2; None where none is.

    Args:
        speeds_mps: (n,) from the last sample before it to its last one.
        dt_s: Time step.
    """
    lost_mps = float(speeds_mps[0] - speeds_mps[-1]) if len(speeds_mps) > 1 else 0.0
    if lost_mps <= 0.0:
        return None
    upper, lower = (float(speeds_mps[-1]) + share * lost_mps for share in (_FULL, _ENDING))
    took_s = (_first_at(speeds_mps, lower) - _first_at(speeds_mps, upper)) * dt_s
    return (upper - lower) / took_s


def _first_at(speeds_mps: FloatArray, speed_mps: float) -> float:
    """Return the index, between two samples, at which a speed is first fallen to."""
    index = int(np.argmax(speeds_mps <= speed_mps))
    before, now = float(speeds_mps[index - 1]), float(speeds_mps[index])
    return index - (speed_mps - now) / (before - now)


def braking_mps2(asked: Parameter | None, usual_mps2: float, onset_mps2: float) -> float:
    """Return how hard somebody slows down at least who brakes, m/s^2.

    Args:
        asked: Stated deceleration.
        usual_mps2: What counts as braking where none is stated.
        onset_mps2: Change of speed with which slowing down begins.
    """
    if asked is None:
        return usual_mps2
    return min(usual_mps2, max(onset_mps2, _SHOWS_SHARE * asked.value))


def commanded_mps2(asked: Parameter, tolerance: Tolerance) -> float:
    """Return how hard to brake where a deceleration is stated: a bound is kept with a reserve."""
    return max(_LEAST_MPS2, asked.inside(_INSIDE_SHARE * tolerance.of(asked.value)))


def least_mps2(asked: Parameter, tolerance: Tolerance) -> float:
    """Return the least that a stated deceleration leaves: how long a braking may take."""
    if asked.bound is Bound.AT_LEAST:
        return asked.value
    if asked.bound is Bound.AT_MOST:
        return commanded_mps2(asked, tolerance)
    slack = tolerance.of(asked.value, approximate=asked.approximate)
    return max(_LEAST_MPS2, asked.value - slack)


def most_mps2(spec: ScenarioSpec, agent: str, tolerance: Tolerance) -> float | None:
    """Return how hard somebody may brake in a run, None where nobody says.

    Args:
        spec: The request; "never brakes harder than 3 m/s^2" is a condition of it.
        agent: Id.
        tolerance: On decelerations.
    """
    members = {a.id: (a.id, a.group) for a in spec.agents}
    stated = [
        commanded_mps2(c.value.model_copy(update={'bound': Bound.AT_MOST}), tolerance)
        for c in spec.conditions
        if c.quantity == QuantityName.DECELERATION
        and c.op in ('<', '<=')
        and set(members.get(agent, ())) & set(c.of)
    ]
    return min(stated, default=None)
