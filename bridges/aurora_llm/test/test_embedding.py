# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Word vectors: what they add to words, and what happens without them."""

from __future__ import annotations

import importlib.util
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from aurora_core.retrieval.ranking import LexicalRanker
from aurora_llm.embedding import EmbeddingRanker, WordVectors, installed_vectors, rankers

TEXTS = ('lorry', 'motorbike', 'nurse')
IS_NUMPY_1 = int(np.__version__.split('.')[0]) < 2


class Letters:
    """Cuts a text into its letters; a is piece 0."""

    def encode(self, text: str, *, add_special_tokens: bool) -> SimpleNamespace:
        assert not add_special_tokens
        return SimpleNamespace(ids=[ord(letter) - ord('a') for letter in text])


def test_likeness_is_the_cosine_of_mean_vectors() -> None:
    table = np.array([[1.0, 0.0], [0.0, 2.0], [-3.0, 0.0]], dtype=np.float32)
    vectors = WordVectors(name='letters 1', table=table, tokenizer=Letters())
    ranker = EmbeddingRanker(vectors, ('a', 'b', 'c', 'aaab', ''))
    assert ranker.name == 'letters 1'
    # "aaab" has the mean (3, 2) / 4; a text without pieces is like nothing.
    expected = [1.0, 0.0, -1.0, 3.0 / np.sqrt(13.0), 0.0]
    assert ranker.scores('aa') == pytest.approx(expected, abs=1e-6)
    assert not ranker.scores('').any()


# The locks for a system's ROS leave the wheel out (requirements/run.in); all others have it.
@pytest.mark.skipif(IS_NUMPY_1, reason="wordllama wants numpy 2; a system's ROS has numpy 1")
def test_a_paraphrase_without_a_common_word_is_found() -> None:
    vectors = installed_vectors()
    assert vectors is not None
    scores = EmbeddingRanker(vectors, TEXTS).scores('a big truck')
    assert int(np.argmax(scores)) == 0
    assert not LexicalRanker(TEXTS).scores('a big truck').any()
    assert 'wordllama' not in sys.modules, 'its code must not be imported'
    assert np.array_equal(scores, EmbeddingRanker(vectors, TEXTS).scores('a big truck'))
    assert np.isfinite(EmbeddingRanker(vectors, ('', 'x')).scores('')).all()


def test_without_the_wheel_words_alone_rank(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, 'find_spec', lambda _: None)
    installed_vectors.cache_clear()
    try:
        assert rankers(embedding=True) == (LexicalRanker,)
    finally:
        installed_vectors.cache_clear()


def test_the_setting_turns_vectors_off() -> None:
    assert rankers(embedding=False) == (LexicalRanker,)
