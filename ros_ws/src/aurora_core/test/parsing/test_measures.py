# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers with units, in digits and words, exact."""

from __future__ import annotations

import pytest

from aurora_core.parsing.measures import UNREADABLE, Measure, MeasureReader
from aurora_core.parsing.tokens import tokenize
from aurora_core.spec.parameter import Bound


def _read(text: str) -> Measure | None:
    tokens = tokenize(text)
    found = MeasureReader(tokens, [t.norm for t in tokens]).read(0)
    return None if found is None else found[0]


@pytest.mark.parametrize(
    ('text', 'dimension', 'value'),
    [
        ('30 m', 'length', 30.0),
        ('35m', 'length', 35.0),
        ('0.5 km', 'length', 500.0),
        ('500 ft', 'length', 152.4),
        ('fifty feet', 'length', 15.24),
        ('10 yards', 'length', 9.144),
        ('1 mile', 'length', 1609.344),
        ('36 km/h', 'speed', 10.0),
        ('18 kph', 'speed', 5.0),
        ('30 mph', 'speed', 13.4112),
        ('36 knots', 'speed', 36 * 1852 / 3600),
        ('8 m/s', 'speed', 8.0),
        ('5 meters per second', 'speed', 5.0),
        ('250 ms', 'time', 0.25),
        ('2 minutes', 'time', 120.0),
        ('1 min 30 s', 'time', 90.0),
        ('one minute and thirty seconds', 'time', 90.0),
        ('one and a half minutes', 'time', 90.0),
        ('half a minute', 'time', 30.0),
        ('a minute', 'time', 60.0),
        ('2 hours', 'time', 7200.0),
        ('20 %', 'ratio', 0.2),
        ('15 percent', 'ratio', 0.15),
        ('90 degrees', 'angle', 90.0),
        ('forty-five meters', 'length', 45.0),
        ('a hundred and twenty metres', 'length', 120.0),
        ('two hundred m', 'length', 200.0),
        ('2 point 5 m', 'count', 2.0),
        ('two point five m', 'length', 2.5),
        ('twelve', 'count', 12.0),
    ],
)
def test_value_in_si(text: str, dimension: str, value: float) -> None:
    measure = _read(text)
    assert measure is not None
    assert (measure.dimension, measure.value) == (dimension, value)


@pytest.mark.parametrize(
    ('text', 'bound', 'approximate'),
    [
        ('about 30 m', Bound.EXACTLY, True),
        ('roughly thirty meters', Bound.EXACTLY, True),
        ('30 m or so', Bound.EXACTLY, True),
        ('at least 30 m', Bound.AT_LEAST, False),
        ('no more than 30 m', Bound.AT_MOST, False),
        ('30 m at most', Bound.AT_MOST, False),
        ('30 m or more', Bound.AT_LEAST, False),
        ('exactly 30 m', Bound.EXACTLY, False),
    ],
)
def test_qualifiers(text: str, bound: Bound, approximate: bool) -> None:
    measure = _read(text)
    assert measure is not None
    assert (measure.value, measure.bound, measure.approximate) == (30.0, bound, approximate)
    assert text[measure.start : measure.end] in ('30 m', 'thirty meters')


@pytest.mark.parametrize(
    'text', ['20-30 m', '20 to 30 meters', 'between 20 and 30 m', '20 m to 30 m']
)
def test_ranges(text: str) -> None:
    measure = _read(text)
    assert measure is not None
    assert (measure.value, measure.upper) == (20.0, 30.0)


@pytest.mark.parametrize(
    ('text', 'sides'),
    [
        ('100 x 60 m', (100.0, 60.0)),
        ('100x60m', (100.0, 60.0)),
        ('120 m by 80 m', (120.0, 80.0)),
        ('300 ft by 200 ft', (91.44, 60.96)),
    ],
)
def test_sizes(text: str, sides: tuple[float, float]) -> None:
    measure = _read(text)
    assert measure is not None
    assert (measure.value, measure.second) == sides


@pytest.mark.parametrize('text', ['5G network', '3,5,2 m', '30-20 m', '1/2 mile'])
def test_unclear_notation_is_unreadable_and_never_a_guess(text: str) -> None:
    measure = _read(text)
    assert measure is not None
    assert measure.dimension == UNREADABLE


@pytest.mark.parametrize('text', ['a second drone', 'the drone', 'hundred', 'between us'])
def test_no_number(text: str) -> None:
    assert _read(text) is None
