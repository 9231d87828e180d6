# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause says as a condition, and which clauses say none."""

from __future__ import annotations

import pytest

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.criteria.slots import criterion
from aurora_core.parsing.rewriting.rewrite import rewrite
from aurora_core.parsing.tagging import tag
from aurora_core.parsing.tokens import tokenize


def _atoms(text: str) -> list[Atom]:
    tagged = tag(tokenize(text), {})
    return [a for a in rewrite(tagged.atoms, text).atoms if a.kind is not AtomKind.STOP]


@pytest.mark.parametrize(
    ('text', 'limits'),
    [
        ('The gap between the van and the bus must never exceed 60 m', [('<=', 60.0)]),
        ('it must not come closer than 9 m to the bus', [('>=', 9.0)]),
        ('they have to remain more than 10 m apart', [('>', 10.0)]),
        ('its altitude must stay between 28 and 34 m', [('>=', 28.0), ('<=', 34.0)]),
        ('no drone may come within 12 m of any other', [('>=', 12.0)]),
        ('the bus should be doing 8 m/s or more', [('>=', 8.0)]),
    ],
)
def test_comparison_and_negation_give_the_operator(
    text: str, limits: list[tuple[str, float]]
) -> None:
    found = criterion(_atoms(text))
    assert found is not None
    assert [(limit.op, limit.measure.value) for limit in found.limits] == limits


@pytest.mark.parametrize(
    'text',
    [
        'A drone hovers over the crosswalk at 40 m',
        'should it drop under 3 m/s',
        'The bus must brake hard at 20 s',
        'the drone must stay above 40 m if the van brakes',
        'The van must not be slower than 5 m/s for more than 10 s',
        # All along, not at some moment of these, as a deadline would have it.
        'The bus must not exceed 10 m/s within 20 s',
        'The bus must stay below 10 m/s within 20 s',
    ],
)
def test_words_without_a_place_make_it_another_clause(text: str) -> None:
    assert criterion(_atoms(text)) is None


def test_times_are_deadline_stretch_and_share() -> None:
    stretch = criterion(_atoms('the car must do more than 15 m/s for at least 5 s in a row'))
    deadline = criterion(_atoms('by t = 45 s the car must be within 20 m of the bus'))
    share = criterion(_atoms('the car must be within 20 m of the bus for 80 % of the time'))
    assert stretch is not None
    assert stretch.hold is not None
    assert (stretch.hold.measure.value, stretch.unbroken) == (5.0, True)
    assert deadline is not None
    assert deadline.by is not None
    assert deadline.by.value == 45.0
    assert share is not None
    assert share.share is not None
    assert share.share.measure.value == 0.8
