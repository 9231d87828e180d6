# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers with their units: `about 35 m`, `twenty feet`, `1 min 30 s`, `100 x 60 m`, `20 to 30 m`.

Conversion to SI is exact (fractions) and rounded once, at the end.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from aurora_core.parsing.lexicon import Lexicon, Tag, shipped_lexicon
from aurora_core.parsing.measure import (
    ANGLE,
    COUNT,
    LENGTH,
    RATE,
    RATIO,
    SPEED,
    TIME,
    UNBROKEN,
    UNREADABLE,
    Measure,
)
from aurora_core.parsing.number_words import spelled
from aurora_core.parsing.tokens import Token, TokenKind
from aurora_core.spec.parameter import Bound

__all__ = [
    'ANGLE',
    'COUNT',
    'LENGTH',
    'RATE',
    'RATIO',
    'SPEED',
    'TIME',
    'UNREADABLE',
    'Measure',
    'MeasureReader',
]

# Words in front of a time after the start: `at second 20`, `until 0:45`.
_AT = frozenset({'at', '@', 'until', 'till', 'from', 'by', 'on', 'around', 'about', 'in', 'after'})
# Between an article and what it counts: `a full minute`, `a good two minutes`, `a further 90 s`.
_EMPHASIS = frozenset(
    {'full', 'whole', 'good', 'solid', 'entire', 'complete', 'round', 'mere', 'further', 'total'}
)
_WHOLE = (
    frozenset({'additional', 'complete', 'entire', 'full', 'more', 'solid', 'whole'}) | UNBROKEN
)
# `40 m ± 2 m`
_SIGNS = (
    ('±',),
    ('+', '/', '-'),
    ('+', '-'),
    ('plus', '/', 'minus'),
    ('plus', 'or', 'minus'),
    ('plus', 'minus'),
)
# What may stand behind `every second`: no second one of many.
_JOINS = (Tag.PREPOSITION, Tag.CONJUNCTION, Tag.THEN, Tag.SUBORDINATOR)
_CLOCK = re.compile(r'(0?[0-5]):([0-5]\d)')


@dataclass(frozen=True, slots=True)
class _Number:
    value: Fraction | None
    stop: int
    words: bool


