# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a stated number leaves open; one that is not stated leaves everything open."""

from __future__ import annotations

from aurora_core.spec.parameter import Bound, Parameter, Provenance


def is_stated(parameter: Parameter | None) -> bool:
    """Return whether the prompt states this number itself."""
    return parameter is not None and parameter.provenance is Provenance.EXPLICIT


def least(parameter: Parameter | None, tolerance: float, otherwise: float) -> float:
    """Return the least value that still meets a request; unstated: `otherwise`."""
    if parameter is None or not is_stated(parameter) or parameter.bound is Bound.AT_MOST:
        return otherwise
    return max(otherwise, parameter.value - tolerance)


def most(parameter: Parameter | None, tolerance: float, otherwise: float) -> float:
    """Return the greatest value that still meets a request; unstated: `otherwise`."""
    if parameter is None or not is_stated(parameter) or parameter.bound is Bound.AT_LEAST:
        return otherwise
    return min(otherwise, parameter.value + tolerance)
