# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The matrix leaves out no word of the catalogue, and says why a cell is empty."""

from __future__ import annotations

from collections.abc import Iterable
from typing import get_args

import pytest

from aurora_bench.encounters.pairs import KINDS, pairs
from aurora_bench.matrix.__main__ import cells_of
from aurora_bench.matrix.cells import Cell
from aurora_bench.prompts.format import Action, Trigger
from aurora_bench.prompts.reference_names import NotExpressibleError
from aurora_bench.prompts.reference_spec import reference_spec
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Pattern, Relation, Side


@pytest.fixture(scope='module', params=['downtown', 'helsinki'])
def cells(request: pytest.FixtureRequest) -> tuple[Cell, ...]:
    return cells_of(request.param)


@pytest.mark.parametrize(
    ('table', 'words'),
    [
        ('Behaviour', list(BehaviorKind)),
        ('Trigger', get_args(Trigger.model_fields['on'].annotation)),
        ('Action', get_args(Action.model_fields['do'].annotation)),
        ('Place of a vehicle', list(Relation)),
        ('Place of a person', list(Relation)),
        ('Pattern', list(Pattern)),
        ('Side', list(Side)),
    ],
)
def test_every_word_is_a_row(table: str, words: Iterable[str], cells: tuple[Cell, ...]) -> None:
    rows = {c.row for c in cells if c.table == table}
    assert {str(word) for word in words} <= rows


def test_every_mode_is_a_column(cells: tuple[Cell, ...]) -> None:
    assert {c.column for c in cells if c.table == 'Mission'} == set(MissionMode)


def test_a_cell_asks_for_something_or_says_why_not(cells: tuple[Cell, ...]) -> None:
    assert [c.ident for c in cells if bool(c.parts) is bool(c.why_empty)] == []
    assert len({c.ident for c in cells}) == len(cells)


def test_cells_are_annotations_that_a_specification_can_say(cells: tuple[Cell, ...]) -> None:
    unsaid = set()
    for cell in cells:
        if cell.parts:
            try:
                reference_spec(cell.prompt(), judged=True)
            except NotExpressibleError:
                unsaid.add(cell.table)
    assert unsaid <= {'Pattern', 'Zone'}  # facade, street, zones, from A to B


def test_pairs_are_the_same_every_time_and_of_every_kind() -> None:
    first, again = list(pairs(12, 1)), list(pairs(12, 1))
    assert first == again
    assert {pair.kind for pair in first} == set(KINDS)
    for pair in first:
        reference_spec(pair.cell.prompt(), judged=True)
