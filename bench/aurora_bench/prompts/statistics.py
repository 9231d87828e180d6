# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a set of prompts consists of."""

from __future__ import annotations

import re
import statistics
from collections import Counter
from collections.abc import Sequence

from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.results import Table

_WORDY = 24
_ABBREVIATION = re.compile(
    r'\b(?:alt|pls|plz|w/|uav1|uav2|abt|secs?|mins?|mtrs?|kmh|kph|kmph|pct|msg|spd|thru|nite|ped|'
    r'im|lots|gets|bc|cuz|dist)\b|->|@|&|\d(?:m|s)\b'
)


def style(prompt: str) -> str:
    """Return `careless`, `wordy` or `plain`, by the look of the text.

    Careless: begins in lower case or lacks its full stop, and abbreviates or is all lower case.
    Wordy: 24 words or more.
    """
    is_loose = prompt[0].islower() or not prompt.rstrip().endswith(('.', '?', '!', '.”'))
    lower = sum(c.isupper() for c in prompt) <= 1
    if is_loose and (lower or prompt[0].islower() or _ABBREVIATION.search(prompt) is not None):
        return 'careless'
    return 'wordy' if len(prompt.split()) >= _WORDY else 'plain'


def statistics_tables(prompts: Sequence[AnnotatedPrompt]) -> tuple[Table, ...]:
    """Return tables by category, kind of requirement, length and style."""
    by_category = [
        (
            category,
            len(members := [p for p in prompts if p.category == category]),
            sum(len(p.requirements) for p in members) / len(members),
            statistics.mean(len(p.prompt.split()) for p in members),
            sum(p.end_to_end for p in members),
        )
        for category in sorted({p.category for p in prompts})
    ]
    kinds = Counter[str](r.kind for p in prompts for r in p.requirements)
    words = [len(p.prompt.split()) for p in prompts]
    lengths = Counter(min(n // 10 * 10, 50) for n in words)
    styles = Counter(style(p.prompt) for p in prompts)
    feasibility = Counter[str](p.feasibility for p in prompts)
    groups = Counter(p.paraphrase_group for p in prompts if p.paraphrase_group is not None)
    because = Counter[str](
        reading.because
        for p in prompts
        for r in p.requirements
        for reading in (r.any_of if r.kind == 'any_of' else (r,))
        if reading.kind == 'reject'
    )
    total = len(prompts)
    return (
        Table(
            headings=('category', 'prompts', 'requirements', 'words', 'end to end'),
            rows=(
                *by_category,
                (
                    'all',
                    total,
                    sum(kinds.values()) / total,
                    statistics.mean(words),
                    sum(p.end_to_end for p in prompts),
                ),
            ),
            caption='By category (requirements and words: mean per prompt)',
        ),
        _counts('kind of requirement', kinds),
        _counts('reason of refusal', because),
        _counts('feasibility', feasibility),
        _counts('style', styles),
        Table(
            headings=('words', 'prompts'),
            rows=tuple(
                (f'{low}+' if low == 50 else f'{low} to {low + 9}', lengths[low])
                for low in sorted(lengths)
            ),
        ),
        Table(
            headings=('paraphrase groups', 'prompts in them'),
            rows=((len(groups), sum(groups.values())),),
        ),
    )


def _counts(heading: str, counts: Counter[str]) -> Table:
    rows = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    return Table(headings=(heading, 'number'), rows=tuple(rows))
