# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A prompt that was changed on the way is noticed."""

from __future__ import annotations

import pytest

from aurora_core.errors import PromptError
from aurora_nodes.prompts import received_prompt


def test_a_prompt_of_the_stated_length_is_unchanged() -> None:
    text = '  Ein Fahrrad fährt.\n'
    assert received_prompt(text, len(text.encode())) == text
    assert received_prompt(text, 0) == text


def test_a_prompt_cut_by_a_nul_is_refused() -> None:
    sent = 'A drone hovers\0 and lands'
    with pytest.raises(PromptError, match='expected a prompt of 25 bytes, 14 arrived'):
        received_prompt(sent.split('\0')[0], len(sent))


@pytest.mark.parametrize('text', ['', '   ', 'x' * 9000, '\ud800'])
def test_what_cannot_be_a_prompt_is_refused(text: str) -> None:
    with pytest.raises(PromptError):
        received_prompt(text, 0)
