# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of the parts of a document: `REQ-3:`, `[R4]`, `Criterion B:`, `3.1 The UAV …`, `2. …`.

Each becomes the mark that ends the sentence before it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.lexicon import Lexicon, Tag
from aurora_core.parsing.tokens import Token, TokenKind

_ENDS = frozenset('.;:!?\n')
_GLUE = frozenset('-_/.#')
_CLOSES = {'[': ']', '(': ')'}
_MOST_WORDS = 3


def part_labels(tokens: Sequence[Token], lexicon: Lexicon) -> tuple[Token, ...]:
    """Return the tokens with one mark for each label of a part."""
    kept: list[Token] = []
    i = 0
    while i < len(tokens):
        opens = not kept or kept[-1].norm in _ENDS
        end = _label(tokens, i, lexicon) if opens else None
        if end is None:
            kept.append(tokens[i])
            i += 1
            continue
        last = tokens[end - 1].end
        kept.append(replace(tokens[i], kind=TokenKind.MARK, norm=';', end=last, value=None))
        i = end
    return tuple(kept)


def _label(tokens: Sequence[Token], i: int, lexicon: Lexicon) -> int | None:
    """Return where the label ends that begins here."""
    closing = _CLOSES.get(tokens[i].norm)
    first = i if closing is None else i + 1
    at = _name(tokens, first, lexicon)
    named = at > first
    end = _number(tokens, at)
    if end is None or end >= len(tokens):
        return None
    behind = tokens[end]
    dotted = '.' in tokens[at].norm
    if closing is not None:
        return end + 1 if behind.norm == closing and (named or dotted) else None
    if named and behind.norm in (':', ';', ')'):
        return end + 1
    begins = behind.kind is TokenKind.WORD and (behind.proper or behind.capital)
    unit = lexicon.longest_of([t.norm for t in tokens[end : end + 2]], 0, (Tag.UNIT,))
    begins = begins and unit is None  # `1.2 M` is a length
    known = tokens[at - 1].norm in lexicon.turns['numbered'] if named else False
    return end if begins and not behind.glued and (dotted or (named and not known)) else None


def _name(tokens: Sequence[Token], i: int, lexicon: Lexicon) -> int:
    """Return where the words end that name a kind of part: `SYS`, `REQ-NAV`, `test case`."""
    begin = i
    while i < len(tokens) and i < begin + 2 * _MOST_WORDS:
        token = tokens[i]
        names = token.norm in lexicon.turns['numbered'] or (
            token.upper and token.norm not in lexicon.words
        )
        if not names and not (i > begin and token.norm in _GLUE and token.glued):
            break
        i += 1
    return i


def _number(tokens: Sequence[Token], i: int) -> int | None:
    """Return where `12`, `3.1`, `12a`, `B` ends."""
    if i >= len(tokens):
        return None
    if tokens[i].kind is TokenKind.NUMBER:
        letter = i + 1 < len(tokens) and tokens[i + 1].glued and len(tokens[i + 1].norm) == 1
        return i + 2 if letter and tokens[i + 1].kind is TokenKind.WORD else i + 1
    return i + 1 if tokens[i].capital else None
