# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Validate prompt files: format, names, meaning, numbers, limits, paraphrases."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache

from pydantic import ValidationError

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.prompts.limits import check_limits
from aurora_bench.prompts.meaning import check_meaning
from aurora_bench.prompts.numbers import check_numbers
from aurora_bench.prompts.paraphrases import check_set
from aurora_bench.prompts.reading import read_lines
from aurora_bench.prompts.references import check_references
from aurora_core.knowledge.agent_types import load_agent_types
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.knowledge.map_model import load_map
from aurora_core.spec.scenario import ScenarioSpec


def validate(
    texts: Sequence[str], map_name: str = 'downtown'
) -> tuple[tuple[AnnotatedPrompt, ...], tuple[Finding, ...]]:
    """Return the readable prompts of all files and every finding.

    Args:
        texts: Contents of the files; ids must be unique over all of them.
        map_name: Whose landmarks count as places.
    """
    prompts: list[AnnotatedPrompt] = []
    findings: list[Finding] = []
    for text in texts:
        read, problems = read_lines(text)
        prompts += read
        findings += problems
    landmarks, streets = _places(map_name)
    limits = load_limits(config_path('limits.json'))
    types = load_agent_types()
    for prompt in prompts:
        findings += check_references(prompt, landmarks, streets)
        findings += check_numbers(prompt)
        nonsense = [*check_meaning(prompt), *_reference(prompt)]
        findings += nonsense
        # Limits are looked up by weather and the like, which have to be known words.
        if not nonsense:
            findings += check_limits(prompt, limits, types)
    findings += check_set(prompts)
    return tuple(prompts), tuple(findings)


def _reference(prompt: AnnotatedPrompt) -> Iterator[Finding]:
    if prompt.reference is None:
        return
    try:
        spec = ScenarioSpec.model_validate(prompt.reference)
    except ValidationError as err:
        text = f'its reference is no specification: {err.errors()[0]["msg"]}'
        yield Finding(where=prompt.id, rule=Rule.MEANING, text=text)
        return
    if spec.prompt != prompt.prompt:
        text = 'its reference is that of another prompt'
        yield Finding(where=prompt.id, rule=Rule.MEANING, text=text)


@lru_cache
def _places(map_name: str) -> tuple[frozenset[str], frozenset[str]]:
    known = load_map(map_name)
    landmarks = frozenset(mark.name for mark in known.landmarks)
    return landmarks, frozenset(known.network.street_names)
