# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers written as words."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from aurora_core.parsing.lexicon import Lexicon, Tag


def spelled(words: Sequence[str], i: int, lexicon: Lexicon) -> tuple[Fraction, int] | None:
    """`forty five`, `a hundred and twenty`, `one and a half`, `two point five`."""
    total, current, j, seen = Fraction(0), Fraction(0), i, False
    while j < len(words):
        found = lexicon.longest_of(words, j, (Tag.NUMBER, Tag.MULTIPLIER))
        if found is None:
            if seen and _word(words, j) == 'and' and current and current % 100 == 0:
                follow = lexicon.longest_of(words, j + 1, (Tag.NUMBER,))
                if follow is not None and 0 < Fraction(follow[1].key) < 100:
                    j += 1
                    continue
            break
        length, sense = found
        value = Fraction(sense.key)
        if sense.tag is Tag.MULTIPLIER:
            if not seen:
                return None
            if value == 1000:
                total, current = total + current * value, Fraction(0)
            else:
                current *= value
        else:
            tens_then_unit = current % 100 in range(20, 100, 10) and value < 10
            if seen and not (current % 100 == 0 or tens_then_unit):
                break
            current += value
        seen = True
        j += length
    if not seen:
        return None
    value = total + current
    if _word(words, j) == 'and' and _word(words, j + 1) == 'a' and _word(words, j + 2) == 'half':
        return value + Fraction(1, 2), j + 3
    if _word(words, j) == 'point':
        digit = lexicon.longest_of(words, j + 1, (Tag.NUMBER,))
        if digit is not None and 0 <= Fraction(digit[1].key) < 10:
            return value + Fraction(digit[1].key) / 10, j + 2
    return value, j


def _word(words: Sequence[str], i: int) -> str:
    return words[i] if 0 <= i < len(words) else ''
