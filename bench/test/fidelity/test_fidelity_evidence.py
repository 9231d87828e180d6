# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The clause that a miss is looked for in is the one that speaks of what was missed."""

from __future__ import annotations

import pytest

from aurora_bench.fidelity.evidence import evidence
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_core.spec.scenario import Clause

PARTS = (
    'Q1 is a quadcopter that stays closer than 40 m to the van',
    'its share is at least 95 %',
    'a copter and a lorry keep the peace',
    'it lands before the lorry brakes',
)
TEXT = '; '.join(PARTS)
PROMPT = AnnotatedPrompt.model_validate(
    {
        'id': 'p1', 'category': 'track', 'prompt': TEXT, 'feasibility': 'feasible',
        'paraphrase_group': None, 'end_to_end': False,
        'requirements': [
            {'id': 'r1', 'kind': 'uav', 'ref': 'x'},
            {'id': 'r2', 'kind': 'agent', 'ref': 'y', 'type': 'van'},
            {'id': 'r3', 'kind': 'agent', 'ref': 'z', 'type': 'truck'},
            {'id': 'r4', 'kind': 'condition', 'quantity': 'distance', 'of': ['x', 'y'],
             'op': '<=', 'value': 40, 'fraction': 0.95},
            {'id': 'r6', 'kind': 'event', 'ref': 'e1', 'action': {'do': 'land', 'uav': 'x'}},
            {'id': 'r7', 'kind': 'event', 'ref': 'e2', 'action': {'do': 'brake', 'agent': 'z'}},
            {'id': 'r8', 'kind': 'order', 'first': 'e1', 'then': 'e2'},
            {'id': 'r5', 'kind': 'condition', 'quantity': 'altitude', 'of': ['x', 'z'],
             'op': '<=', 'value': 77},
        ],
    }
)  # fmt: skip
CLAUSES = tuple(
    Clause.model_validate(
        {
            'text': part,
            'span': {'start': TEXT.index(part), 'end': TEXT.index(part) + len(part)},
            'status': 'encoded',
        }
    )
    for part in PARTS
)


@pytest.mark.parametrize(
    ('requirement', 'fields', 'expected'),
    [
        ('r4', ('value',), PARTS[:1]),
        ('r4', ('fraction',), PARTS[1:2]),
        ('r4', ('of', 'value', 'fraction'), PARTS[:1]),
        ('r4', ('op',), PARTS[:1]),
        ('r5', ('of',), PARTS[2:3]),
        ('r3', ('type',), PARTS[2:]),
        ('r8', ('then',), PARTS[3:]),
    ],
)
def test_the_clause_of_the_missed_fields(
    requirement: str, fields: tuple[str, ...], expected: tuple[str, ...]
) -> None:
    asked = next(r for r in PROMPT.requirements if r.id == requirement)
    found = evidence(PROMPT, asked, fields, CLAUSES)
    assert tuple(c.text for c in found) == expected


def test_no_clause_speaks_of_it() -> None:
    asked = PROMPT.requirements[3].model_copy(update={'of': (), 'value': 77.0, 'fraction': None})
    quiet = tuple(c.model_copy(update={'text': 'nothing'}) for c in CLAUSES)
    assert evidence(PROMPT, asked, ('value',), quiet) == ()
