# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Word vectors: what they add to words, and what happens without them."""

from __future__ import annotations

import importlib.util
import sys

import numpy as np
import pytest

from aurora_core.retrieval.ranking import LexicalRanker
from aurora_llm.embedding import EmbeddingRanker, installed_vectors, rankers

TEXTS = ('lorry', 'motorbike', 'nurse')


def test_a_paraphrase_without_a_common_word_is_found() -> None:
    vectors = installed_vectors()
    if int(np.__version__.split('.')[0]) < 2:
        pytest.skip("beside a system's ROS there is numpy 1, and wordllama wants numpy 2")
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
