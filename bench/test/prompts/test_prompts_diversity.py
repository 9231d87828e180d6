# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Diversity of wording, against values worked out by hand."""

from __future__ import annotations

import math

import pytest

from aurora_bench.prompts.diversity import distinct, self_bleu, words


def test_numbers_are_one_word_and_case_does_not_count() -> None:
    assert words('Hover at 40m, or 1,5 min') == ['hover', 'at', '#', 'm', 'or', '#', 'min']


def test_distinct_counts_different_n_grams() -> None:
    texts = ['a drone hovers', 'a drone lands']
    assert distinct(texts, 1) == pytest.approx(4 / 6)
    assert distinct(texts, 2) == pytest.approx(3 / 4)
    assert distinct(['one'], 2) == 0.0


def test_equal_texts_are_made_of_each_other_and_strangers_are_not() -> None:
    assert self_bleu(['a drone hovers here', 'A drone hovers here.'], 4) == pytest.approx(1.0)
    assert self_bleu(['a drone hovers', 'the bus stops'], 1) == 0.0
    assert self_bleu(['alone in the world'], 4) == 0.0


def test_precisions_are_clipped_and_averaged_geometrically() -> None:
    # "a a b" against "a b": words 2 of 3 (the second "a" is one too many), pairs 1 of 2.
    # "a b" against "a a b": words 2 of 2, pairs 1 of 1, and 2 words where the other has 3.
    first, second = math.sqrt(2 / 3 * 1 / 2), math.exp(1 - 3 / 2)
    assert self_bleu(['a a b', 'a b'], 2) == pytest.approx((first + second) / 2)


def test_a_short_text_is_judged_by_the_orders_that_it_has() -> None:
    assert self_bleu(['hover', 'hover', 'hover'], 4) == pytest.approx(1.0)
