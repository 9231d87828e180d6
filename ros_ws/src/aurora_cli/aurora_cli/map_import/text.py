# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Text out of foreign files, fit for names."""

from __future__ import annotations

import unicodedata

MOST_CHARACTERS = 64


def plain_name(text: str) -> str:
    """Return a name on one line: no control or direction marks, spaces single, cut when long."""
    spaced = ''.join(
        ' ' if unicodedata.category(c) in ('Zs', 'Zl', 'Zp', 'Cc') else c for c in text
    )
    kept = ''.join(c for c in spaced if unicodedata.category(c) not in ('Cf', 'Cs', 'Co', 'Cn'))
    return ' '.join(unicodedata.normalize('NFC', kept).split())[:MOST_CHARACTERS].strip()
