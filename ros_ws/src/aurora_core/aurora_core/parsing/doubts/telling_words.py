# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words that ask for something though most of the grammar passes over them.

`lands at the same time`, `takes off again`, `a slow bus`: such a word is known, so a clause can be
read with it and mean no more than without it. The lexicon lists them under `telling`, each with
what can carry its meaning. Where the clause became nothing of that kind, the words are returned,
and admitted as not encoded. It looks at the specification alone, whoever wrote it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.coverage import parameters
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.doubts.carriers import CARRIERS, stated
from aurora_core.parsing.doubts.clauses import clause_of, meet, over
from aurora_core.spec.parameter import Bound, Span
from aurora_core.spec.scenario import Clause, ScenarioSpec
from aurora_core.spec.vocabulary import ClauseStatus

_PAUSES = ' \t\n,;.:-('
_COMPARING = frozenset({'above', 'below', 'beyond', 'under', 'within'})
_PLACES = frozenset({'beyond', 'within'})
_NO_PLACE = frozenset({'ratio', 'speed'})  # dimensions of numbers
# Rows about whole clauses, by their first words.
_OPENINGS = ('as_long_as', 'because', 'cause', 'later', 'meanwhile')


def untold(spec: ScenarioSpec, atoms: Sequence[Atom]) -> list[Span]:
    """Return the telling words of encoded clauses that nothing in the specification carries."""
    text = spec.prompt.lower()
    found = []
    for name, (pattern, carriers) in _rows().items():
        if name in _OPENINGS:
            spans = list(_openings(spec, pattern))
        else:
            spans = [Span(start=m.start(), end=m.end()) for m in pattern.finditer(text)]
        for span in spans:
            clauses = _encoded(spec, span)
            if clauses and not any(CARRIERS[n](spec, c) for n in carriers for c in clauses):
                found.append(span)
    return found


def comparisons(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`slows to below 5 m/s`, `a radius of less than 40 m` that became exactly that."""
    judged = [*spec.conditions, *(event.trigger for event in spec.events)]
    compared = [parameter.span for part in judged for parameter in parameters(part)]
    for word, number in pairwise(atoms):
        if not _compares(word, number) or clause_of(spec, number) is None:
            continue
        span = over(number, number)
        told = [p for p in stated(spec) if p.span is not None and meet(p.span, span)]
        exact = all(p.bound is Bound.EXACTLY and p.span not in compared for p in told)
        if told and exact:
            yield over(word, number)


def _compares(word: Atom, number: Atom) -> bool:
    """Return whether a word makes a bound of the number behind it: `within` may be a place."""
    if word.kind is not AtomKind.PREPOSITION or number.measure is None:
        return False
    if word.key == 'over':  # `over 200 m of road`, `over after 90 s`
        return number.key in _NO_PLACE
    return word.key in _COMPARING and word.words not in _PLACES


def _openings(spec: ScenarioSpec, opening: re.Pattern[str]) -> Iterator[Span]:
    """Yield the clauses that begin with certain words, each with them: `then | the bus stops`."""
    clauses = sorted(spec.clauses, key=lambda c: c.span.start)
    if clauses and opening.match(spec.prompt.lower()):
        yield Span(start=0, end=clauses[0].span.end)
    for before, clause in pairwise(clauses):
        between = spec.prompt[before.span.end : clause.span.start]
        start = before.span.end + len(between) - len(between.lstrip(_PAUSES))
        start = min(start, clause.span.start)
        if opening.match(spec.prompt.lower(), start):
            yield Span(start=start, end=clause.span.end)


def _encoded(spec: ScenarioSpec, span: Span) -> list[Clause]:
    """Return the clauses that characters are part of, none where one of them is unread.

    Characters between two clauses belong to the one that they open.
    """
    touched = [c for c in spec.clauses if meet(c.span, span)]
    if not touched:
        behind = (c for c in spec.clauses if c.span.start >= span.end)
        touched = sorted(behind, key=lambda c: c.span.start)[:1]
    read = all(c.status is ClauseStatus.ENCODED for c in touched)
    return touched if read else []


@lru_cache(maxsize=1)
def _rows() -> dict[str, tuple[re.Pattern[str], tuple[str, ...]]]:
    rows = read_data('lexicon.yaml')['telling']
    return {
        name: (
            re.compile(rf'\b(?:{"|".join(row["words"])})\b'),
            tuple(row.get('carried_by', ())),
        )
        for name, row in rows.items()
    }
