# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Certificates of the checks that look at several stated numbers at once."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.outcomes.feasibility import Certificate, Fact, Rule, TimeBound
from aurora_core.spec.parameter import Parameter, Span, Unit
from aurora_core.spec.quantity import OP_WORDS
from aurora_core.spec.scenario import StatedCondition


def told(condition: StatedCondition) -> str:
    """Return what a condition asks for, in words."""
    number, share = condition.value, condition.fraction
    often = '' if share is None else f' for {100.0 * share.value:g} % of the time'
    unit = '' if number.unit is Unit.ONE else f' {number.unit}'
    what, of = condition.quantity.replace('_', ' '), ' and '.join(condition.of)
    return f'the {what} of {of} has to be {OP_WORDS[condition.op]} {number.value:g}{unit}{often}'


def contradiction(
    rule: Rule,
    reason: str,
    path: str,
    sentence: str,
    span: Span | None = None,
    facts: Iterable[Fact] = (),
    chain: tuple[TimeBound, ...] = (),
) -> Certificate:
    """Return the proof that stated things exclude each other."""
    return Certificate(
        kind='contradiction',
        reason=reason,
        path=path,
        span=span,
        sentence=sentence,
        rule=rule,
        facts=tuple(facts),
        chain=chain,
    )


def beyond(
    rule: Rule,
    reason: str,
    parameter: Parameter,
    path: str,
    limit: tuple[str, float],
    sentence: str,
    facts: Iterable[Fact] = (),
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
        rule=rule,
        facts=tuple(facts),
    )
