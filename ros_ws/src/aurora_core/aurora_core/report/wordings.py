# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How to say what was not understood, or that no scenario can hold it: `wordings.yaml`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import yaml

from aurora_core.report.run_report import ClauseReport


@dataclass(frozen=True, slots=True, kw_only=True)
class Wording:
    """What a person could do about a clause.

    Attributes:
        text: Words of the prompt.
        so: What there is to know.
        say: A request like it that is understood, '' where nothing can hold it.
    """

    text: str
    so: str
    say: str


def wordings(clauses: Sequence[ClauseReport]) -> tuple[Wording, ...]:
    """Return one for every open clause that a row is about, each row once."""
    found: dict[str, Wording] = {}
    for clause in clauses:
        if not clause.status.is_open:
            continue
        for words, note, so, say in _rows():
            if words is not None and words.search(clause.text.lower()) is None:
                continue
            if note and note not in clause.note:
                continue
            found.setdefault(so, Wording(text=clause.text, so=so, say=say))
            break
    return tuple(found.values())


def sayings() -> tuple[str, ...]:
    """Return every request that a row proposes."""
    return tuple(say for _, _, _, say in _rows() if say)


@lru_cache(maxsize=1)
def _rows() -> tuple[tuple[re.Pattern[str] | None, str, str, str], ...]:
    text = Path(__file__).with_name('wordings.yaml').read_text('utf-8')
    return tuple(
        (
            re.compile(row['words']) if 'words' in row else None,
            row.get('note', ''),
            row['so'],
            row.get('say', ''),
        )
        for row in yaml.safe_load(text)
    )
