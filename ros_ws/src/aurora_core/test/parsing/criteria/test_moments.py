# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which event a clause puts behind which, and how soon."""

from __future__ import annotations

import pytest

from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.criteria.moments import Sequel, sequel
from aurora_core.parsing.rewriting.rewrite import rewrite
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize


def _sequel(text: str) -> Sequel | None:
    atoms = rewrite(tag(tokenize(text), {}).atoms, text).atoms
    return sequel([a for a in atoms if a.kind is not AtomKind.STOP])


@pytest.mark.parametrize(
    ('text', 'first', 'then', 'within'),
    [
        ('The crossing should follow no more than 6 s after the stop', 'stop', 'cross', 6.0),
        ('The acceleration must follow the receipt within 3 s', 'receive', 'accelerate', 3.0),
        ('The braking has to come before the lane change', 'brake', 'change_lane', None),
        ('The landing must not happen before the message', 'send', 'land', None),
        ('it is to do so within 8 s of the braking', 'brake', None, 8.0),
        ('at most 20 s later', None, None, 20.0),
    ],
)
def test_order_has_two_ends_and_a_limit(
    text: str, first: str | None, then: str | None, within: float | None
) -> None:
    found = _sequel(text)
    assert found is not None
    assert (found.first.key if found.first else None) == first
    assert (found.then.key if found.then else None) == then
    assert (found.within.value if found.within else None) == within


@pytest.mark.parametrize(
    'text',
    [
        'The message must arrive within 2 s',
        'The bus brakes within 20 m of the crosswalk',
        'A drone hovers for at most 20 s over the crosswalk',
    ],
)
def test_other_clauses_state_no_order(text: str) -> None:
    assert _sequel(text) is None
