# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From a formula to what follows its robustness along a growing trace."""

from __future__ import annotations

from aurora_core.stl.formula import (
    Always,
    And,
    Eventually,
    Formula,
    Historically,
    Implies,
    Not,
    Once,
    Or,
    Predicate,
    Since,
    Until,
)
from aurora_core.stl.online_first import (
    First,
    FirstNegation,
    FirstOf,
    FirstPair,
    FirstUntil,
    FirstWindow,
)
from aurora_core.stl.online_streams import Negation, Pair, Samples, Stream
from aurora_core.stl.online_until import Ahead, Behind, RunningBehind
from aurora_core.stl.online_windows import Running, Window
from aurora_core.stl.windows import Extremum


def first_value(formula: Formula, *, dt_s: float, clip: bool) -> First:
    """Return what follows the robustness at sample 0.

    Args:
        formula: The formula.
        dt_s: Time between samples.
        clip: Bounded windows take the samples that there are.

    Raises:
        VerificationError: An interval holds no sample.
    """

    def first(part: Formula) -> First:
        return first_value(part, dt_s=dt_s, clip=clip)

    def along(part: Formula) -> Stream:
        return _stream(part, dt_s, clip)

    match formula:
        case Not():
            return FirstNegation(first(formula.operand))
        case And():
            return FirstPair(first(formula.left), first(formula.right), Extremum.LEAST)
        case Or():
            return FirstPair(first(formula.left), first(formula.right), Extremum.GREATEST)
        case Implies():
            negated = FirstNegation(first(formula.left))
            return FirstPair(negated, first(formula.right), Extremum.GREATEST)
        case Always() | Eventually():
            extremum = Extremum.LEAST if isinstance(formula, Always) else Extremum.GREATEST
            ticks = formula.interval.ticks(dt_s)
            return FirstWindow(along(formula.operand), extremum, ticks=ticks, clip=clip)
        case Until():
            ticks = formula.interval.ticks(dt_s)
            return FirstUntil(along(formula.left), along(formula.right), ticks=ticks, clip=clip)
        case Predicate() | Historically() | Once() | Since():
            return FirstOf(along(formula))


def _stream(formula: Formula, dt_s: float, clip: bool) -> Stream:
    def along(part: Formula) -> Stream:
        return _stream(part, dt_s, clip)

    match formula:
        case Predicate():
            return Samples(formula)
        case Not():
            return Negation(along(formula.operand))
        case And():
            return Pair(along(formula.left), along(formula.right), Extremum.LEAST)
        case Or():
            return Pair(along(formula.left), along(formula.right), Extremum.GREATEST)
        case Implies():
            negated = Negation(along(formula.left))
            return Pair(negated, along(formula.right), Extremum.GREATEST)
        case Always() | Eventually():
            extremum = Extremum.LEAST if isinstance(formula, Always) else Extremum.GREATEST
            ticks = formula.interval.ticks(dt_s)
            return Window(along(formula.operand), extremum, ticks=ticks, ahead=True, clip=clip)
        case Historically() | Once():
            extremum = Extremum.LEAST if isinstance(formula, Historically) else Extremum.GREATEST
            return _past(along(formula.operand), extremum, formula.interval.ticks(dt_s), clip)
        case Until():
            ticks = formula.interval.ticks(dt_s)
            return Ahead(along(formula.left), along(formula.right), ticks=ticks, clip=clip)
        case Since():
            near, far = formula.interval.ticks(dt_s)
            left, right = along(formula.left), along(formula.right)
            if far is None:
                return RunningBehind(left, right, near=near)
            return Behind(left, right, ticks=(near, far), clip=clip)


def _past(
    operand: Stream, extremum: Extremum, ticks: tuple[int, int | None], clip: bool
) -> Stream:
    near, far = ticks
    if far is None:
        return Running(operand, extremum, near=near)
    return Window(operand, extremum, ticks=ticks, ahead=False, clip=clip)
