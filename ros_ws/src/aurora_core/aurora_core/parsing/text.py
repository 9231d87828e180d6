# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What may be a prompt at all."""

from __future__ import annotations

from aurora_core.errors import PromptError

MAX_PROMPT_BYTES = 8192
_REPLACEMENT = '\ufffd'


def check_prompt_text(raw: bytes | str) -> str:
    """Return the prompt as text, byte-identical to what came in.

    Args:
        raw: UTF-8 bytes or text.

    Raises:
        PromptError: Empty, blanks only, longer than 8 KiB of UTF-8, a NUL, not valid UTF-8, or
            with characters that stand for bytes that somebody before us could not read.
    """
    text, size = _of_bytes(raw) if isinstance(raw, bytes) else _of_text(raw)
    _check_size(size)
    if '\x00' in text:
        raise PromptError(
            f'the prompt must not contain NUL, found one at {text.index(chr(0))}',
            hint='remove the NUL character',
        )
    if _REPLACEMENT in text:
        # ROS 2 and many editors put it where bytes are not UTF-8: what was meant is lost.
        raise PromptError(
            'the prompt must be the text that was written, found U+FFFD (something that could '
            f'not be read on the way here) at {text.index(_REPLACEMENT)}',
            hint='save or send the text as UTF-8',
        )
    if not text.strip():
        raise PromptError(
            'the prompt must say what to simulate, found no text',
            hint='for example: A drone follows a motorcycle at 40 meters altitude.',
        )
    return text


def _of_bytes(raw: bytes) -> tuple[str, int]:
    # The length first: bytes beyond the limit need not even be text.
    _check_size(len(raw))
    try:
        return raw.decode('utf-8'), len(raw)
    except UnicodeDecodeError as err:
        raise PromptError(
            f'the prompt must be UTF-8, found byte 0x{raw[err.start]:02x} at {err.start}',
            hint='save or send the text as UTF-8',
        ) from err


def _of_text(text: str) -> tuple[str, int]:
    try:
        return text, len(text.encode('utf-8'))
    except UnicodeEncodeError as err:
        raise PromptError(
            f'the prompt must be valid Unicode, found a lone surrogate at {err.start}',
            hint='save or send the text as UTF-8',
        ) from err


def _check_size(size: int) -> None:
    if size > MAX_PROMPT_BYTES:
        raise PromptError(
            f'the prompt may have {MAX_PROMPT_BYTES} bytes, found {size}',
            hint='describe one scenario per prompt',
        )
