# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The same scenario up to names, and what is another one."""

from __future__ import annotations

import pytest

from aurora_bench.fidelity.answer import offline_answer
from aurora_bench.fidelity.consistency import groups, signature
from aurora_bench.prompts.format import AnnotatedPrompt

_FIRST = (
    'A bus is 20 m ahead of the ego and a van follows the bus. A drone tracks the bus at 50 m.'
)


def _signature(prompt: str) -> str:
    return signature(offline_answer(prompt))


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone tracks a bus at 164 ft. The bus is 20 m ahead of the ego, a van follows the bus.',
        'A van follows a bus, which is 20 m in front of the ego. A UAV tracks the bus at 50 m.',
    ],
)
def test_names_order_and_units_do_not_matter(prompt: str) -> None:
    assert _signature(prompt) == _signature(_FIRST)


@pytest.mark.parametrize(
    ('old', 'new'), [('50 m', '60 m'), ('van', 'truck'), ('ahead of', 'behind'), ('20 m', '40 m')]
)
def test_what_is_asked_for_matters(old: str, new: str) -> None:
    assert _signature(_FIRST.replace(old, new)) != _signature(_FIRST)


def test_who_follows_whom_matters() -> None:
    one = 'A bus drives at 8 m/s, a van at 9 m/s. The bus follows the van. A drone tracks the bus.'
    other = one.replace('The bus follows the van', 'The van follows the bus')
    assert _signature(one) != _signature(other)


def test_a_group_names_who_stands_apart() -> None:
    def prompt(name: str, text: str) -> AnnotatedPrompt:
        return AnnotatedPrompt.model_validate(
            {
                'id': name,
                'category': 'hover',
                'prompt': text,
                'feasibility': 'feasible',
                'paraphrase_group': 'hovering',
                'end_to_end': False,
                'requirements': [{'id': 'r1', 'kind': 'uav', 'ref': 'uav1'}],
            }
        )

    told = [
        prompt('hover-1', 'A drone hovers over City Hall at 40 m.'),
        prompt('hover-2', 'At 40 m a UAV hovers over City Hall.'),
        prompt('hover-3', 'A drone hovers over City Hall at 45 m.'),
    ]
    (group,) = groups([(p, offline_answer(p.prompt)) for p in told])
    assert (group.name, group.differing) == ('hovering', ('hover-3',))
    assert not group.is_consistent
