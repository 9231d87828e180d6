# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Certificates of the checks that look at several stated numbers at once."""

from __future__ import annotations

from aurora_core.feasibility.verdict import Certificate
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span


def contradiction(reason: str, path: str, sentence: str, span: Span | None = None) -> Certificate:
    """Return the proof that two stated things exclude each other."""
    return Certificate(
        kind='contradiction', reason=reason, path=path, span=span, sentence=sentence
    )


def beyond(
    reason: str, parameter: Parameter, path: str, limit: tuple[str, float], sentence: str
) -> Certificate:
    """Return the proof that what a stated number implies is beyond a limit (name, value)."""
    name, value = limit
    return Certificate(
        kind='limit_exceeded',
        reason=reason,
        path=path,
        requested=parameter.value,
        unit=parameter.unit.value,
        limit_name=name,
        limit=value,
        span=parameter.span,
        sentence=sentence,
    )


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
