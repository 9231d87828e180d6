# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Mutations of model replies: cut, mistyped, invented, chatty, nested, huge."""

from __future__ import annotations

import copy
import json
import random
from collections.abc import Callable, Iterator
from typing import Any

Json = Any
Mutation = Callable[[random.Random, Json], str]

_VALUES: tuple[Json, ...] = (
    None, True, -1, 0, 1e308, 'NaN', '', 'ignore all rules', [], {}, [[[]]], {'a': {'b': 1}},
    '40 m', 10**40, 'uav99', '\x00', '💥',
)  # fmt: skip


def _places(value: Json) -> Iterator[tuple[Json, Any]]:
    """Return every container and key of a document."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield value, key
            yield from _places(inner)
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield value, k
            yield from _places(inner)


def _numbers(value: Json) -> list[tuple[Json, Any]]:
    return [
        (box, key)
        for box, key in _places(value)
        if isinstance(box[key], int | float) and not isinstance(box[key], bool)
    ]


def _edited(change: Callable[[random.Random, Json], None]) -> Mutation:
    def mutate(draw: random.Random, answer: Json) -> str:
        changed = copy.deepcopy(answer)
        change(draw, changed)
        return json.dumps(changed, ensure_ascii=False)

    return mutate


def cut(draw: random.Random, answer: Json) -> str:
    text = json.dumps(answer)
    return text[: draw.randrange(len(text))]


def flip_character(draw: random.Random, answer: Json) -> str:
    text = json.dumps(answer)
    at = draw.randrange(len(text))
    return text[:at] + draw.choice('{}[]",:0xé\x01 ') + text[at + 1 :]


def _wrong_type(draw: random.Random, answer: Json) -> None:
    box, key = draw.choice(list(_places(answer)))
    box[key] = draw.choice(_VALUES)


def _change_number(draw: random.Random, answer: Json) -> None:
    found = _numbers(answer)
    if found:
        box, key = draw.choice(found)
        box[key] = draw.choice((box[key] + 1, -box[key], box[key] * 10, 0, 1e9, box[key] + 0.5))


def _drop(draw: random.Random, answer: Json) -> None:
    box, key = draw.choice(list(_places(answer)))
    del box[key]


def _extra_field(draw: random.Random, answer: Json) -> None:
    boxes = [box for box, _ in _places(answer) if isinstance(box, dict)]
    draw.choice(boxes)[draw.choice(('note', 'speed_mps', 'altitude_m', 'x', 'id'))] = draw.choice(
        (*_VALUES, {'value': 55, 'unit': 'm', 'quote': '55 m'})
    )


def _invented_agent(draw: random.Random, answer: Json) -> None:
    kind = draw.choice(('car', 'bus', 'pedestrian', 'rsu', 'dragon'))
    said = draw.choice(('a car', 'the ego', 'a bus', 'a drone', ''))
    answer.setdefault('agents', []).append({'id': f'{kind}77', 'type': kind, 'quote': said})


def _invented_uav(_draw: random.Random, answer: Json) -> None:
    answer.setdefault('uavs', []).append({'id': 'uav77', 'quote': 'a drone'})


def _swap_quotes(draw: random.Random, answer: Json) -> None:
    quotes = [(b, k) for b, k in _places(answer) if k == 'quote']
    (one, a), (two, b) = draw.choice(quotes), draw.choice(quotes)
    one[a], two[b] = two[b], one[a]


def _repeat(draw: random.Random, answer: Json) -> None:
    lists = [b[k] for b, k in _places(answer) if isinstance(b[k], list) and b[k]]
    if lists:
        one = draw.choice(lists)
        one.extend(copy.deepcopy(one) * draw.choice((1, 1, 3, 300)))


def chatter(draw: random.Random, answer: Json) -> str:
    text = json.dumps(answer)
    return draw.choice(
        (
            f'Sure! Here you go:\n```json\n{text}\n```\nAnything else?',
            f'{{"thought": "hm"}} {text} {text}',
            f'```\n{text}',
            f'<think>{text[:40]}</think>{text}',
            f'{text}\n{{"clauses": []}}',
            "I'm sorry, I cannot help with drones.",
        )
    )


def deep(draw: random.Random, answer: Json) -> str:
    depth = draw.choice((50, 1_000, 100_000))
    nested = '[' * depth + ']' * depth
    return draw.choice((nested, json.dumps(answer)[:-1] + f', "x": {nested}}}', '{"a":' * depth))


def huge(draw: random.Random, answer: Json) -> str:
    text = json.dumps(answer)
    return draw.choice((text + ' ' * 300_000, 'x' * 300_000 + text, '{' * 50_000 + text))


MUTATIONS: dict[str, Mutation] = {
    'cut': cut,
    'flip_character': flip_character,
    'wrong_type': _edited(_wrong_type),
    'change_number': _edited(_change_number),
    'drop': _edited(_drop),
    'extra_field': _edited(_extra_field),
    'invented_agent': _edited(_invented_agent),
    'invented_uav': _edited(_invented_uav),
    'swap_quotes': _edited(_swap_quotes),
    'repeat': _edited(_repeat),
    'chatter': chatter,
    'deep': deep,
    'huge': huge,
}


def mutated(draw: random.Random, answer: Json) -> tuple[str, str]:
    """Return the name of the mutation and the text of the mutated reply."""
    name = draw.choice(tuple(MUTATIONS))
    return name, MUTATIONS[name](draw, answer)
