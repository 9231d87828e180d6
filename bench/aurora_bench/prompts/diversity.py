# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How varied the wording of prompts is: distinct n-grams and self-BLEU.

Words are runs of letters and digits in lower case; every number counts as the same word, since
another number is no other wording.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence

LONGEST = 4

_NUMBER = re.compile(r'\d+(?:[.,]\d+)*')
_WORD = re.compile(r'#|[^\W\d_]+')

Gram = tuple[str, ...]


def words(text: str) -> list[str]:
    """Return the words of a prompt, numbers as `#`."""
    return _WORD.findall(_NUMBER.sub(' # ', text.lower()))


def distinct(texts: Sequence[str], n: int) -> float:
    """Return the number of different n-grams of all texts divided by the number of n-grams.

    Source: Li et al. (2016), "A diversity-promoting objective function for neural conversation
    models", distinct-n.
    """
    grams = [gram for text in texts for gram in _grams(words(text), n)]
    return len(set(grams)) / len(grams) if grams else 0.0


def self_bleu(texts: Sequence[str], n: int) -> float:
    """Return the mean BLEU-n of each text with all others as its references.

    0: no two share n words in a row; 1: every text is made of pieces of others. The precisions of
    orders 1 to n have equal weights, the brevity penalty takes the nearest length of another text,
    and there is no smoothing: a text without any shared n-gram has 0. A text of fewer than n words
    is judged by the orders that it has.

    Source: Zhu et al. (2018), "Texygen", on Papineni et al. (2002), "BLEU".
    """
    tokens = [words(text) for text in texts]
    tokens = [t for t in tokens if t]
    if len(tokens) < 2:
        return 0.0
    lengths = Counter(len(t) for t in tokens)
    logs = [0.0] * len(tokens)
    for order in range(1, n + 1):
        counts = [Counter(_grams(t, order)) for t in tokens]
        best = _two_greatest(counts)
        for k, own in enumerate(counts):
            if own:
                logs[k] += _log(_precision(own, best)) / min(n, len(tokens[k]))
    scores = [
        math.exp(logs[k] + _brevity(len(t), lengths)) if logs[k] > -math.inf else 0.0
        for k, t in enumerate(tokens)
    ]
    return sum(scores) / len(scores)


def _grams(tokens: Sequence[str], n: int) -> list[Gram]:
    return [tuple(tokens[k : k + n]) for k in range(len(tokens) - n + 1)]


def _two_greatest(counts: Sequence[Counter[Gram]]) -> dict[Gram, tuple[int, int]]:
    """Return the greatest and the next count of each n-gram over the texts."""
    best: dict[Gram, tuple[int, int]] = {}
    for own in counts:
        for gram, count in own.items():
            first, second = best.get(gram, (0, 0))
            best[gram] = (count, first) if count > first else (first, max(second, count))
    return best


def _precision(own: Counter[Gram], best: dict[Gram, tuple[int, int]]) -> float:
    """Clip each count by the greatest one of the other texts."""
    clipped = 0
    for gram, count in own.items():
        first, second = best[gram]
        clipped += min(count, second if count == first else first)
    return clipped / own.total()


def _brevity(length: int, lengths: Counter[int]) -> float:
    """Return the logarithm of the brevity penalty against the nearest length of the others."""
    others = [other for other, count in lengths.items() if other != length or count > 1]
    nearest = min(others, key=lambda other: (abs(other - length), other))
    return min(0.0, 1.0 - nearest / length)


def _log(value: float) -> float:
    return math.log(value) if value > 0.0 else -math.inf
