# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Mutations of prompts: what careless people, bad clipboards and other languages make of them."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence

Mutation = Callable[[random.Random, str, Sequence[str]], str]

_NUMBER = re.compile(r'\d+(?:\.\d+)?')
_UNIT = re.compile(
    r'(?<=[\d ])(?:m/s|km/h|mph|ft|feet|meters|metres|m|seconds|s|minutes|min|%)(?!\w)'
)
_UNITS = ('m', 'ft', 'km', 's', 'ms', 'min', 'h', 'm/s', 'km/h', 'mph', '%', 'deg', 'kg', 'V', '')
_STRANGE = (
    '0', '-5', '-0', 'NaN', 'inf', '-inf', '1e309', '1e-9', '999999999999', '3,5', '1/2', '10:30',
    '0x1F', '½', '٤٠', '４０', '1.2.3', '1,200', '--4', '+7', '1e3', '²', 'five', 'twenty-one',
)  # fmt: skip
_CHARACTERS = (
    '\u200b', '\u202e', '\ufeff', '\u0301', '\u00ad', '\x07', '\x1b[31m', '\t', '\r\n', '\n\n',
    '’', '“', '—', '−', '×', '°', 'é', 'ß', '中', '🚁', '\U000e0041', '\u2028', '%s', '{}',
    '\\', '`', '$(',
)  # fmt: skip
_FOREIGN = (
    'Eine Drohne verfolgt den Bus in 40 m Höhe. ',
    'Un dron sigue al autobús a 30 metros. ',
    'Le drone suit le bus à 25 m. ',
    '无人机在40米高度跟随公共汽车。',
    'الطائرة تتبع الحافلة على ارتفاع 40 م. ',
    'ドローンはバスを追跡する。',
)
_ASIDES = (
    ' unless it rains', ' twice', ' exactly', ' not', ' 3 more', ' at the same height',
    ', except on Sundays', ' for 1,5 minutes', ' every 10 s', ' (or 50 m)', ' and the other 7 too',
    ' within the first 8 s', ' no more than 12 m', ' half as fast', ' 20 m less than before',
)  # fmt: skip


def _place(draw: random.Random, text: str) -> int:
    return draw.randrange(len(text)) if text else 0


def drop_character(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    at = _place(draw, text)
    return text[:at] + text[at + 1 :]


def double_character(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    at = _place(draw, text)
    return text[: at + 1] + text[at:]


def swap_characters(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    at = _place(draw, text)
    return text[:at] + text[at : at + 2][::-1] + text[at + 2 :]


def insert_character(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    at = _place(draw, text)
    return text[:at] + draw.choice(_CHARACTERS) + text[at:]


def _with_words(change: Callable[[random.Random, list[str]], None]) -> Mutation:
    def mutate(draw: random.Random, text: str, _all: Sequence[str]) -> str:
        words = text.split(' ')
        change(draw, words)
        return ' '.join(words)

    return mutate


def _drop_word(draw: random.Random, words: list[str]) -> None:
    del words[draw.randrange(len(words))]


def _repeat_word(draw: random.Random, words: list[str]) -> None:
    at = draw.randrange(len(words))
    words.insert(at, words[at])


def _move_word(draw: random.Random, words: list[str]) -> None:
    word = words.pop(draw.randrange(len(words)))
    words.insert(draw.randint(0, len(words)), word)


def change_number(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    found = list(_NUMBER.finditer(text))
    if not found:
        return text + ' ' + draw.choice(_STRANGE) + ' m'
    one = draw.choice(found)
    new = draw.choice((*_STRANGE, str(draw.randint(0, 500)), f'{draw.uniform(0, 200):.2f}'))
    return text[: one.start()] + new + text[one.end() :]


def change_unit(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    found = list(_UNIT.finditer(text))
    if not found:
        return change_number(draw, text, _all)
    one = draw.choice(found)
    return text[: one.start()] + draw.choice(_UNITS) + text[one.end() :]


def glue_prompts(draw: random.Random, text: str, every: Sequence[str]) -> str:
    return text + draw.choice((' ', '. ', ', and ', '', ' but ', '\n')) + draw.choice(every)


def reorder_clauses(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    parts = re.split(r'(?<=[.,;])\s+', text)
    draw.shuffle(parts)
    return ' '.join(parts)


def foreign_words(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    foreign = draw.choice(_FOREIGN)
    return draw.choice((foreign + text, text + ' ' + foreign, foreign))


def add_aside(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    words = text.split(' ')
    words.insert(draw.randint(1, len(words)), draw.choice(_ASIDES).strip())
    return ' '.join(words)


def change_case(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    return draw.choice((text.upper(), text.lower(), text.title(), text.swapcase()))


def strip_marks(_draw: random.Random, text: str, _all: Sequence[str]) -> str:
    return re.sub(r'[.,;:!?]', '', text)


def blow_up(draw: random.Random, text: str, _all: Sequence[str]) -> str:
    return draw.choice((text * draw.randint(2, 60), text + '(' * 3000, 'and ' * 2000 + text))


MUTATIONS: dict[str, Mutation] = {
    'drop_character': drop_character,
    'double_character': double_character,
    'swap_characters': swap_characters,
    'insert_character': insert_character,
    'drop_word': _with_words(_drop_word),
    'repeat_word': _with_words(_repeat_word),
    'move_word': _with_words(_move_word),
    'change_number': change_number,
    'change_unit': change_unit,
    'glue_prompts': glue_prompts,
    'reorder_clauses': reorder_clauses,
    'foreign_words': foreign_words,
    'add_aside': add_aside,
    'change_case': change_case,
    'strip_marks': strip_marks,
    'blow_up': blow_up,
}
# Prompts of many kilobytes take a hundred times as long: some of them are enough.
_RARE = frozenset({'blow_up'})
_RARE_SHARE = 0.05


def mutated(draw: random.Random, prompts: Sequence[str]) -> tuple[tuple[str, ...], str]:
    """Return the names of the mutations and the mutated prompt: one to three changes."""
    text = draw.choice(prompts)
    names: list[str] = []
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3))):
        name = draw.choice(tuple(MUTATIONS))
        if name in _RARE and draw.random() > _RARE_SHARE:
            name = 'change_number'
        text = MUTATIONS[name](draw, text, prompts)
        names.append(name)
    return tuple(names), text
