# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a prompt against the numbers of its annotation, both ways."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import (
    AgentRequirement,
    AnnotatedPrompt,
    Requirement,
    UavRequirement,
    beyond,
    everything,
    flat,
)
from aurora_bench.prompts.numerals import Dimension, StatedNumber, stated_numbers
from aurora_core.document import Document

# Rounding in an annotation, e.g. 500 ft as 152.4 m.
_RELATIVE = 0.005
_SHARES = frozenset({'loss', 'fraction'})
_BARE_FIELDS = frozenset({'count', 'waypoint_count', 'retransmissions', 'turns'})
# Degrees between the points of the compass that have names.
_COMPASS_DEG = 22.5


class AnnotatedNumber(Document):
    """A number of an annotation.

    Attributes:
        value: In the unit of `dimension`.
        dimension: BARE for counts.
        path: Requirement and field.
        is_required: The prompt has to state it (ends of a range need not be there).
    """

    value: float
    dimension: Dimension
    path: str
    is_required: bool


def check_numbers(prompt: AnnotatedPrompt) -> Iterator[Finding]:
    """Find annotated numbers that the prompt does not state, and stated ones left out."""
    if prompt.feasibility == 'infeasible':
        return
    stated = stated_numbers(prompt.prompt)
    annotated = list(annotated_numbers(prompt))
    for number in annotated:
        if not number.is_required or any(_same(s, number) for s in stated):
            continue
        inside = [s for s in stated if _in_variation(prompt, number, s)]
        if inside or _derived(number, stated):
            yield Finding(
                where=prompt.id,
                rule=Rule.DERIVED,
                text=f'{number.path} = {number.value:g} follows from what is stated',
                is_error=False,
            )
        else:
            yield Finding(
                where=prompt.id,
                rule=Rule.NOT_STATED,
                text=f'{number.path} = {number.value:g} {number.dimension} is not in the prompt',
            )
    totals = _totals(prompt)
    for s in stated:
        if any(_same(s, number) for number in annotated) or _is_used(prompt, s, annotated, stated):
            continue
        if s.dimension is Dimension.BARE and (s.value in totals or s.value in (0.0, 1.0)):
            continue
        yield Finding(
            where=prompt.id,
            rule=Rule.NOT_ANNOTATED,
            text=f'{s.text!r} of the prompt is in no requirement',
            is_error=not (_is_idle_word(s) or _is_taken_back(prompt.prompt, s)),
        )


def _is_idle_word(stated: StatedNumber) -> bool:
    return stated.in_words and stated.dimension is Dimension.BARE


def _is_taken_back(text: str, stated: StatedNumber) -> bool:
    """Whether the speaker corrects himself ("40 m… no, let me say 30 m")."""
    after = text[stated.start + len(stated.text) :][:20]
    return re.search(r'\b(?:no|sorry|rather),', after) is not None


def annotated_numbers(prompt: AnnotatedPrompt) -> Iterator[AnnotatedNumber]:
    """Return every number of a prompt's requirements and variations."""
    for requirement in flat(prompt.requirements):
        for path, value in numbers_at(requirement):
            field = field_of(path)
            is_one_of_a_kind = field == 'count' and value == 1
            is_line = path.endswith('size_m.1') and value == 0
            if '.tol' in path or is_one_of_a_kind or is_line:
                continue
            yield AnnotatedNumber(
                value=value,
                dimension=_dimension(path, requirement),
                path=path,
                is_required=_needs_a_number(path, value, requirement),
            )
    for number in (n for r in beyond(prompt) for n in stated_numbers(r.text)):
        yield AnnotatedNumber(
            value=number.value, dimension=number.dimension, path='beyond', is_required=False
        )
    by_id = {r.id: r for r in everything(prompt.requirements)}
    for path, ends in prompt.variation.items():
        dimension = _dimension(path, by_id.get(path.split('.')[0]))
        for end in ends:
            yield AnnotatedNumber(value=end, dimension=dimension, path=path, is_required=False)


def numbers_at(requirement: Requirement) -> Iterator[tuple[str, float]]:
    """Return every number of a requirement with its path, tolerances included."""
    yield from _walk(requirement.model_dump(exclude_none=True), requirement.id)


def _walk(value: object, path: str) -> Iterator[tuple[str, float]]:
    if isinstance(value, dict):
        for name, item in value.items():
            yield from _walk(item, f'{path}.{name}')
    elif isinstance(value, list | tuple):
        for k, item in enumerate(value):
            yield from _walk(item, f'{path}.{k}')
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, float(value)


def field_of(path: str) -> str:
    """Return the field that a path such as `r6.size_m.0` leads to, here `size_m`."""
    return next(part for part in reversed(path.split('.')) if not part.isdigit())


def _none_and_all(field: str) -> tuple[float, ...]:
    return (0.0, 1.0) if field in (*_SHARES, 'value') else (0.0,)


