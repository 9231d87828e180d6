# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""RTAMT as oracle: formulas in its words, its values, and where they mean the same as ours."""

from __future__ import annotations

from typing import TypeGuard

import rtamt

from aurora_bench.stl.pairs import SIGNALS, Pair
from aurora_core.stl.formula import (
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
    Until,
    children,
)

_WORDS = {
    Always: 'always', Eventually: 'eventually', Historically: 'historically', Once: 'once',
    And: 'and', Or: 'or', Implies: 'implies', Until: 'until', Since: 'since',
}  # fmt: skip
_Temporal = Always | Eventually | Until | Historically | Once | Since


def rtamt_text(formula: Formula) -> str:
    """Return the formula in RTAMT's grammar, intervals in samples."""
    match formula:
        case Predicate(op=Comparison.WITHIN):
            # RTAMT's == has no tolerance.
            return f'(abs({formula.signal} - {formula.threshold}) <= {formula.tolerance})'
        case Predicate():
            return f'({formula.signal} {formula.op} {formula.threshold})'
        case Not():
            return f'(not {rtamt_text(formula.operand)})'
        case And() | Or() | Implies():
            word = _WORDS[type(formula)]
            return f'({rtamt_text(formula.left)} {word} {rtamt_text(formula.right)})'
        case Until() | Since():
            word = _WORDS[type(formula)] + _bounds(formula.interval)
            return f'({rtamt_text(formula.left)} {word} {rtamt_text(formula.right)})'
        case Always() | Eventually() | Historically() | Once():
            word = _WORDS[type(formula)] + _bounds(formula.interval)
            return f'({word} {rtamt_text(formula.operand)})'


def _bounds(interval: Interval) -> str:
    low, high = interval.ticks(1.0)
    return '' if high is None else f'[{low},{high}]'


def offline_values(pair: Pair) -> list[float]:
    """Return RTAMT's robustness at every sample."""
    specification = rtamt.StlDiscreteTimeOfflineSpecification()
    _declare(specification, pair.formula)
    dataset = {name: samples.tolist() for name, samples in pair.trace.items()}
    found = specification.evaluate({'time': list(range(pair.samples)), **dataset})
    return [float(value) for _, value in found]


def online_monitor(formula: Formula) -> rtamt.StlDiscreteTimeOnlineSpecification:
    """Return RTAMT's monitor of the formula, turned into a past one.

    Raises:
        rtamt.RTAMTException: There is a future window without end.
    """
    specification = rtamt.StlDiscreteTimeOnlineSpecification()
    _declare(specification, formula)
    specification.pastify()
    return specification


def online_values(monitor: rtamt.StlDiscreteTimeOnlineSpecification, pair: Pair) -> list[float]:
    """Return what a fresh monitor says at each update: the robustness `delay` samples earlier."""
    rows = zip(*(pair.trace[name].tolist() for name in SIGNALS), strict=True)
    return [
        float(monitor.update(k, list(zip(SIGNALS, row, strict=True))))
        for k, row in enumerate(rows)
    ]


def shares_state(monitor: rtamt.StlDiscreteTimeOnlineSpecification) -> bool:
    """Return whether two operators with a memory have one text, and so one memory."""

    # By identity: RTAMT's negation lists its one child twice.
    found: dict[int, str] = {}
    open_nodes = [monitor.ast.specs[-1]]
    while open_nodes:
        node = open_nodes.pop()
        if _has_memory(node):
            found[id(node)] = node.name
        open_nodes += node.children
    return len(set(found.values())) < len(found)


def _has_memory(node: rtamt.Node) -> bool:
    kinds = ('Once', 'Historically', 'Since', 'Precedes')
    return type(node).__name__.removeprefix('Timed') in kinds


def _declare(specification: rtamt.StlDiscreteTimeSpecification, formula: Formula) -> None:
    for name in SIGNALS:
        specification.declare_var(name, 'float')
    specification.spec = rtamt_text(formula)
    specification.parse()


def delay(formula: Formula) -> int | None:
    """Return how many samples RTAMT's online monitor lags behind; None: it has no monitor."""
    below = [delay(child) for child in children(formula)]
    reach: int | None = 0
    if isinstance(formula, Always | Eventually | Until):
        reach = formula.interval.ticks(1.0)[1]
    known = [each for each in below if each is not None]
    return None if reach is None or len(known) < len(below) else reach + max(known, default=0)


def past_over_future(formula: Formula) -> bool:
    """Return whether a past operator has a future one inside."""
    if isinstance(formula, Historically | Once | Since) and delay(formula) != 0:
        return True
    return any(past_over_future(child) for child in children(formula))


def delayed_wrongly(formula: Formula, remaining: int | None = None) -> bool:
    """Return whether RTAMT has to delay a predicate or a bounded historically.

    That is so where branches reach unequally far ahead. Predicates it delays twice, by themselves
    and by their variables, and in place of a historically it delays the operand.

    Args:
        formula: With a delay.
        remaining: Samples by which this formula has to be late; None: its own delay.
    """
    own = delay(formula) or 0
    late = own if remaining is None else remaining
    match formula:
        case Predicate():
            return late > 0
        case Historically() if formula.interval.high is not None and late > own:
            return True
        case Always() | Eventually() | Until():
            inner = late - (formula.interval.ticks(1.0)[1] or 0)
        case _:
            inner = own
    return any(delayed_wrongly(child, inner) for child in children(formula))


def endless_over_bounded(formula: Formula) -> bool:
    """Return whether a window without end contains a bounded one."""
    endless = _is_temporal(formula) and formula.interval.high is None
    inside = [each for child in children(formula) for each in _subformulas(child)]
    if endless and any(_is_temporal(each) and each.interval.high is not None for each in inside):
        return True
    return any(endless_over_bounded(child) for child in children(formula))


def _is_temporal(formula: Formula) -> TypeGuard[_Temporal]:
    return isinstance(formula, _Temporal)


def _subformulas(formula: Formula) -> list[Formula]:
    return [formula, *(each for child in children(formula) for each in _subformulas(child))]


def undisturbed(formula: Formula, n: int) -> tuple[int, int]:
    """Return the samples [start, stop) whose value depends on no window without any sample.

    Where a window lies wholly outside the trace, AURORA has no value and RTAMT has infinity,
    which then passes through the operators around it. Elsewhere both take what samples there are
    (AURORA with `clip`).

    Args:
        formula: Any.
        n: Length of the trace.
    """
    inside = [undisturbed(child, n) for child in children(formula)]
    start = max((each[0] for each in inside), default=0)
    stop = min((each[1] for each in inside), default=n)
    match formula:
        case Always() | Eventually() | Until():
            start, stop = _ahead(formula, start, stop, n)
        case Historically() | Once() | Since():
            begin, end = _ahead(formula, n - stop, n - start, n)
            start, stop = n - end, n - begin
    return (start, stop) if start < stop else (0, 0)


def _ahead(formula: _Temporal, start: int, stop: int, n: int) -> tuple[int, int]:
    """Return where the window reaches a sample and all of it, cut at the end, lies inside."""
    low, high = formula.interval.ticks(1.0)
    if not isinstance(formula, Until | Since):  # those read from the present on
        start = max(0, start - low)
    if stop == n:
        return start, n - low
    return start, (0 if high is None else stop - high)
