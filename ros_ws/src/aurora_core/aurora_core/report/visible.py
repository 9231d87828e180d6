# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Text from outside, made safe for a terminal.

A prompt may hold anything, and a report quotes it. Written raw, an escape sequence in it could
clear the screen and paint another verdict there; so could a line break in a table, and marks that
turn the direction of writing.
"""

from __future__ import annotations

import re
import unicodedata

# Cc: control characters of ASCII and Latin-1; Cf: direction marks and other signs without a shape.
_HIDDEN = ('Cc', 'Cf', 'Cs', 'Co', 'Zl', 'Zp')
_BLANKS = re.compile(r'[\t\n\r]+')
# What JSON lets through and a terminal obeys: DEL, the controls of Latin-1, direction marks.
_OBEYED = re.compile('[\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]')


def visible(text: str) -> str:
    r"""Return text with every character that a terminal would obey as `\x1b` or `\u202e`.

    Line breaks and tabs stay.
    """
    if text.isprintable():
        return text
    return ''.join(_shown(character) for character in text)


def one_line(text: str) -> str:
    """Return visible text on a single line: line breaks and tabs become blanks."""
    return visible(_BLANKS.sub(' ', text))


def visible_json(text: str) -> str:
    """Return JSON text of the same value, with what a terminal would obey in it escaped."""
    return _OBEYED.sub(lambda found: f'\\u{ord(found[0]):04x}', text)


def _shown(character: str) -> str:
    if character in '\t\n\r' or unicodedata.category(character) not in _HIDDEN:
        return character
    code = ord(character)
    if code < 0x100:
        return f'\\x{code:02x}'
    return f'\\u{code:04x}' if code < 0x10000 else f'\\U{code:08x}'
