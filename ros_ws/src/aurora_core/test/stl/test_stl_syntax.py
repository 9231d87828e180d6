# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Text of formulas, both ways, and in English."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import VerificationError
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
    TimeUnit,
    Until,
)
from aurora_core.stl.syntax import format_formula, parse_formula

finite = st.floats(allow_nan=False, allow_infinity=False)
predicates = st.builds(
    Predicate,
    signal=st.sampled_from(
        ['x', 'distance(van1,ego)', 'speed(uav1)', 'd(uav1,landmark:City Hall)']
    ),
    op=st.sampled_from(list(Comparison)),
    threshold=finite,
    tolerance=finite.map(abs),
    unit=st.sampled_from(['', 'm', 's', 'm/s', 'm/s^2', 'deg', '1']),
)
intervals = st.one_of(
    st.just(Interval()),
    st.builds(
        lambda a, b, unit: Interval(
            low=min(a, b) if b is not None else a,
            high=None if b is None else max(a, b),
            unit=unit,
        ),
        st.floats(0.0, 1e6),
        st.one_of(st.none(), st.floats(0.0, 1e6)),
        st.sampled_from(list(TimeUnit)),
    ),
)


def _grow(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    return st.one_of(
        st.builds(Not, operand=inner),
        *(st.builds(kind, left=inner, right=inner) for kind in (And, Or, Implies)),
        *(
            st.builds(kind, operand=inner, interval=intervals)
            for kind in (Always, Eventually, Historically, Once)
        ),
        *(st.builds(kind, left=inner, right=inner, interval=intervals) for kind in (Until, Since)),
    )


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.recursive(predicates, _grow, max_leaves=6))
def test_the_text_reads_back_as_the_formula(formula: Formula) -> None:
    assert parse_formula(format_formula(formula)) == formula


def test_words_and_precedence() -> None:
    x = Predicate(signal='x', op=Comparison.GE, threshold=1.0)
    y = Predicate(signal='y', op=Comparison.LT, threshold=-2.5, unit='m/s')
    assert parse_formula('x >= 1 and x >= 1 or y < -2.5 m/s') == Or(
        left=And(left=x, right=x), right=y
    )
    assert parse_formula('x>=1 -> x>=1 -> y<-2.5m/s') == Implies(
        left=x, right=Implies(left=x, right=y)
    )
    assert parse_formula('always(x >= 1)') == Always(operand=x)
    assert parse_formula('not x >= 1') == Not(operand=x)
    assert parse_formula('eventually[0, 10] s (x >= 1)') == Eventually(
        operand=x, interval=Interval(high=10.0)
    )
    assert parse_formula('x >= 1 until[2, inf] ticks y < -2.5 m/s') == Until(
        left=x, right=y, interval=Interval(low=2.0, unit=TimeUnit.TICKS)
    )


@pytest.mark.parametrize(
    ('text', 'where'),
    [
        ('', 'a predicate expected at character 0'),
        ('x', 'a comparison expected at character 1'),
        ('x >=', 'a number expected at character 4'),
        ('x >= 1 x', 'the end expected at character 6'),
        ('(x >= 1', "'\\)' expected at character 7"),
        ('always [0 5] (x >= 1)', "',' expected"),
        ('and >= 1', 'a predicate expected'),
        ('always [5, 1] s (x >= 1)', '0 <= low <= high'),
    ],
)
def test_what_is_not_a_formula_is_refused_with_its_place(text: str, where: str) -> None:
    with pytest.raises(VerificationError, match=where):
        parse_formula(text)


def test_what_is_no_formula_has_no_text() -> None:
    no_formula: Any = 'x'
    with pytest.raises(VerificationError, match='not an STL formula'):
        format_formula(no_formula)
