# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The word lists of `criteria.yaml` as regular expressions."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

from aurora_core.parsing.data_files import read_data


@dataclass(frozen=True, slots=True, kw_only=True)
class Words:
    """One pattern for each list; each matches whole words only."""

    lists: dict[str, re.Pattern[str]]
    topics: dict[str, re.Pattern[str]]
    events: dict[str, re.Pattern[str]]

    def __getitem__(self, name: str) -> re.Pattern[str]:
        return self.lists[name]


def any_of(entries: list[str]) -> str:
    """Return one group for the entries of a list, longer alternatives first."""
    parts = [part for entry in entries for part in _alternatives(entry)]
    return '(?:' + '|'.join(sorted(parts, key=len, reverse=True)) + ')'


def whole(pattern: str) -> re.Pattern[str]:
    """Return a pattern that begins and ends at the ends of words."""
    return re.compile(rf"(?<![\w']){pattern}(?![\w'])")


@lru_cache(maxsize=1)
def criteria_words() -> Words:
    """Return the shipped lists."""
    data = read_data('criteria.yaml')
    topics, events = data.pop('topics'), data.pop('events')
    data.pop('causes')
    return Words(
        lists={name: whole(any_of(entries)) for name, entries in data.items()},
        topics={name: whole(any_of(entries)) for name, entries in topics.items()},
        events={name: whole(any_of(entries)) for name, entries in events.items()},
    )


_NO_WORD = '(?!)'


@lru_cache(maxsize=1)
def cause_words() -> dict[str, re.Pattern[str]]:
    """Return the lists of each kind of cause as `kind_list`, and `fill`."""
    kinds = read_data('criteria.yaml')['causes']
    lists = {'fill': kinds.pop('fill')}
    for kind, parts in kinds.items():
        for part in ('needs', 'weak', 'also', 'beside'):
            lists[f'{kind}_{part}'] = parts.get(part, [_NO_WORD])
    return {name: whole(any_of(entries)) for name, entries in lists.items()}


def _alternatives(entry: str) -> list[str]:
    """Cut at the bars that no bracket encloses."""
    parts, depth, begin = [], 0, 0
    for i, letter in enumerate(entry):
        depth += (letter in '([') - (letter in ')]')
        if letter == '|' and not depth:
            parts.append(entry[begin:i])
            begin = i + 1
    return [*parts, entry[begin:]]
