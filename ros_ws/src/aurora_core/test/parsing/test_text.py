# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What may be a prompt, byte for byte."""

from __future__ import annotations

import pytest

from aurora_core.errors import PromptError
from aurora_core.parsing.text import MAX_PROMPT_BYTES, check_prompt_text


@pytest.mark.parametrize(
    ('raw', 'says'),
    [
        ('', 'no text'),
        (' \t\n ', 'no text'),
        ('a drone\x00', 'NUL'),
        (b'a drone\xff', 'UTF-8'),
        ('a drone \ud800', 'surrogate'),
        ('a drone \ufffd', 'could not be read'),
        ('a drone \ufffd'.encode(), 'could not be read'),
        # The limit comes first: what is beyond it need not be text.
        (b'\xff' * (MAX_PROMPT_BYTES + 1), '8192'),
        ('a' * (MAX_PROMPT_BYTES + 1), '8192'),
        ('é' * (MAX_PROMPT_BYTES // 2 + 1), '8192'),
    ],
)
def test_refused_with_the_reason(raw: bytes | str, says: str) -> None:
    with pytest.raises(PromptError, match=says) as caught:
        check_prompt_text(raw)
    assert caught.value.code == 200
    assert caught.value.hint


def test_kept_byte_identical() -> None:
    raw = '  A drone – 30 m, Straße…\r\n'
    assert check_prompt_text(raw) == raw
    assert check_prompt_text(raw.encode()) == raw


def test_longest_prompt_is_accepted() -> None:
    assert len(check_prompt_text('a' * MAX_PROMPT_BYTES)) == MAX_PROMPT_BYTES
