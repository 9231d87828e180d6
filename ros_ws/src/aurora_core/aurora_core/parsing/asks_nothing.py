# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words that were not read and ask for nothing: purposes, titles, thanks, remarks, filler.

Which they are stands in one table, `asks_nothing.yaml`, each row with its reason. An unread
stretch of the prompt is set aside when phrases of the table make up all of it; whatever else
stands in it (a number, a body, a deed) leaves it unread.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.scene import ClauseDraft
from aurora_core.parsing.tokens import Token, TokenKind, tokenize
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import ClauseStatus

BESIDE, LABEL = 'beside', 'label'
_WORD, _NAME = '<word>', '<name>'
# Marks that may stand between phrases, and around them.
_SILENT = frozenset('.,;:!?()[]"\'-–—…/\n')


@dataclass(frozen=True, slots=True, kw_only=True)
class _Phrase:
    """One wording of the table.

    Attributes:
        parts: In order, each with its alternatives, of which one may be empty.
        where: It asks for nothing there alone; empty for anywhere.
    """

    parts: tuple[tuple[tuple[str, ...], ...], ...]
    reason: str
    where: str


def set_aside(clauses: Sequence[ClauseDraft], prompt: str) -> list[Span]:
    """Turn unread clauses that ask for nothing into `no_requirement`, each with its reason.

    Args:
        clauses: Of one prompt; their status and notes change.
        prompt: What their spans refer to.

    Returns:
        Where they stand.
    """
    aside = []
    for clause in clauses:
        if clause.status is not ClauseStatus.NOT_ENCODED:
            continue
        beside = any(
            c.status is ClauseStatus.ENCODED
            and c.span.start <= clause.span.start
            and clause.span.end <= c.span.end
            for c in clauses
        )
        places = frozenset(
            ('', *[BESIDE] * beside, *[LABEL] * stands_as_label(clause.span, prompt))
        )
        reason = reason_of(prompt[clause.span.start : clause.span.end], places)
        if reason is not None:
            clause.status = ClauseStatus.NO_REQUIREMENT
            clause.notes = [reason]
            aside.append(clause.span)
    return aside


def stands_as_label(span: Span, prompt: str) -> bool:
    """Return whether a colon follows, or nothing else stands in the line."""
    ahead, behind = prompt[: span.start].rstrip(' '), prompt[span.end :].lstrip(' ')
    alone = (not ahead or ahead.endswith('\n')) and (not behind or behind.startswith('\n'))
    return alone or behind.startswith(':')


def reason_of(text: str, places: Collection[str] = ('',)) -> str | None:
    """Return why words ask for nothing, None where they may ask for something.

    Args:
        text: Words of a prompt that were not read.
        places: Where they stand, in the words of the table.
    """
    tokens = [t for t in tokenize(text) if t.norm not in _SILENT]
    # Why everything up to a token asks for nothing, by the number of that token.
    reached: dict[int, str] = {0: ''}
    for i in range(len(tokens)):
        if i not in reached:
            continue
        for phrase in _table():
            if phrase.where not in places:
                continue
            for end in _ends(phrase, tokens, i):
                reached.setdefault(end, reached[i] or phrase.reason)
    return reached.get(len(tokens)) or None


def _ends(phrase: _Phrase, tokens: Sequence[Token], i: int) -> set[int]:
    """Return the numbers of the tokens in front of which a phrase that begins at one may end."""
    ends = {i}
    for part in phrase.parts:
        ends = {
            end + len(words)
            for end in ends
            for words in part
            if end + len(words) <= len(tokens) and all(map(_is, tokens[end:], words))
        }
    return ends - {i}


def _is(token: Token, word: str) -> bool:
    if word == _NAME:
        return token.kind is TokenKind.WORD and token.proper
    if word == _WORD:
        return token.kind is TokenKind.WORD and token.norm not in shipped_lexicon().words
    return token.norm == word and not token.capital


@lru_cache(maxsize=1)
def _table() -> tuple[_Phrase, ...]:
    return tuple(
        _Phrase(parts=tuple(_parts(words)), reason=row['reason'], where=row.get('where', ''))
        for row in read_data('asks_nothing.yaml').values()
        for words in row['phrases']
    )


def _parts(phrase: str) -> Iterator[tuple[tuple[str, ...], ...]]:
    """Yield the parts of `the (long|short|) way`: words, and groups of alternatives."""
    for part in re.findall(r'\([^)]*\)|[^ ()]+', phrase):
        yield tuple(tuple(words.split()) for words in part.strip('()').split('|'))
