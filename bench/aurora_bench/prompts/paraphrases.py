# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Paraphrases that do not ask for the same, and prompts that say the same twice."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence

from aurora_bench.prompts.findings import Finding, Rule
from aurora_bench.prompts.format import AnnotatedPrompt

_NUMBER = re.compile(r'\d+(?:[.,]\d+)?')


def check_set(prompts: Sequence[AnnotatedPrompt]) -> Iterator[Finding]:
    """Find what is wrong between prompts of one or several files."""
    yield from _duplicates(prompts)
    yield from _groups(prompts)
    yield from _only_a_number(prompts)


def check_split(first: Iterable[AnnotatedPrompt], second: Iterable[AnnotatedPrompt]) -> list[str]:
    """Return paraphrase groups that are in both files: a split must not leak."""
    names = [{p.paraphrase_group for p in part} - {None} for part in (first, second)]
    return sorted(str(name) for name in names[0] & names[1])


def requirements_key(prompt: AnnotatedPrompt) -> str:
    """Return what a prompt asks for as a text that is equal for equal requests."""
    body = prompt.model_dump(mode='json', exclude_unset=True, by_alias=True)
    asked = {name: body.get(name) for name in ('feasibility', 'requirements', 'variation')}
    return json.dumps(asked, sort_keys=True)


def _duplicates(prompts: Sequence[AnnotatedPrompt]) -> Iterator[Finding]:
    ids: set[str] = set()
    texts: dict[str, str] = {}
    for prompt in prompts:
        if prompt.id in ids:
            yield Finding(where=prompt.id, rule=Rule.DUPLICATE_ID, text='this id is there twice')
        ids.add(prompt.id)
        text = ' '.join(re.findall(r'\w+', prompt.prompt.lower()))
        if text in texts:
            yield Finding(
                where=prompt.id,
                rule=Rule.DUPLICATE_PROMPT,
                text=f'says the same as {texts[text]}',
            )
        texts.setdefault(text, prompt.id)


def _groups(prompts: Sequence[AnnotatedPrompt]) -> Iterator[Finding]:
    groups: dict[str, list[AnnotatedPrompt]] = {}
    for prompt in prompts:
        if prompt.paraphrase_group is not None:
            groups.setdefault(prompt.paraphrase_group, []).append(prompt)
    for name, members in groups.items():
        if len(members) < 2:
            yield Finding(
                where=members[0].id,
                rule=Rule.PARAPHRASE,
                text=f'is alone in paraphrase group {name}',
            )
        for member in members[1:]:
            if requirements_key(member) != requirements_key(members[0]):
                yield Finding(
                    where=member.id,
                    rule=Rule.PARAPHRASE,
                    text=f'asks for something else than {members[0].id} of its group {name}',
                )


def _only_a_number(prompts: Sequence[AnnotatedPrompt]) -> Iterator[Finding]:
    """Another number makes no new prompt, unless the two are on both sides of a limit."""
    seen: dict[str, AnnotatedPrompt] = {}
    for prompt in prompts:
        text = _NUMBER.sub('#', prompt.prompt.lower())
        other = seen.setdefault(text, prompt)
        if other is prompt or other.prompt == prompt.prompt:
            continue
        if {other.feasibility, prompt.feasibility} == {'boundary', 'infeasible'}:
            continue
        if other.paraphrase_group is None or other.paraphrase_group != prompt.paraphrase_group:
            yield Finding(
                where=prompt.id,
                rule=Rule.DUPLICATE_PROMPT,
                text=f'differs from {other.id} in a number only',
            )
