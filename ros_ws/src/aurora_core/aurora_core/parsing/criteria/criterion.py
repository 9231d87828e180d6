# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause that states a success condition says, before it is known of whom."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from aurora_core.parsing.atoms import NounPhrase
from aurora_core.parsing.criteria.moments import Moment
from aurora_core.parsing.criteria.placed import Placed
from aurora_core.parsing.measures import Measure
from aurora_core.spec.parameter import Span

Op = Literal['<=', '<', '>=', '>', '==']


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A comparison with a number."""

    op: Op
    measure: Measure
    name: str  # letter and number in the line: `L0`

    @property
    def dimension(self) -> str:
        return self.name[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class Criterion:
    """A condition.

    Attributes:
        limits: What is compared; none for `must have landed`.
        hold: How long it has to hold in one stretch, or in all.
        unbroken: The time of `hold` is one stretch.
        by: Deadline from the start of the run.
        share: Share of the time in which it has to hold.
        topics: Keys of `topics` in criteria.yaml whose words stand in the clause.
        nouns: Actors and places in the order of the text.
        event: What must happen then: `the crossing must not begin before 20 s`.
        owned: `its distance`: of somebody named before.
        others: The clause names only those whom somebody named before keeps off.
        placed: Where those are whom it names.
        unread: Words that were left out because nobody knows them.
    """

    limits: tuple[Limit, ...]
    hold: Limit | None = None
    unbroken: bool = False
    by: Measure | None = None
    share: Limit | None = None
    topics: frozenset[str] = frozenset()
    nouns: tuple[NounPhrase, ...] = ()
    event: Moment | None = None
    owned: bool = False
    others: bool = False
    placed: tuple[Placed, ...] = ()
    unread: tuple[Span, ...] = ()
    words: str = ''
