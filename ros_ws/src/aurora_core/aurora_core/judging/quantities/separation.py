# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far bodies are apart, of a group its worst pair."""

from __future__ import annotations

from itertools import combinations
from typing import Literal

import numpy as np

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition, number
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import contact
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import QuantityName


class Separation(StatedSeries):
    """Distance of two bodies in space, metres; of a group that of its worst pair."""

    name = QuantityName.SEPARATION
    kind: Literal['separation'] = 'separation'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the distance at every tick: an upper bound has to hold for the farthest pair."""
        pairs = combinations(condition.of, 2)
        each = np.stack([contact.separation(context.view, a, b) for a, b in pairs])
        upper = condition.op in ('<', '<=')
        if self.share is not None:
            upper = self.share.bound is Bound.AT_MOST
        worst: FloatArray = np.max(each, axis=0) if upper else np.min(each, axis=0)
        return worst


def implied(inputs: Inputs, a: str, b: str) -> Condition:
    """Return that two UAVs keep apart."""
    least = inputs.limits.separation_min_m
    return condition(
        id=f'safety.separation.{a}.{b}',
        sentence=f'{a} and {b} keep {number(least)} m apart while one of them flies',
        of=(a, b),
        target=Target(op='>=', threshold=least, unit='m'),
        arguments=Separation(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
    )
