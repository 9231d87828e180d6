# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which event comes before which, and how soon: `the crossing must follow within 6 s`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from aurora_core.parsing.atoms import Atom, NounPhrase
from aurora_core.parsing.criteria.told import told
from aurora_core.parsing.criteria.words import criteria_words
from aurora_core.parsing.measures import Measure

_RANKS = {'first': 0, '1st': 0, 'former': 0, 'second': 1, '2nd': 1, 'latter': 1, 'third': 2}
_SOON = (
    r'(?:within|inside|in under|under|in less than|less than|in no more than|no more than|'
    r'not more than|at (?:the )?most|atmost|nolater|not later than|no later than|in atmost)'
)
_LIMIT = re.compile(
    rf'(?P<bound>{_SOON} )?(?P<t>T\d+)'
    r'(?P<late>(?: later| afterwards| after that)?'
    r' (?:at (?:the )?(?:most|latest)|or less|tops|max))?'
)
_EARLIER = re.compile(r'\b(?:before|precedes?|preceding|ahead|prior|earlier)\b')
_REFERS = re.compile(r' (?:and |but )?(?:it N\d+|this|that|which)\b')
_NOT = re.compile(r'\b(?:not|never|no)\b')
_EVENT = re.compile(r'\bE\d+\b')


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """An event that a clause refers to: what happens, and the how many-th of its kind."""

    key: str
    rank: int | None = None
    words: str = ''


@dataclass(frozen=True, slots=True, kw_only=True)
class Sequel:
    """`then` comes after `first`; None: what was told last, and what was told before it."""

    first: Moment | None
    then: Moment | None
    within: Measure | None
    nouns: tuple[NounPhrase, ...] = ()


def sequel(atoms: Sequence[Atom]) -> Sequel | None:
    """Return the order that a clause states, None when it says anything else."""
    line = told(atoms)
    words = criteria_words()
    if not words['demands'].search(line.text) and _limit(line.text) is None:
        return None
    text, moments = with_events(line.text)
    limit = _limit(text)
    behind = text[limit.end() :] if limit is not None else ''
    start = words['from_start'].match(behind, 1)
    if start is not None and not re.match(r' of (?:the )?N\d', behind[start.end() :]):
        return None  # `within 30 s of the start` counts from no event
    refers = _REFERS.match(text) is not None and len(moments) == 1
    if limit is None and len(moments) < 2 and not (refers and _EARLIER.search(text)):
        return None
    if len(re.findall(r'\b[LTVPC]\d+\b', text)) > (limit is not None):
        return None
    asked = words['demands'].search(text) or limit is not None
    rest = text if limit is None else f'{text[: limit.start()]} | {text[limit.end() :]}'
    left = words['frames'].sub(' ', rest)
    left = words['demands'].sub(' ', left)
    left = words['connections'].sub(' ', re.sub(r'\b[NE]\d+\b', ' ', left))
    if not asked or left.replace('|', ' ').replace("'s", ' ').strip(' ,.;:-'):
        return None
    placed = words['later_words'].search(text) or 'between' in rest
    if not moments and not placed:
        return None
    first, then = _which(rest, moments)
    return Sequel(
        first=first,
        then=then,
        within=line.measures[limit['t']] if limit is not None else None,
        nouns=tuple(line.nouns.values()),
    )


def _limit(text: str) -> re.Match[str] | None:
    return next((m for m in _LIMIT.finditer(text) if m['bound'] or m['late']), None)


def with_events(text: str) -> tuple[str, list[Moment]]:
    """Write events as E0, E1, … in the order of the text."""
    found: list[tuple[int, int, str]] = []
    for key, pattern in criteria_words().events.items():
        for match in pattern.finditer(text):
            found.append((match.start(), match.end(), key))
    moments: list[Moment] = []
    written, done = '', 0
    for start, end, key in sorted(found, key=lambda one: (one[0], -one[1])):
        if start < done:
            continue
        before = text[done:start].split()[-1:]
        rank = _RANKS.get(before[0]) if before else None
        written += f'{text[done:start]}E{len(moments)}'
        moments.append(Moment(key=key, rank=rank, words=text[start:end]))
        done = end
    written += text[done:]
    one = re.search(r'\b(first|second)(?: one)?\b(?! E)', written)
    if len(moments) == 1 and moments[0].rank is not None and one is not None:
        moments.append(Moment(key=moments[0].key, rank=_RANKS[one.group(1)]))
        written = f'{written[: one.start()]}E1{written[one.end() :]}'
    return written, moments


def _which(rest: str, moments: Sequence[Moment]) -> tuple[Moment | None, Moment | None]:
    """Return the earlier and the later one."""
    if not moments:
        return None, None
    if len(moments) == 1:
        place = _EVENT.search(rest)
        assert place is not None
        before = rest[: place.start()]
        if _EARLIER.search(before):
            return (moments[0], None) if _NOT.search(before) else (None, moments[0])
        told_late = '|' in before
        return (moments[0], None) if told_late else (None, moments[0])
    one, other = moments[0], moments[1]
    between = rest.split('E0', 1)[1].split('E1', 1)[0]
    earlier = _EARLIER.search(between) is not None
    if 'between' in rest.split('E0', 1)[0] or re.search(r'\bfirst\b', between):
        earlier = True
    if earlier and _NOT.search(between):
        earlier = False
    return (one, other) if earlier else (other, one)
