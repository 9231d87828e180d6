# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What people say around a request: `what matters to us is that`, `for a lesson on traffic`.

Such openings are built from a few families of words, so they are patterns over these families
(`preludes:` in the lexicon) and no list of sentences. They ask nothing.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

# Words that a pattern looks at: the longest opening is shorter.
_MOST = 24
_FAMILY = re.compile(r'<(\w+)>')


class Preludes:
    """Finds openings in the words of a prompt."""

    def __init__(self, data: Mapping[str, Any]) -> None:
        families: dict[str, str] = {}
        for name, phrases in data['words'].items():
            ordered = sorted((_filled(p, families) for p in phrases), key=len, reverse=True)
            families[name] = f'(?:{"|".join(ordered)})'
        self._texts = [_filled(p, families) + r'(?= |$)' for p in data['patterns']]
        self._starts = re.compile('|'.join(self._texts))

    def read(self, words: Sequence[str], i: int) -> int | None:
        """Return the index behind the opening that starts at word i, None when none does."""
        text = ' '.join(words[i : i + _MOST])
        if self._starts.match(text) is None:
            return None
        # Each by itself only now: most prompts open none.
        patterns = [re.compile(p) for p in self._texts]
        found = [m.end() for p in patterns if (m := p.match(text)) is not None]
        return i + text[: max(found)].count(' ') + 1


def _filled(pattern: str, families: Mapping[str, str]) -> str:
    return _FAMILY.sub(lambda m: families[m.group(1)], pattern)
