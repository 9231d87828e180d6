# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tokens that stand for others.

`drone Bravo` is drone B, `its at 30 m` is `it is at 30 m`, `has left the park` has departed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.lexicon import Lexicon
from aurora_core.parsing.tokens import Token, TokenKind

_CUT = len('it')


def written_out(tokens: Sequence[Token], lexicon: Lexicon) -> tuple[Token, ...]:
    """Return the tokens with callsigns as letters, and words that look like others written out."""
    told: list[Token] = []
    called = _callsigns(tokens, lexicon)
    for i, token in enumerate(tokens):
        if i in called:
            told.append(replace(token, norm=called[i], capital=True, proper=False))
        elif i and tokens[i - 1].norm in lexicon.helped and token.norm in lexicon.helped_forms:
            told.append(replace(token, norm=lexicon.helped_forms[token.norm]))
        elif token.norm == 'its' and _is_there(tokens, i, lexicon):
            cut = token.start + _CUT
            told.append(replace(token, norm='it', end=cut))
            told.append(
                Token(kind=TokenKind.WORD, norm='is', start=cut, end=token.end, glued=True)
            )
        else:
            told.append(token)
    return tuple(told)


def _callsigns(tokens: Sequence[Token], lexicon: Lexicon) -> dict[int, str]:
    """Return the letter of every callsign: of two that are told, or of one with its type."""
    found = {
        i: lexicon.callsigns[token.norm]
        for i, token in enumerate(tokens)
        if token.norm in lexicon.callsigns and token.proper
    }
    return found if len(set(found.values())) > 1 else {}


def _is_there(tokens: Sequence[Token], i: int, lexicon: Lexicon) -> bool:
    behind = tokens[i + 1] if i + 1 < len(tokens) else None
    return behind is not None and behind.norm in lexicon.it_is