def _needs_a_number(path: str, value: float, requirement: Requirement) -> bool:
    """Whether a prompt has to state it: "no drone", "all the time", "from the west" need none."""
    if getattr(requirement, 'field', None) == 'wind_from_deg' and value % _COMPASS_DEG == 0.0:
        return False
    return value not in _none_and_all(field_of(path))


def _dimension(path: str, requirement: Requirement | None) -> Dimension:
    field = field_of(path)
    if field in _BARE_FIELDS or getattr(requirement, 'kind', None) == 'count':
        return Dimension.BARE
    if field in _SHARES or path.endswith('.trigger.value'):
        return Dimension.SHARE
    if field == 'value':
        # The field of the world's name says its unit (wind_mps), that of a quantity does not.
        quantity = getattr(requirement, 'quantity', None)
        if quantity is None:
            return _by_ending(getattr(requirement, 'field', 'duration_s'))
        return {
            'speed': Dimension.SPEED,
            'wind': Dimension.SPEED,
            'vertical_speed': Dimension.SPEED,
            'deceleration': Dimension.ACCELERATION,
            'battery': Dimension.SHARE,
            'visible_time': Dimension.TIME,
            'delivery_latency': Dimension.TIME,
            'event_time': Dimension.TIME,
            'time_headway': Dimension.TIME,
            'time_to_collision': Dimension.TIME,
            'tracked_fraction': Dimension.SHARE,
            'visible_fraction': Dimension.SHARE,
            'delivery_ratio': Dimension.SHARE,
            'waypoints_visited': Dimension.BARE,
        }.get(quantity, Dimension.LENGTH)
    return _by_ending(field)


def _by_ending(field: str) -> Dimension:
    for ending, dimension in (
        ('_mps2', Dimension.ACCELERATION),
        ('_mps', Dimension.SPEED),
        ('_deg', Dimension.ANGLE),
        ('_hz', Dimension.RATE),
        ('_s', Dimension.TIME),
    ):
        if field.endswith(ending):
            return dimension
    return Dimension.LENGTH


def _same(stated: StatedNumber, annotated: AnnotatedNumber) -> bool:
    if stated.dimension not in (annotated.dimension, Dimension.BARE):
        return False
    return _close(stated.value, annotated.value)


def _close(a: float, b: float) -> bool:
    return abs(a - b) <= max(_RELATIVE * abs(b), 1e-6)


def _in_variation(prompt: AnnotatedPrompt, number: AnnotatedNumber, stated: StatedNumber) -> bool:
    """The middle of a stated range stands for it."""
    low_high = prompt.variation.get(number.path)
    if low_high is None or stated.dimension not in (number.dimension, Dimension.BARE):
        return False
    return any(_close(stated.value, end) for end in low_high)


def _derived(number: AnnotatedNumber, stated: tuple[StatedNumber, ...]) -> bool:
    """Half of a diameter, the rest of a share, a sum ("10 m higher"), a rate ("every 2 s")."""
    values = [s.value for s in stated if s.dimension in (number.dimension, Dimension.BARE)]
    results = [v / 2.0 for v in values] + [v * 2.0 for v in values]
    if number.dimension is Dimension.SHARE:
        results += [1.0 - v for v in values]
    if number.dimension is Dimension.RATE:
        periods = [s.value for s in stated if s.dimension is Dimension.TIME]
        results += [1.0 / period for period in periods if period > 0.0]
    results += [a + b for k, a in enumerate(values) for b in values[k + 1 :]]
    return any(_close(result, number.value) for result in results)


def _is_used(
    prompt: AnnotatedPrompt,
    stated: StatedNumber,
    annotated: list[AnnotatedNumber],
    others: tuple[StatedNumber, ...],
) -> bool:
    """Whether an annotated number follows from this one and no other states that number."""
    for number in annotated:
        if number.is_required and not any(_same(s, number) for s in others):
            if stated.dimension not in (number.dimension, Dimension.BARE):
                continue
            without = tuple(s for s in others if s is not stated)
            if _derived(number, others) and not _derived(number, without):
                return True
            if _in_variation(prompt, number, stated):
                return True
    return False


def _totals(prompt: AnnotatedPrompt) -> set[float]:
    """Return how many bodies of each kind there are, and of all kinds ("the two of them")."""
    counts: Counter[str] = Counter()
    for requirement in prompt.requirements:
        if isinstance(requirement, AgentRequirement):
            counts[requirement.type] += requirement.count
            counts['agents'] += requirement.count
        if isinstance(requirement, UavRequirement):
            counts['uavs'] += requirement.count
    counts['missions'] = sum(r.kind == 'mission' for r in prompt.requirements)
    return {float(n) for n in (*counts.values(), counts['agents'] + counts['uavs'])}
