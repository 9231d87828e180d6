# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words of the graph's picture: how wide they are, and how they wrap."""

from __future__ import annotations

from functools import lru_cache

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from aurora_core.report.scene import style

_FAMILY = style.RC['font.family']
# Glyphs fitted to the pixels of a PNG are a little wider than their outlines.
_HINTED = 1.03


@lru_cache(maxsize=4096)
def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Return the width of a text in points."""
    if not text.strip():
        return 0.3 * size * len(text)
    font = FontProperties(family=_FAMILY, weight='bold' if bold else 'normal')
    font.set_size(size)
    return _HINTED * float(text_to_path.get_text_width_height_descent(text, font, False)[0])


def wrapped(text: str, size: float, width: float, *, bold: bool = False) -> list[str]:
    """Return the lines of a text; a word that is too wide has a line of its own."""
    lines: list[str] = []
    for word in text.split():
        longer = f'{lines[-1]} {word}' if lines else word
        if lines and text_width(longer, size, bold=bold) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines
