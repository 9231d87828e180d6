# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers as people write them."""

from __future__ import annotations

import pytest

from aurora_bench.prompts.numerals import Dimension, stated_numbers


@pytest.mark.parametrize(
    ('text', 'numbers'),
    [
        ('at 40 m for 20s', [(40.0, 'm'), (20.0, 's')]),
        ('500 ft up', [(152.4, 'm')]),
        ('25 mph, 36 km/h, 15 kn', [(11.176, 'm/s'), (10.0, 'm/s'), (7.7167, 'm/s')]),
        ('a 120x80 m box', [(120.0, 'm'), (80.0, 'm')]),
        ('30, 45 and 60 feet', [(9.144, 'm'), (13.716, 'm'), (18.288, 'm')]),
        ('one hundred and twenty-one metres', [(121.0, 'm')]),
        ('half a minute', [(30.0, 's')]),
        ('three quarters of an hour', [(2700.0, 's')]),
        ('two and a half minutes', [(150.0, 's')]),
        ('a minute and a half', [(90.0, 's')]),
        ('minute and a half', [(90.0, 's')]),
        ('a quarter of a kilometre', [(250.0, 'm')]),
        ('forty-five kilometres an hour', [(12.5, 'm/s')]),
        ('one in five packets', [(0.2, 'share')]),
        ('three messages in ten', [(0.3, 'share')]),
        ('20 % loss, .3 then', [(0.2, 'share'), (0.3, '')]),
        ('1,5 minutes', [(90.0, 's')]),
        ('500 ms', [(0.5, 's')]),
        ('uav1 and drone 2 see a second car', []),
        ('a dozen cars', [(12.0, '')]),
        ('r 60 h 50', [(60.0, ''), (50.0, '')]),
    ],
)
def test_numbers_in_si(text: str, numbers: list[tuple[float, str]]) -> None:
    found = stated_numbers(text)
    assert [n.dimension.value for n in found] == [unit for _, unit in numbers]
    assert [n.value for n in found] == pytest.approx([v for v, _ in numbers], rel=1e-4)


def test_a_number_says_where_it_stands() -> None:
    (number,) = stated_numbers('hover at 40 m')
    assert (number.start, number.text, number.dimension) == (9, '40 m', Dimension.LENGTH)
