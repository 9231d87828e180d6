# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether prompts that ask for the same in other words give the same scenario, up to names."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from aurora_bench.fidelity.answer import Answer
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_core.document import Document

# Where a thing was read, how sure it is and what it is called: not part of what is asked for.
_WORDING = frozenset(
    {
        'schema_version',
        'prompt',
        'clauses',
        'span',
        'weather_span',
        'time_of_day_span',
        'wind_span',
        'group',
        'id',
        'kept_in_motion',
        'distance_at_start',
        'target_inferred',
    }
)
_ELEMENTS = ('agents', 'uavs', 'missions', 'links', 'events', 'conditions', 'orders')
_ROUNDS = 4


class Group(Document):
    """One paraphrase group.

    Attributes:
        name: Of the group.
        members: Ids of its prompts.
        differing: Members whose scenario is not the commonest one of the group.
    """

    name: str
    members: tuple[str, ...]
    differing: tuple[str, ...] = ()

    @property
    def is_consistent(self) -> bool:
        """All members give the same scenario."""
        return not self.differing


def groups(pairs: Sequence[tuple[AnnotatedPrompt, Answer]]) -> list[Group]:
    """Return every paraphrase group of two members or more, with the members that stand apart."""
    members: dict[str, list[tuple[str, str]]] = {}
    for prompt, answer in pairs:
        if prompt.paraphrase_group is not None:
            told = (prompt.id, signature(answer))
            members.setdefault(prompt.paraphrase_group, []).append(told)
    found = []
    for name, told_by in sorted(members.items()):
        if len(told_by) < 2:
            continue
        common = Counter(text for _, text in told_by).most_common(1)[0][0]
        found.append(
            Group(
                name=name,
                members=tuple(one for one, _ in told_by),
                differing=tuple(one for one, text in told_by if text != common),
            )
        )
    return found


def signature(answer: Answer) -> str:
    """Return what an answer asks for as text without names.

    Values count to two significant digits, so that 164 ft is 50 m. Two scenarios with one
    signature may differ in symmetric cases only (who of two equal cars follows which).
    """
    if answer.reasons:
        return f'refused {sorted(set(answer.reasons))}'
    if answer.spec is None:
        return f'no scenario: {bool(answer.question)} {answer.error}'
    spec = answer.spec.model_dump(mode='json')
    elements = [e for name in _ELEMENTS for e in spec.get(name, ())]
    labels = {e['id']: '' for e in elements}
    for _ in range(_ROUNDS):  # every round tells apart what refers to things told apart before
        texts = {e['id']: _text(e, labels) for e in elements}
        ranks = {text: f'#{i}' for i, text in enumerate(sorted(set(texts.values())))}
        labels = {one: ranks[text] for one, text in texts.items()}
    facts = sorted(_text(e, labels) for e in elements)
    return json.dumps([_text(spec['world'], labels), *facts])


def _text(value: Any, labels: Mapping[str, str]) -> str:
    return json.dumps(_plain(value, labels), sort_keys=True)


def _plain(value: Any, labels: Mapping[str, str]) -> Any:
    if isinstance(value, dict):
        if 'provenance' in value and 'value' in value:
            return f'{value["value"]:.2g}'
        if 'a' in value and 'b' in value:  # a distance has no direction
            value = {**value, 'a': '', 'b': [value['a'], value['b']]}
        return {k: _plain(v, labels) for k, v in _told(value)}
    if isinstance(value, list):
        return sorted((_plain(v, labels) for v in value), key=json.dumps)
    return labels.get(value, value) if isinstance(value, str) else value


def _told(value: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    for name, inner in value.items():
        if name not in _WORDING and inner not in (None, [], False):
            yield name, inner
