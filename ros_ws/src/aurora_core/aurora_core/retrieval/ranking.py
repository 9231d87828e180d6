# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rank texts for a query: by their words (BM25), and several rankings fused into one."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import bm25s
import numpy as np
import numpy.typing as npt
from bm25s.stopwords import STOPWORDS_EN

FloatArray = npt.NDArray[np.float64]

_WORD = re.compile(r'[^\W_]+')
_STOP = frozenset(STOPWORDS_EN)
# Finer differences are rounding, which another machine may do otherwise.
_DIGITS = 6


class Ranker(Protocol):
    """Knows some texts and says how well each fits a query."""

    @property
    def name(self) -> str:
        """Name and version, for the record."""

    def scores(self, query: str) -> FloatArray:
        """Return a score per text, in their order; 0 or less is no likeness at all."""


MakeRanker = Callable[[Sequence[str]], Ranker]


class LexicalRanker:
    """BM25 over words without their plural endings.

    Source: Robertson and Zaragoza, The Probabilistic Relevance Framework: BM25 and Beyond, 2009.

    Args:
        texts: At least one.
    """

    def __init__(self, texts: Sequence[str]) -> None:
        self._size = len(texts)
        self._index = bm25s.BM25(method='lucene')
        words = [search_words(text) for text in texts]
        self._known = {word for line in words for word in line}
        if self._known:
            self._index.index(words, show_progress=False)

    @property
    def name(self) -> str:
        """Name and version, for the record."""
        return f'bm25s {bm25s.__version__}'

    def scores(self, query: str) -> FloatArray:
        """Return BM25 scores; 0 for texts that share no word with the query."""
        words = [word for word in search_words(query) if word in self._known]
        if not words:
            return np.zeros(self._size)
        return np.asarray(self._index.get_scores(words), dtype=np.float64)


def search_words(text: str) -> list[str]:
    """Return the words of a text that carry meaning, in the singular.

    Source: the S stemmer of Harman, How effective is suffixing?, 1991.
    """
    words = (word.casefold() for word in _WORD.findall(text))
    return [_singular(word) for word in words if word not in _STOP]


def _singular(word: str) -> str:
    if word.endswith('ies') and not word.endswith(('eies', 'aies')):
        return word[:-3] + 'y'
    if word.endswith('es') and not word.endswith(('aes', 'ees', 'oes')):
        return word[:-1]
    if word.endswith('s') and not word.endswith(('us', 'ss')):
        return word[:-1]
    return word


def ranks(scores: FloatArray) -> dict[int, int]:
    """Return the rank from 1 of every text with a positive score; ties go by position."""
    rounded = np.round(scores, _DIGITS)
    order = [int(i) for i in np.argsort(-rounded, kind='stable') if rounded[i] > 0.0]
    return {i: rank for rank, i in enumerate(order, start=1)}


def fuse(rankings: Mapping[str, Mapping[int, int]], k: float) -> dict[int, float]:
    """Return reciprocal rank fusion scores: the sum of 1 / (k + rank) over the rankings.

    Source: Cormack, Clarke and Büttcher, Reciprocal Rank Fusion, 2009.
    """
    fused: dict[int, float] = {}
    for name in sorted(rankings):
        for i, rank in rankings[name].items():
            fused[i] = fused.get(i, 0.0) + 1.0 / (k + rank)
    return fused
