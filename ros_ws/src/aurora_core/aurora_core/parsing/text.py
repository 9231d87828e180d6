# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What may be a prompt at all."""

from __future__ import annotations

from aurora_core.errors import PromptError

MAX_PROMPT_BYTES = 8192


def check_prompt_text(raw: bytes | str) -> str:
    """Return the prompt as text, byte-identical to what came in.

    Args:
        raw: UTF-8 bytes or text.

    Raises:
        PromptError: Empty, blanks only, longer than 8 KiB of UTF-8, a NUL, or not valid UTF-8.
    """
    if isinstance(raw, bytes):
        size = len(raw)
        try:
            text = raw.decode('utf-8')
        except UnicodeDecodeError as err:
            raise PromptError(
                f'the prompt must be UTF-8, found byte 0x{raw[err.start]:02x} at {err.start}',
                hint='save or send the text as UTF-8',
            ) from err
    else:
        text = raw
        try:
            size = len(text.encode('utf-8'))
        except UnicodeEncodeError as err:
            raise PromptError(
                f'the prompt must be valid Unicode, found a lone surrogate at {err.start}',
                hint='save or send the text as UTF-8',
            ) from err
    if size > MAX_PROMPT_BYTES:
        raise PromptError(
            f'the prompt may have {MAX_PROMPT_BYTES} bytes, found {size}',
            hint='describe one scenario per prompt',
        )
    if '\x00' in text:
        raise PromptError(
            f'the prompt must not contain NUL, found one at {text.index(chr(0))}',
            hint='remove the NUL character',
        )
    if not text.strip():
        raise PromptError(
            'the prompt must say what to simulate, found no text',
            hint='for example: A drone follows a motorcycle at 40 meters altitude.',
        )
    return text
