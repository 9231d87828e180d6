# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The quick look for wishes lets no wish through, and spares a plain prompt the long pattern."""

from __future__ import annotations

import pytest

from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.lexicon import expanded
from aurora_core.parsing.rewriting import wrapping


@pytest.mark.parametrize(
    'text',
    [
        "what we'd like to see for our tests is that a bus stops",
        'so we would be glad if you could set up a bus',
        'and would very much like to see a bus',
        'the scene is as follows',
        'could you please build a bus',
        'would you be so kind as to draw up a bus',
        "(please) it's important to us that a bus stops",
        "'make sure' that a bus stops",
        'what counts is that a bus stops',
        'it counts as a success if a bus stops',
        'our test is valid only if a bus stops',
        'our customers insist on 30 m',
        'a bus would be best for us',
        'a bus stops, if that is possible',
    ],
)
def test_a_wish_is_not_overlooked(text: str) -> None:
    assert wrapping._wishes().search(text) is not None
    assert wrapping._may_wish(text)


def test_every_phrase_that_is_a_wish_by_itself_is_not_overlooked() -> None:
    lists = read_data('lexicon.yaml')['wishes']
    for name in ('please', 'sure', 'asides'):
        for phrase in expanded(lists[name]):
            assert wrapping._wishes().search(phrase) is not None
            assert wrapping._may_wish(phrase), phrase


def test_a_plain_prompt_needs_no_long_pattern() -> None:
    assert not wrapping._may_wish('a drone ascends to 40 meters and then follows a motorcycle')