class MeasureReader:
    """Reads measures from a token list."""

    def __init__(
        self, tokens: Sequence[Token], words: Sequence[str], lexicon: Lexicon | None = None
    ) -> None:
        self._tokens = tokens
        self._words = words
        self._lexicon = lexicon if lexicon is not None else shipped_lexicon()

    def read(self, i: int) -> tuple[Measure, int] | None:
        """Return the measure that begins at token i (qualifiers included) and the next index."""
        approximate = False
        bound = Bound.EXACTLY
        j = i
        while True:
            qualifier = self._lexicon.longest_of(
                self._words, j, (Tag.AT_LEAST, Tag.AT_MOST, Tag.APPROXIMATE)
            )
            if qualifier is None:
                break
            length, sense = qualifier
            if sense.tag is Tag.APPROXIMATE:
                approximate = True
            else:
                bound = Bound.AT_LEAST if sense.tag is Tag.AT_LEAST else Bound.AT_MOST
            j += length
        if self._word(j) in ('exactly', 'precisely', 'just', 'only', 'another') and self._number(
            j + 1
        ):
            j += 1
        if self._is_stressed(j) and self._number(j + 2) is not None:
            j += 2
        ranged = self._word(j) == 'between'
        core = self._core(j + 1 if ranged else j, between=ranged)
        if core is None:
            return None
        measure, k = core
        if self._word(j - 1) == '±' or self._words[max(j - 3, 0) : j] == ['+', '/', '-']:
            measure = replace(measure, dimension=UNREADABLE)  # `40 m altitude ± 5 m`
        k, late_bound, late_approximate = self._trailing(k)
        if late_bound is not Bound.EXACTLY:
            bound = late_bound
        return (
            replace(measure, bound=bound, approximate=approximate or late_approximate),
            k,
        )

    def _word(self, i: int) -> str:
        return self._words[i] if 0 <= i < len(self._words) else ''

    def _trailing(self, k: int) -> tuple[int, Bound, bool]:
        found = self._lexicon.longest_of(
            self._words, k, (Tag.AFTER_APPROXIMATE, Tag.AFTER_AT_LEAST, Tag.AFTER_AT_MOST)
        )
        if found is None:
            return k, Bound.EXACTLY, False
        length, sense = found
        if self._number(k + length) is not None:  # `at least` belongs to the number behind it
            return k, Bound.EXACTLY, False
        if sense.tag is Tag.AFTER_APPROXIMATE:
            return k + length, Bound.EXACTLY, True
        is_low = sense.tag is Tag.AFTER_AT_LEAST
        return k + length, Bound.AT_LEAST if is_low else Bound.AT_MOST, False

    def _one_in(self, j: int) -> tuple[Measure, int] | None:
        """`one in five packets`, `one out of ten messages`: a share."""
        if self._word(j) == 'every':
            return None
        if self._word(j) not in ('one', '1'):
            return None
        m = j + 2 if self._is_message(j + 1) else j + 1  # `one packet in ten`
        k = m + 1 if self._word(m) == 'in' else m + 2
        if self._word(m) != 'in' and (self._word(m), self._word(m + 1)) != ('out', 'of'):
            return None
        k += self._word(k) == 'every'
        whole = self._number(k)
        if whole is None or not whole.value or self._unit(whole.stop)[0] is not None:
            return None
        start, end = self._tokens[j].start, self._tokens[whole.stop - 1].end
        share = Measure(dimension=RATIO, value=float(1 / whole.value), start=start, end=end)
        return share, whole.stop

    def _is_message(self, j: int) -> bool:
        return self._lexicon.longest_of(self._words, j, (Tag.MESSAGE,)) is not None

    def is_part(self, j: int) -> bool:
        """Return whether an amount begins here: `a quarter of an hour`, `a full minute`."""
        if self._is_stressed(j):
            return True
        number = self._spelled(j)
        part = number is not None and number.value is not None and number.value < 1
        return (part and bool(number and number.value)) or self._share(j) is not None

    def _share(self, j: int) -> tuple[_Number, bool] | None:
        """`two thirds of a`, `a fifth of`: a part of a unit, or a share."""
        number = self._number(j)
        article = number is None and self._word(j) in ('a', 'an', 'one')
        stop = j + 1 if article else (number.stop if number is not None else j)
        part = self._lexicon.fractions.get(self._word(stop))
        if part is None or (number is not None and not number.value):
            return None
        many = self._word(stop).endswith('s') or self._word(stop) == 'halves'
        times = number.value if number is not None and number.value is not None else Fraction(1)
        if times.denominator != 1 or (times > 1) is not many or times > part:
            return None
        of = stop + 1
        if self._word(of) != 'of':
            return (_Number(times / part, of, True), True) if many else None
        unit = of + 2 if self._word(of + 1) in ('a', 'an', 'one') else of + 1
        if self._unit(unit)[0] is not None:
            return _Number(times / part, unit, True), False
        return _Number(times / part, of, True), True

    def _clock(self, j: int) -> tuple[Measure, int] | None:
        """`at second forty`, `at 0:45`, `at t=25`: a time after the start."""
        before = self._word(j - 1)
        start = self._tokens[j].start if j < len(self._tokens) else 0
        if self._word(j) in ('second', 'sec', 'minute') and before in _AT:
            counted = self._number(j + 1)
            if counted is None or counted.value is None or self._unit(counted.stop)[0]:
                return None
            factor = 60 if self._word(j) == 'minute' else 1
            end = self._tokens[counted.stop - 1].end
            seconds = float(counted.value * factor)
            return Measure(dimension=TIME, value=seconds, start=start, end=end), counted.stop
        number = self._number(j) if before in _AT or before in ('=', 't', '+') else None
        if number is None or j >= len(self._tokens):
            return None
        read = _CLOCK.fullmatch(self._tokens[j].norm)
        if read is not None and before in _AT:
            seconds = 60.0 * int(read[1]) + int(read[2])
            stop = j + 2 if self._word(j + 1) in ('min', 'minutes', 'h', 's') else j + 1
            end = self._tokens[stop - 1].end
            return Measure(dimension=TIME, value=seconds, start=start, end=end), stop
        named = 't' in (before, self._word(j - 2), self._word(j - 3)) and before not in _AT
        if named and number.value is not None and self._unit(number.stop)[0] is None:
            end = self._tokens[number.stop - 1].end
            seconds = float(number.value)
            return Measure(dimension=TIME, value=seconds, start=start, end=end), number.stop
        return None

    def starts_clock(self, j: int) -> bool:
        """Return whether a time after the start begins here: `second 15` counts nobody."""
        return self._clock(j) is not None

    def _core(self, j: int, *, between: bool) -> tuple[Measure, int] | None:
        share = self._one_in(j) or self._clock(j)
        if share is not None:
            return share
        part = self._share(j)
        if part is not None and part[1] and part[0].value is not None:
            start, end = self._tokens[j].start, self._tokens[part[0].stop - 1].end
            value = float(part[0].value)
            return Measure(dimension=RATIO, value=value, start=start, end=end), part[0].stop
        first = part[0] if part is not None else self._number(j) or self._article(j)
        if first is None:
            return None
        unit, k = self._unit(first.stop)
        if unit is None and self._glued_letters(first.stop):
            return self._unreadable(j, first.stop + 1)
        if first.value is None:
            return self._unreadable(j, k)
        end = self._tokens[k - 1].end
        start = self._tokens[j].start
        link = self._word(k)
        joins_range = (between and link == 'and') or (
            not between
            and link in ('-', 'to')
            and self._word(j - 1) != 'from'
            and self._number(k + 1) is not None
            and self._word(k + 2) != 'another'
        )
        joins_size = link in ('x', 'by', 'times') and self._number(k + 1) is not None
        spread = self._plus_minus(first, unit, k, start)
        if spread is not None:
            return spread
        if joins_range or joins_size:
            other = self._number(k + 1)
            if other is not None:
                unit2, k2 = self._unit(other.stop)
                unit = unit if unit is not None else unit2
                if other.value is None:
                    return self._unreadable(j, k2)
                if unit2 is not None and self._dimension(unit) != self._dimension(unit2):
                    return self._single(first, unit, start, end), k
                scale2 = self._factor(unit2 if unit2 is not None else unit)
                value = float(first.value * self._factor(unit))
                value2 = float(other.value * scale2)
                end = self._tokens[k2 - 1].end
                dimension = self._dimension(unit)
                if joins_range:
                    if value2 <= value:
                        return self._unreadable(j, k2)
                    return (
                        Measure(
                            dimension=dimension, value=value, upper=value2, start=start, end=end
                        ),
                        k2,
                    )
                return (
                    Measure(
                        dimension=LENGTH if dimension == COUNT else dimension,
                        value=value,
                        second=value2,
                        start=start,
                        end=end,
                        second_start=self._tokens[k + 1 if unit2 is not None else j].start,
                    ),
                    k2,
                )
        if between:
            return None
        if unit is not None and self._dimension(unit) in (TIME, LENGTH):
            added = self._more_time(k)
            if added is not None:
                extra, k = added
                total = float(first.value * self._factor(unit) + extra)
                end = self._tokens[k - 1].end
                dimension = self._dimension(unit)
                return Measure(dimension=dimension, value=total, start=start, end=end), k
        return self._single(first, unit, start, end), k

    def _plus_minus(
        self, first: _Number, unit: str | None, k: int, start: int
    ) -> tuple[Measure, int] | None:
        """`40 m ± 2 m`, `40 +/- 2 m`, `40 m plus or minus 5 %`: from 38 to 42."""
        sign = next((s for s in _SIGNS if tuple(self._words[k : k + len(s)]) == s), None)
        by = self._number(k + len(sign)) if sign is not None else None
        if by is None or by.value is None or first.value is None:
            return None
        unit2, stop = self._unit(by.stop)
        unit = unit if unit is not None else unit2
        value = first.value * self._factor(unit)
        delta = by.value * self._factor(unit2 if unit2 is not None else unit)
        if self._dimension(unit2) == RATIO and self._dimension(unit) != RATIO:
            delta *= value
        elif unit2 is not None and self._dimension(unit2) != self._dimension(unit):
            return None
        if not 0 < delta < value:
            return None
        return (
            Measure(
                dimension=self._dimension(unit),
                value=float(value - delta),
                upper=float(value + delta),
                start=start,
                end=self._tokens[stop - 1].end,
            ),
            stop,
        )

    def _single(self, first: _Number, unit: str | None, start: int, end: int) -> Measure:
        assert first.value is not None
        return Measure(
            dimension=self._dimension(unit),
            value=float(first.value * self._factor(unit)),
            start=start,
            end=end,
        )

    def _unreadable(self, j: int, k: int) -> tuple[Measure, int]:
        return (
            Measure(
                dimension=UNREADABLE,
                value=0.0,
                start=self._tokens[j].start,
                end=self._tokens[k - 1].end,
            ),
            k,
        )

    def _glued_letters(self, i: int) -> bool:
        """`5G`: letters glued to a number that are no unit."""
        if i >= len(self._tokens):
            return False
        token = self._tokens[i]
        return (
            token.glued
            and token.kind is TokenKind.WORD
            and self._tokens[i - 1].kind is TokenKind.NUMBER
            and token.norm != 'x'
        )

    def _more_time(self, k: int) -> tuple[Fraction, int] | None:
        """`1 min 30 s`, `one minute and thirty seconds`, `a metre and a half`."""
        if self._word(k) == 'and' and self._word(k + 1) == 'a' and self._word(k + 2) == 'half':
            unit = self._lexicon.longest_of(self._words, k - 1, (Tag.UNIT,))
            if unit is not None:
                return self._factor(unit[1].key) / 2, k + 3
        m = k + 1 if self._word(k) == 'and' else k
        number = self._number(m)
        if number is None or number.value is None:
            return None
        unit_key, stop = self._unit(number.stop)
        before = self._lexicon.longest_of(self._words, k - 1, (Tag.UNIT,))
        if unit_key is None or before is None or self._dimension(unit_key) != TIME:
            return None
        if self._factor(unit_key) >= self._factor(before[1].key):
            return None
        return number.value * self._factor(unit_key), stop

    def _article(self, j: int) -> _Number | None:
        """`a minute`; `a second` is left to the ordinals unless a preposition precedes."""
        if self._is_stressed(j):
            return _Number(Fraction(1), j + 2, True)
        if self._is_once(j):
            return _Number(Fraction(1), j + (self._word(j) == 'once'), True)
        if self._word(j) not in ('a', 'an', 'another'):
            return None
        unit = self._lexicon.longest_of(self._words, j + 1, (Tag.UNIT,))
        if unit is None or len(self._word(j + 1)) < 3:
            return None
        if self._dimension(unit[1].key) not in (TIME, LENGTH):
            return None
        before = self._words[j - 1] if j > 0 else ''
        if self._word(j + 1) == 'second' and before not in (
            'for',
            'within',
            'after',
            'of',
            'every',
        ):
            return None
        return _Number(Fraction(1), j + 1, True)

    def _is_once(self, j: int) -> bool:
        """`once per second`, `every second` where no noun follows."""
        if self._word(j) == 'once':
            return self._dimension(self._unit(j + 1)[0]) == RATE
        if self._word(j - 1) != 'every' or self._word(j) not in ('second', 'minute'):
            return False
        ends = j + 1 >= len(self._tokens) or self._tokens[j + 1].kind is not TokenKind.WORD
        return ends or self._lexicon.longest_of(self._words, j + 1, _JOINS) is not None

    def _is_stressed(self, j: int) -> bool:
        """`a full minute`, `another good 40 m`."""
        if (
            self._word(j) not in ('a', 'an', 'one', 'another', 'the')
            or self._word(j + 1) not in _EMPHASIS
        ):
            return False
        number = self._number(j + 2)
        return self._unit(number.stop if number is not None else j + 2)[0] is not None

    def _unit(self, i: int) -> tuple[str | None, int]:
        if self._word(i) in _WHOLE:
            i += 1  # `two full minutes`
        found = self._lexicon.longest_of(self._words, i, (Tag.UNIT,))
        if found is None:
            return None, i
        length, sense = found
        if self._names_a_thing(i, length):
            return None, i
        return sense.key, i + length

    def _names_a_thing(self, i: int, length: int) -> bool:
        """`r 60 h 50`: a letter in front of a number of its own is no unit."""
        thing = self._lexicon.longest_of(self._words, i, (Tag.THING,))
        if thing is None or length > 1 or self._tokens[i].glued:
            return False
        follows = i + 2 if self._word(i + 1) == '=' else i + 1
        return self._number(follows) is not None

    def _dimension(self, unit: str | None) -> str:
        return COUNT if unit is None else self._lexicon.units[unit].dimension

    def _factor(self, unit: str | None) -> Fraction:
        return Fraction(1) if unit is None else self._lexicon.units[unit].factor

    def _number(self, i: int) -> _Number | None:
        if i >= len(self._tokens):
            return None
        token = self._tokens[i]
        if token.kind is TokenKind.NUMBER:
            if token.value is not None and self._word(i + 1) in ('hundred', 'thousand'):
                factor = 100 if self._word(i + 1) == 'hundred' else 1000
                return _Number(token.value * factor, i + 2, False)
            return _Number(token.value, i + 1, False)
        return self._spelled(i)

    def _spelled(self, i: int) -> _Number | None:
        """`forty five`, `a hundred and twenty`."""
        found = spelled(self._words, i, self._lexicon)
        return None if found is None else _Number(found[0], found[1], True)
