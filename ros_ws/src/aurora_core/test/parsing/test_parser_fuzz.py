# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Mutated prompts: no crash, no number invented, altered or lost, and the same answer twice."""

from __future__ import annotations

import json
import re
import string
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st
from yaml_rows import rows_of

from aurora_core.errors import PromptError
from aurora_core.outcomes.parse import ParseContext, ParseOutcome
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

CONTEXT = ParseContext(landmark_names=('central_park', 'clock_tower'))
_PROMPTS = [row['prompt'] for row in rows_of(Path(__file__).with_name('prompts.yaml'))]
_WORDS = sorted({word for prompt in _PROMPTS for word in prompt.split()})
# Written independently of the parser: factors by unit spelling, as decimal fractions of SI.
_FACTORS = {
    'm': '1', 'meter': '1', 'meters': '1', 'metre': '1', 'metres': '1', 'km': '1000',
    'ft': '0.3048', 'foot': '0.3048', 'feet': '0.3048', 's': '1', 'sec': '1', 'second': '1',
    'seconds': '1', 'ms': '0.001', 'min': '60', 'minute': '60', 'minutes': '60', '%': '0.01',
    'percent': '0.01', 'm/s': '1', 'mph': '0.44704', 'deg': '1', 'degrees': '1', 'yd': '0.9144',
    '': '1',
}  # fmt: skip
_SIMPLE = re.compile(r'(\d+(?:\.\d+)?)[ -]*([a-zA-Z%/]*)')


@st.composite
def _mutated(draw: st.DrawFn) -> str:
    words = draw(st.sampled_from(_PROMPTS)).split()
    for _ in range(draw(st.integers(1, 5))):
        kind = draw(st.sampled_from(['drop', 'swap', 'insert', 'typo', 'number', 'join', 'twice']))
        i = draw(st.integers(0, max(len(words) - 1, 0)))
        if not words or kind == 'insert':
            words.insert(i, draw(st.sampled_from(_WORDS)))
        elif kind == 'drop':
            del words[i]
        elif kind == 'twice':
            words.insert(i, words[i])
        elif kind == 'swap' and i:
            words[i - 1], words[i] = words[i], words[i - 1]
        elif kind == 'typo':
            word = words[i]
            at = draw(st.integers(0, len(word)))
            letter = draw(st.sampled_from(string.printable + 'äé漢\u200b–’×'))
            words[i] = word[:at] + letter + word[at + draw(st.integers(0, 1)) :]
        elif kind == 'number':
            value = draw(st.one_of(st.integers(0, 10**6), st.decimals(0, 999, places=2)))
            words[i] = f'{value}{draw(st.sampled_from(["", " m", "ft", " s", " %", " m/s", "x"]))}'
        else:
            words += draw(st.sampled_from(_PROMPTS)).split()
    return ' '.join(words)


def _parameters(value: Any) -> Iterator[dict[str, Any]]:
    if isinstance(value, dict):
        if 'provenance' in value:
            yield value
        for inner in value.values():
            yield from _parameters(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _parameters(inner)


def _simple_value(text: str) -> float | None:
    """Return the value of a plainly written quantity, None for any other notation."""
    match = _SIMPLE.fullmatch(text)
    if match is None or match.group(2).lower() not in _FACTORS:
        return None
    return float(Fraction(match.group(1)) * Fraction(_FACTORS[match.group(2).lower()]))


def _check_numbers(prompt: str, spec: ScenarioSpec) -> None:
    parameters = list(_parameters(spec.model_dump(mode='json')))
    for parameter in parameters:
        if parameter['provenance'] != 'explicit':
            continue
        text = prompt[parameter['span']['start'] : parameter['span']['end']]
        simple = _simple_value(text)
        if simple is not None:
            # A stated diameter is a radius, a stated interval a rate.
            meant = (simple, simple / 2, 1.0 / simple if simple else simple)
            assert parameter['value'] in meant, (text, parameter)
    spans = [p['span'] for p in parameters if p['span'] is not None]
    spans += [a.span.model_dump() for a in spec.agents if a.span is not None]
    spans += [u.span.model_dump() for u in spec.uavs if u.span is not None]
    spans += [c.span.model_dump() for c in spec.clauses if c.status is ClauseStatus.NOT_ENCODED]
    for number in re.finditer(r'\d+', prompt):
        covered = any(s['start'] <= number.start() and number.end() <= s['end'] for s in spans)
        mentioned = re.search(
            rf'{number.group()}(\.\d+)?\W*\w*\W*\w*\W*(uav|drone|ego|car|bus|van|truck|taxi|cyclist|ped)',
            prompt[number.start() :],
            re.IGNORECASE,
        )
        named = re.search(r'(uav|drone|car|bus|van|truck)s?\W*$', prompt[: number.start()], re.I)
        assert covered or mentioned or named, (number.group(), prompt)


def _check(prompt: str) -> ParseOutcome | None:
    try:
        outcome = parse_offline(prompt, CONTEXT)
    except PromptError:
        return None
    if outcome.spec is not None:
        assert not outcome.refusals
        assert outcome.question is None
        _check_numbers(prompt, outcome.spec)
        for clause in outcome.clauses:
            assert prompt[clause.span.start : clause.span.end] == clause.text
    else:
        assert outcome.question or outcome.refusals
    return outcome


@settings(max_examples=150, deadline=None, derandomize=True)
@given(_mutated())
def test_mutated_prompts_keep_every_number(prompt: str) -> None:
    _check(prompt)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.text(max_size=120))
def test_any_text_is_answered(prompt: str) -> None:
    _check(prompt)


def test_prompts_of_the_table_keep_every_number() -> None:
    for prompt in _PROMPTS:
        _check(prompt)


@settings(max_examples=40, deadline=None, derandomize=True)
@given(_mutated())
def test_same_text_gives_the_same_answer(prompt: str) -> None:
    first = parse_offline(prompt, CONTEXT) if prompt.strip() else None
    second = parse_offline(prompt, CONTEXT) if prompt.strip() else None
    assert json.dumps(first and first.model_dump(mode='json')) == json.dumps(
        second and second.model_dump(mode='json')
    )


def test_words_in_another_order_keep_their_place() -> None:
    # `half as fast` stands behind the verb, and `the drone` is moved in front of it.
    prompt = (
        'A car waits. Behind it is a motorcycle, and it is the motorcycle that the drone '
        'tracks, at half as fast 35 m altitude.'
    )
    outcome = parse_offline(prompt, ParseContext())
    assert all(c.span.start < c.span.end for c in outcome.clauses)
