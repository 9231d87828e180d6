# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The threshold of an annotated condition, and its test."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.case import Case, Requirement

EPSILON = 1e-9


def compare(op: str, value: float, slack: float = 0.0) -> Callable[[Any], Any]:
    """Return the test of a condition; `slack` is the tolerance of ==."""
    tests: dict[str, Callable[[Any], Any]] = {
        '<=': lambda x: x <= value + EPSILON,
        '<': lambda x: x < value,
        '>=': lambda x: x >= value - EPSILON,
        '>': lambda x: x > value,
        '==': lambda x: np.abs(x - value) <= slack + EPSILON,
    }
    return tests[op]


def value_of(case: Case, requirement: Requirement) -> tuple[float, float]:
    """Return the threshold (its kindest reading inside of a variation) and the slack of ==."""
    value = float(requirement['value'])
    own = case.variation.get(f'{requirement.get("id")}.value')
    if isinstance(own, list | tuple) and len(own) == 2:
        low, high = float(own[0]), float(own[1])
        if requirement['op'] in ('>=', '>'):
            return low, 0.0
        if requirement['op'] in ('<=', '<'):
            return high, 0.0
        return (low + high) / 2.0, (high - low) / 2.0
    rule = {
        'altitude': limits.ALTITUDE,
        'speed': limits.SPEED,
        'vertical_speed': limits.VERTICAL,
        'deceleration': limits.DECELERATION,
        'time_headway': limits.HEADWAY,
        'event_time': limits.DURATION,
        'distance': limits.STANDOFF,
        'horizontal_distance': limits.STANDOFF,
        'separation': limits.STANDOFF,
    }.get(str(requirement['quantity']), (0.0, 0.01))
    return value, limits.tolerance(rule, value)
