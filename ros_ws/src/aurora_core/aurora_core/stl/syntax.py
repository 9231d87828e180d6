# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Text of STL formulas, both ways.

    formula   := or [ '->' formula ]
    or        := and { 'or' and }
    and       := until { 'and' until }
    until     := unary { ('until' | 'since') [ interval ] unary }
    unary     := ('not' | 'always' | 'eventually' | 'historically' | 'once') ... unary
                 | '(' formula ')' | predicate
    predicate := signal ('>=' | '>' | '<=' | '<' | '==') number [ '+-' number ] [ unit ]
    interval  := '[' number ',' (number | 'inf') ']' [ 's' | 'ticks' ]          (default s)
    signal    := name [ '(' names ')' ],  for example distance(van1,ego)

`parse_formula(format_formula(f)) == f` for every formula.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, singledispatch
from typing import NoReturn

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

# The arguments of a signal hold no comparison, so `always(x >= 1)` is a word and a parenthesis.
_TOKEN = re.compile(
    r"""\s*(?:
      (?P<number>-?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<symbol>->|\+-|>=|<=|==|>|<|\[|\]|\(|\)|,)
    | (?P<signal>[A-Za-z_][\w.]*(?:\([^()<>=]*\))?)
    )""",
    re.VERBOSE,
)
_UNIT = re.compile(r'\s*(m/s\^2|m/s|deg|m|s|1)(?![\w.(/^])')
_PREFIX: dict[str, Callable[..., Formula]] = {
    'always': Always,
    'eventually': Eventually,
    'historically': Historically,
    'once': Once,
}
# Texts whose formulas are kept: agents of a crowd differ in nothing but their names.
_FORMULAS = 2048
_WORDS = frozenset({'not', 'and', 'or', 'until', 'since', *_PREFIX})


def format_number(value: float) -> str:
    """Return the shortest text that reads back as the same number, without a trailing '.0'."""
    text = repr(float(value))
    return text[:-2] if text.endswith('.0') else text


@lru_cache(maxsize=_FORMULAS)
def parse_formula(text: str) -> Formula:
    """Read a formula.

    Raises:
        VerificationError: The text is not a formula; the message has the place.
    """
    parser = _Parser(text)
    formula = parser.implication()
    parser.expect_end()
    return formula


@dataclass
class _Parser:
    text: str
    position: int = 0

    def _match(self) -> re.Match[str] | None:
        return _TOKEN.match(self.text, self.position)

    def _peek(self) -> str:
        found = self._match()
        return '' if found is None else found.group().strip()

    def _take(self, wanted: str) -> bool:
        found = self._match()
        if found is None or found.group().strip() != wanted:
            return False
        self.position = found.end()
        return True

    def _fail(self, wanted: str) -> NoReturn:
        raise VerificationError(
            f'STL text: {wanted} expected at character {self.position} of {self.text!r}, '
            f'found {self._peek() or "the end"!r}'
        )

    def _need(self, wanted: str) -> None:
        if not self._take(wanted):
            self._fail(repr(wanted))

    def expect_end(self) -> None:
        if self.text[self.position :].strip():
            self._fail('the end')

    def implication(self) -> Formula:
        left = self._or()
        if self._take('->'):
            return Implies(left=left, right=self.implication())
        return left

    def _or(self) -> Formula:
        left = self._and()
        while self._take('or'):
            left = Or(left=left, right=self._and())
        return left

    def _and(self) -> Formula:
        left = self._until()
        while self._take('and'):
            left = And(left=left, right=self._until())
        return left

    def _until(self) -> Formula:
        left = self._unary()
        while True:
            if self._take('until'):
                interval = self._interval()
                left = Until(left=left, right=self._unary(), interval=interval)
            elif self._take('since'):
                interval = self._interval()
                left = Since(left=left, right=self._unary(), interval=interval)
            else:
                return left

    def _unary(self) -> Formula:
        if self._take('not'):
            return Not(operand=self._unary())
        if self._take('('):
            inner = self.implication()
            self._need(')')
            return inner
        for word, kind in _PREFIX.items():
            if self._take(word):
                interval = self._interval()
                return kind(operand=self._unary(), interval=interval)
        return self._predicate()

    def _number(self) -> float:
        found = self._match()
        if found is None or found.group('number') is None:
            self._fail('a number')
        self.position = found.end()
        return float(found.group('number'))

    def _interval(self) -> Interval:
        if not self._take('['):
            return WHOLE
        low = self._number()
        self._need(',')
        high = None if self._take('inf') else self._number()
        self._need(']')
        unit = TimeUnit.SECONDS
        if self._take('ticks'):
            unit = TimeUnit.TICKS
        else:
            self._take('s')
        return Interval(low=low, high=high, unit=unit)

    def _predicate(self) -> Predicate:
        found = self._match()
        name = '' if found is None else found.group('signal') or ''
        if found is None or not name or name in _WORDS:
            self._fail('a predicate')
        self.position = found.end()
        for op in Comparison:
            if self._take(op.value):
                break
        else:
            self._fail('a comparison')
        threshold = self._number()
        tolerance = self._number() if self._take('+-') else 0.0
        unit = ''
        matched = _UNIT.match(self.text, self.position)
        if matched is not None:
            unit = matched.group(1)
            self.position = matched.end()
        return Predicate(signal=name, op=op, threshold=threshold, tolerance=tolerance, unit=unit)


@singledispatch
def format_formula(formula: object) -> str:
    """Return the text of a formula."""
    raise VerificationError(f'not an STL formula: {formula!r}')


@format_formula.register
def _(formula: Predicate) -> str:
    text = f'{formula.signal} {formula.op.value} {format_number(formula.threshold)}'
    if formula.tolerance > 0.0:
        text += f' +- {format_number(formula.tolerance)}'
    return f'{text} {formula.unit}' if formula.unit else text


@format_formula.register
def _(formula: Not) -> str:
    return f'not ({format_formula(formula.operand)})'


def _binary(left: Formula, word: str, right: Formula) -> str:
    return f'({format_formula(left)}) {word} ({format_formula(right)})'


@format_formula.register
def _(formula: And) -> str:
    return _binary(formula.left, 'and', formula.right)


@format_formula.register
def _(formula: Or) -> str:
    return _binary(formula.left, 'or', formula.right)


@format_formula.register
def _(formula: Implies) -> str:
    return _binary(formula.left, '->', formula.right)


def format_interval(interval: Interval) -> str:
    """Return the text of an interval; empty for the one that is left out."""
    if interval == WHOLE:
        return ''
    high = 'inf' if interval.high is None else format_number(interval.high)
    return f'[{format_number(interval.low)}, {high}] {interval.unit.value} '


@format_formula.register
def _(formula: Until) -> str:
    return _binary(
        formula.left, f'until {format_interval(formula.interval)}'.strip(), formula.right
    )


@format_formula.register
def _(formula: Since) -> str:
    return _binary(
        formula.left, f'since {format_interval(formula.interval)}'.strip(), formula.right
    )


@format_formula.register
def _(formula: Always) -> str:
    return f'always {format_interval(formula.interval)}({format_formula(formula.operand)})'


@format_formula.register
def _(formula: Eventually) -> str:
    return f'eventually {format_interval(formula.interval)}({format_formula(formula.operand)})'


@format_formula.register
def _(formula: Historically) -> str:
    return f'historically {format_interval(formula.interval)}({format_formula(formula.operand)})'


@format_formula.register
def _(formula: Once) -> str:
    return f'once {format_interval(formula.interval)}({format_formula(formula.operand)})'
