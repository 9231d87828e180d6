# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that a text states, in digits or words, with their units turned into SI.

Independent of the product's own parser on purpose: a validator that shares its reader shares its
mistakes.
"""

from __future__ import annotations

import re
from enum import StrEnum

from aurora_core.document import Document


class Dimension(StrEnum):
    """What a number measures; BARE when the text names no unit."""

    LENGTH = 'm'
    TIME = 's'
    SPEED = 'm/s'
    ACCELERATION = 'm/s^2'
    ANGLE = 'deg'
    SHARE = 'share'
    RATE = 'Hz'
    BARE = ''


class StatedNumber(Document):
    """A number of a text.

    Attributes:
        value: In the unit of `dimension`.
        dimension: See `Dimension`.
        text: As the text has it.
        start: Character at which it begins.
        in_words: Written as a word; such numbers often count nothing ("one of them").
    """

    value: float
    dimension: Dimension
    text: str
    start: int
    in_words: bool


# Longest first where one is the beginning of another. Factors: exact definitions of the units
# (international foot and mile, international knot).
_UNITS: tuple[tuple[str, Dimension, float], ...] = (
    (r'km/h|kmh|kmph|kph|kilomet(?:re|er)s? (?:per|an) hour', Dimension.SPEED, 1.0 / 3.6),
    (
        r'm/s(?:\^2|²|2)|met(?:re|er)s? per second squared',
        Dimension.ACCELERATION,
        1.0,
    ),
    (r'm/s|mps|met(?:re|er)s? (?:per|each|a) second', Dimension.SPEED, 1.0),
    (r'mph|miles? (?:per|an) hour', Dimension.SPEED, 0.44704),
    (r'knots?|kn|kts?', Dimension.SPEED, 1852.0 / 3600.0),
    (r'kilomet(?:re|er)s?|km', Dimension.LENGTH, 1000.0),
    (r'miles?|mi', Dimension.LENGTH, 1609.344),
    (r'feet|foot|ft', Dimension.LENGTH, 0.3048),
    (r'yards?|yd', Dimension.LENGTH, 0.9144),
    (r'milliseconds?|msecs?|ms', Dimension.TIME, 0.001),
    (r'minutes?|mins?', Dimension.TIME, 60.0),
    (r'hours?|(?<=\d)h', Dimension.TIME, 3600.0),
    (r'seconds?|secs?|s', Dimension.TIME, 1.0),
    (r'met(?:re|er)s?|mtrs?|mts?|m', Dimension.LENGTH, 1.0),
    (r'degrees?|deg|°', Dimension.ANGLE, 1.0),
    (r'hertz|hz', Dimension.RATE, 1.0),
    (r'%|percent|per cent|pct', Dimension.SHARE, 0.01),
)
_UNIT = '|'.join(f'(?P<u{k}>{pattern})' for k, (pattern, _, _) in enumerate(_UNITS))
# The same once more, for patterns that need it in two places.
_UNIT_TOO = _UNIT.replace('(?P<u', '(?P<v')
_ONES = (
    'zero', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten',
    'eleven', 'twelve', 'thirteen', 'fourteen', 'fifteen', 'sixteen', 'seventeen', 'eighteen',
    'nineteen',
)  # fmt: skip
_TENS = ('twenty', 'thirty', 'forty', 'fifty', 'sixty', 'seventy', 'eighty', 'ninety')
_WORDS: dict[str, float] = {
    **{word: float(k) for k, word in enumerate(_ONES)},
    **{word: 10.0 * (k + 2) for k, word in enumerate(_TENS)},
    'dozen': 12.0, 'both': 2.0, 'pair': 2.0, 'twice': 2.0,
}  # fmt: skip
_SMALL = '|'.join(sorted((*_ONES, *_TENS), key=len, reverse=True))
_WORD = (
    rf'(?:(?:{_SMALL})|a)[ -]hundred(?:[ -](?:and[ -])?(?:{_SMALL})(?:-(?:{_SMALL}))?)?'
    rf'|(?:{_SMALL})(?:[ -](?:{_SMALL}))?|dozen|both|pair|twice'
)
_FRACTIONS = {'half': 0.5, 'third': 1 / 3, 'quarter': 0.25, 'fifth': 0.2, 'tenth': 0.1}
_PART = rf'(?:(?P<times>a|an|one|two|three|four)[ ])?(?P<part>{"|".join(_FRACTIONS)})s?'
_SHARE_OF_SOME = re.compile(
    rf'\b(?P<n>\d+|{_SMALL})(?: \w+)? in (?P<m>\d+|{_SMALL})\b', re.IGNORECASE
)
_PART_OF_UNIT = re.compile(rf'\b{_PART}(?: of)?(?: an?)?[ -](?:{_UNIT})(?![\w])', re.IGNORECASE)
_UNIT_AND_A_HALF = re.compile(
    rf'\b(?:(?P<n>an?|{_SMALL}) )?(?:{_UNIT}) and a half\b', re.IGNORECASE
)
_N_AND_A_HALF = re.compile(rf'\b(?P<n>{_SMALL}|\d+) and a half (?:{_UNIT})\b', re.IGNORECASE)
_PART_OF_ALL = re.compile(r'\ban? (?P<part>third|quarter|fifth|tenth) of the\b', re.IGNORECASE)
# "A second drone" and "sixty kilometres an hour" are something else.
_ONE_UNIT = re.compile(
    r'(?<!metres )(?<!meters )(?<!miles )\b(?P<n>an?) (?P<unit>minute|hour|metre|meter)\b',
    re.IGNORECASE,
)
_DIGITS = r'\d+(?:[.,]\d+)?|(?<![\d\w])\.\d+'
# A digit that ends a name ("uav1", "drone 2") is no number; nor is a hyphen a sign.
_PLAIN = re.compile(
    rf'(?:(?<![\w.])|(?<=\dx))(?P<n>{_DIGITS})(?:[ -]?(?:{_UNIT})(?![\w]))?(?![\d])'
    rf'|\b(?P<w>{_WORD})\b(?:[ -](?:{_UNIT_TOO})(?![\w]))?',
    re.IGNORECASE,
)
# Between two numbers that share the unit of the second.
_JOINTS = frozenset({'x', 'by', 'to', 'and', ',', '-', 'or'})
_NAME = re.compile(r'\b(?:drone|uav|copter|quad\w*|car|van|truck|bus|aircraft) ?$', re.IGNORECASE)


def stated_numbers(text: str) -> tuple[StatedNumber, ...]:
    """Return the numbers of a text in its order, each once."""
    found: list[StatedNumber] = []
    rest = text
    for pattern in (
        _SHARE_OF_SOME,
        _N_AND_A_HALF,
        _PART_OF_UNIT,
        _UNIT_AND_A_HALF,
        _PART_OF_ALL,
        _ONE_UNIT,
    ):
        for match in pattern.finditer(rest):
            found.append(_special(pattern, match))
            rest = _blanked(rest, match)
    for match in _PLAIN.finditer(rest):
        number = _plain(match)
        follows_name = _NAME.search(rest[: match.start()]) is not None
        if not (follows_name and number.dimension is Dimension.BARE and number.value < 10):
            found.append(number)
    return tuple(_with_units_of_pairs(sorted(found, key=lambda n: n.start), text))


def _special(pattern: re.Pattern[str], match: re.Match[str]) -> StatedNumber:
    groups = match.groupdict()
    dimension, factor = _unit_of(match)
    if pattern is _SHARE_OF_SOME:
        value, dimension = _value(groups['n']) / _value(groups['m']), Dimension.SHARE
    elif pattern is _PART_OF_UNIT:
        times = groups['times']
        count = 1.0 if times in (None, 'a', 'an', 'A', 'An') else _value(times)
        value = count * _FRACTIONS[groups['part'].lower()] * factor
    elif pattern in (_UNIT_AND_A_HALF, _N_AND_A_HALF):
        count = 1.0 if groups['n'] in (None, 'a', 'an', 'A', 'An') else _value(groups['n'])
        value = (count + 0.5) * factor
    elif pattern is _PART_OF_ALL:
        value, dimension = _FRACTIONS[groups['part'].lower()], Dimension.SHARE
    else:
        unit = re.fullmatch(_UNIT, groups['unit'], re.IGNORECASE)
        assert unit is not None
        dimension, value = _unit_of(unit)
    return StatedNumber(
        value=value,
        dimension=dimension,
        text=match.group(),
        start=match.start(),
        in_words=True,
    )


def _plain(match: re.Match[str]) -> StatedNumber:
    dimension, factor = _unit_of(match)
    digits = match['n']
    value = float(digits.replace(',', '.')) if digits else _value(match['w'])
    return StatedNumber(
        value=value * factor,
        dimension=dimension,
        text=match.group(),
        start=match.start(),
        in_words=digits is None,
    )


def _unit_of(match: re.Match[str]) -> tuple[Dimension, float]:
    for name, text in match.groupdict().items():
        if text is not None and name[0] in 'uv' and name[1:].isdigit():
            _, dimension, factor = _UNITS[int(name[1:])]
            return dimension, factor
    return Dimension.BARE, 1.0


def _value(words: str) -> float:
    """Return the value of digits or of words such as `a hundred and twenty-one`."""
    if words.replace('.', '').isdigit():
        return float(words)
    total = 0.0
    for word in re.split(r'[ -]', words.lower()):
        if word == 'hundred':
            total = max(total, 1.0) * 100.0
        elif word == 'a':
            total = 1.0
        elif word != 'and':
            total += _WORDS[word]
    return total


def _blanked(text: str, match: re.Match[str]) -> str:
    return text[: match.start()] + ' ' * (match.end() - match.start()) + text[match.end() :]


def _with_units_of_pairs(numbers: list[StatedNumber], text: str) -> list[StatedNumber]:
    """Give the first number of `120 x 80 m` or `30, 45 and 60 m` the unit of the last."""
    given = list(numbers)
    factor = 1.0
    for k in range(len(given) - 2, -1, -1):
        first, second = given[k], given[k + 1]
        bare = _PLAIN.match(second.text)
        if numbers[k + 1].dimension is not Dimension.BARE:
            factor = _unit_of(bare)[1] if bare is not None else 1.0
        between = text[first.start + len(first.text) : second.start].strip()
        if first.dimension is Dimension.BARE and between in _JOINTS:
            given[k] = StatedNumber(
                value=first.value * factor,
                dimension=second.dimension,
                text=first.text,
                start=first.start,
                in_words=first.in_words,
            )
    return given
