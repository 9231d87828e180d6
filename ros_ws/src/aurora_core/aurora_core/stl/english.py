# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""STL formulas in plain English."""

from __future__ import annotations

from functools import singledispatch

from aurora_core.errors import VerificationError
from aurora_core.stl.formula import (
    WHOLE,
    Always,
    And,
    Comparison,
    Eventually,
    Formula,
    Historically,
    Implies,
    Interval,
    Not,
    Once,
    Or,
    Predicate,
    Since,
    TimeUnit,
    Until,
)
from aurora_core.stl.syntax import format_number

_COMPARISON = {
    Comparison.GE: 'is at least',
    Comparison.GT: 'is above',
    Comparison.LE: 'is at most',
    Comparison.LT: 'is below',
    Comparison.WITHIN: 'is',
}


@singledispatch
def english(formula: object) -> str:
    """Return a formula as a clause, for example `at all times altitude(uav1) is at least 3 m`."""
    raise VerificationError(f'not an STL formula: {formula!r}')


@english.register
def _(formula: Predicate) -> str:
    unit = '' if formula.unit in ('', '1') else f' {formula.unit}'
    text = f'{formula.signal} {_COMPARISON[formula.op]} {format_number(formula.threshold)}{unit}'
    if formula.op is Comparison.WITHIN:
        text += f' within {format_number(formula.tolerance)}{unit}'
    return text


@english.register
def _(formula: Not) -> str:
    return f'not ({english(formula.operand)})'


@english.register
def _(formula: And) -> str:
    return f'{_inner(formula.left)} and {_inner(formula.right)}'


@english.register
def _(formula: Or) -> str:
    return f'{_inner(formula.left)} or {_inner(formula.right)}'


@english.register
def _(formula: Implies) -> str:
    return f'if {_inner(formula.left)}, then {_inner(formula.right)}'


@english.register
def _(formula: Always) -> str:
    return f'{_when("at all times", formula.interval, "from now")} {_inner(formula.operand)}'


@english.register
def _(formula: Eventually) -> str:
    return f'{_when("at some time", formula.interval, "from now")} {_inner(formula.operand)}'


@english.register
def _(formula: Historically) -> str:
    return f'{_when("at all times", formula.interval, "ago")} {_inner(formula.operand)}'


@english.register
def _(formula: Once) -> str:
    return f'{_when("at some time", formula.interval, "ago")} {_inner(formula.operand)}'


@english.register
def _(formula: Until) -> str:
    until = _when('until', formula.interval, 'from now')
    return f'{_inner(formula.left)} {until} {_inner(formula.right)}'


@english.register
def _(formula: Since) -> str:
    since = _when('since', formula.interval, 'ago')
    return f'{_inner(formula.left)} {since} {_inner(formula.right)}'


def _inner(formula: Formula) -> str:
    text = english(formula)
    return text if isinstance(formula, Predicate | Not) else f'({text})'


def _when(word: str, interval: Interval, direction: str) -> str:
    if interval == WHOLE:
        return word
    unit = 's' if interval.unit is TimeUnit.SECONDS else 'ticks'
    low = format_number(interval.low)
    if interval.high is None:
        return f'{word}, {low} {unit} or more {direction},'
    return f'{word}, {low} to {format_number(interval.high)} {unit} {direction},'
