# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stands around a predicate: `at 30 m altitude`, `20 m ahead of it`, `the bus`."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

from aurora_core.parsing.atoms import NounPhrase
from aurora_core.parsing.measures import Measure
from aurora_core.spec.parameter import Span

# Relations of several to one of themselves, by the end of their words.
MUTUAL = (
    *('each other', 'one another', 'side by side', 'abreast', 'neck and neck'),
    *('shoulder to shoulder', 'adjacent lanes', 'neighbouring lanes', 'neighboring lanes'),
)


# The same of those who stand one behind the other.
IN_A_ROW = (
    *('behind the other', 'behind each other', 'behind one another', 'after the other'),
    *('after another', 'in single file', 'in a column', 'in a queue', 'in a convoy', 'in convoy'),
    *('nose to tail', 'in a row', 'the one before', 'the one in front', 'the one ahead'),
    *('the previous one', 'the preceding one', 'from front to back'),
)


class AdjunctKind(StrEnum):
    ATTRIBUTE = 'attribute'  # a measure with the name of what it measures
    MEASURE = 'measure'  # a measure with or without a preposition
    PLACE = 'place'  # a relation, what it relates to, how far
    PHRASE = 'phrase'  # preposition and nouns
    OBJECT = 'object'  # nouns without a preposition
    MARK = 'mark'  # any other word


@dataclass(slots=True, kw_only=True)
class Adjunct:
    """One complement of a clause; `used` is set by the construction that understood it.

    Attributes:
        key: Attribute name, relation, preposition or the kind of a mark.
        prep: Preposition in front of an attribute or measure.
        value: Key of a mark (`weather:clear`, `rectangle`, …).
        measures: The numbers of `at 30, 45 and 60 m respectively`, in order.
    """

    kind: AdjunctKind
    key: str
    start: int
    end: int
    prep: str = ''
    value: str = ''
    measure: Measure | None = None
    nouns: tuple[NounPhrase, ...] = ()
    measures: tuple[Measure, ...] = ()
    used: bool = field(default=False)

    @property
    def span(self) -> Span:
        """Its characters; words that were put in another order may end before they begin."""
        return Span(start=min(self.start, self.end), end=max(self.start, self.end))
