# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Check that a prompt came over the wire as it was sent."""

from __future__ import annotations

from aurora_core.errors import PromptError
from aurora_core.parsing.text import check_prompt_text


def received_prompt(prompt: str, prompt_bytes: int) -> str:
    """Return a prompt that is what the client sent.

    Args:
        prompt: As received; a NUL has silently cut it.
        prompt_bytes: Length in UTF-8 bytes that the client states, 0 when it does not.

    Raises:
        PromptError: The lengths differ, or the text cannot be a prompt.
    """
    found = len(prompt.encode('utf-8', errors='surrogatepass'))
    if prompt_bytes and found != prompt_bytes:
        raise PromptError(
            f'expected a prompt of {prompt_bytes} bytes, {found} arrived',
            hint='a NUL character cuts a ROS string: remove it',
        )
    return check_prompt_text(prompt)
