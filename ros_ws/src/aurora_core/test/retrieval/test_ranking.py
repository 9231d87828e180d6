# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rankings by words, and their fusion worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_core.retrieval.ranking import LexicalRanker, fuse, ranks, search_words


def test_the_text_with_the_rare_word_comes_first() -> None:
    texts = ('a car drives', 'a car at the hospital', 'a bus drives')
    scores = LexicalRanker(texts).scores('Which cars are near hospitals?')
    assert ranks(scores) == {1: 1, 0: 2}
    assert scores[2] == 0.0


@pytest.mark.parametrize('query', ['', '???', 'zzz', 'the of and'])
def test_a_query_without_a_known_word_is_like_nothing(query: str) -> None:
    assert ranks(LexicalRanker(('a car', 'a bus')).scores(query)) == {}
    assert ranks(LexicalRanker(('the', '!')).scores(query)) == {}


def test_words_lose_plural_endings_and_fillers() -> None:
    assert search_words('The buses, lorries and the glass of Tinker') == [
        'buse',
        'lorry',
        'glass',
        'tinker',
    ]


def test_fusion_by_hand() -> None:
    fused = fuse({'a': {0: 1, 1: 2}, 'b': {1: 1, 2: 2}}, 60.0)
    assert fused == pytest.approx({0: 1 / 61, 1: 1 / 62 + 1 / 61, 2: 1 / 62})


def test_ties_and_rounding_go_by_position() -> None:
    scores = np.array([0.5, 0.5 + 1e-9, 0.7, -0.1, 0.0])
    assert ranks(scores) == {2: 1, 0: 2, 1: 3}
