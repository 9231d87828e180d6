# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which measured values count as an annotated number."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from aurora_bench.checker.limits import REALISED_SHARE, tolerance


@dataclass(frozen=True, slots=True)
class Wanted:
    """A number of the annotation.

    Attributes:
        value: As annotated.
        low: Least value that counts (a trace is noisy: see `slack`).
        high: Greatest one.
        slack: What a single sample may be outside of [low, high], by the contract's tolerance.
    """

    value: float
    low: float
    high: float
    slack: float

    def counts(self, measured: float) -> bool:
        """Return whether a measured value is the number."""
        return self.low - 1e-9 <= measured <= self.high + 1e-9

    def off(self, measured: float) -> float:
        """Return how far a measured value is outside."""
        return max(self.low - measured, measured - self.high, 0.0)

    def text(self) -> str:
        """Return the interval, for people."""
        if math.isinf(self.high):
            return f'at least {self.low:.4g}'
        return f'{self.value:.4g} ({self.low:.4g} to {self.high:.4g})'


def wanted(
    requirement: Mapping[str, Any],
    field: str,
    variation: Mapping[str, Any],
    rule: tuple[float, float],
) -> Wanted | None:
    """Return what counts as a field of a requirement; None when the field is not stated.

    The annotation's own `variation` or `tol` bounds the number, with the 1 % of realised values;
    without one the contract's tolerance does.

    Args:
        rule: Contract's tolerance: (absolute, share).
    """
    value = requirement.get(field)
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    value = float(value)
    slack = tolerance(rule, value)
    own = variation.get(f'{requirement.get("id")}.{field}')
    if isinstance(own, list | tuple) and len(own) == 2:
        return _own(value, float(own[0]), float(own[1]), slack)
    tol = requirement.get('tol')
    if isinstance(tol, Mapping):
        tol = tol.get(field)
    if isinstance(tol, int | float):
        return _own(value, value - float(tol), value + float(tol), slack)
    return Wanted(value, value - slack, value + slack, 0.0)


def _own(value: float, low: float, high: float, slack: float) -> Wanted:
    return Wanted(value, low - REALISED_SHARE * abs(low), high + REALISED_SHARE * abs(high), slack)
