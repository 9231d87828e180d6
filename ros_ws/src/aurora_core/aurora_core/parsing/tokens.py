# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words, numbers and marks of a prompt, each with its place in the text."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction


class TokenKind(StrEnum):
    WORD = 'word'
    NUMBER = 'number'
    MARK = 'mark'


@dataclass(frozen=True, slots=True, kw_only=True)
class Token:
    """One token.

    Attributes:
        norm: Lower case, apostrophes unified.
        start: First character in the prompt.
        end: One past the last.
        value: Exact value of a number; None when its notation is not one that is read.
        glued: No blank between this token and the one before.
        capital: A single capital letter (`drone B`).
        proper: Begins with a capital letter, as names do.
        upper: Written in capitals alone, as abbreviations are.
    """

    kind: TokenKind
    norm: str
    start: int
    end: int
    value: Fraction | None = None
    glued: bool = False
    capital: bool = False
    proper: bool = False
    upper: bool = False


# `100x60` must not become the word `x60m`, while `v2x` is a word.
_TOKEN = re.compile(
    r"""
    (?P<number>(?:\d+|\.\d+)(?:[.,:/^*]\d+)*(?:[eE][+-]?\d+)?)
    |(?P<word>(?![xX]\d)[^\W\d_]+\d+[^\W\d_]+(?:'[^\W\d_]+)*|[^\W\d_]+(?:['’][^\W\d_]+)*)
    |(?P<space>\s+)
    |(?P<mark>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_PLAIN = re.compile(r'(?:\d+(?:\.\d+)?|\.\d+)(?:[eE][+-]?\d{1,2})?')
# `1,5 minutes`: a group of thousands has three digits.
_DECIMAL_COMMA = re.compile(r'\d{1,3},\d|\d,\d{2}')
_GROUPED = re.compile(r'\d{1,3}(?:,\d{3})+(?:\.\d+)?')


# `'s` is a verb or part of a set phrase behind these.
_CONTRACTED = frozenset(
    ('it', 'let', 'that', 'there', 'here', 'what', 'he', 'she', 'who', 'bird', 'where', 'how')
)


_FULL_STOP = re.compile(r'[.!?](?=\s|$)')
# A line that goes on with a small letter or a number, behind one that has not come to its end.
_WRAPPED = re.compile(r'(?<=[^\s.:;!?])[^\S\n]*\n[^\S\n]*(?=[a-z0-9])')


# Pronouns behind which `'s` is `is`.
_SUBJECTS = frozenset(('it', 'he', 'she', 'there', 'that', 'who', 'which'))


def _number(text: str) -> Fraction | None:
    """Read `30`, `0.3`, `.5`, `1,200`, `1,5`, `1e3`; others (`1/2`, `10:30`) stay unread."""
    if len(text) > 24:
        return None
    if _PLAIN.fullmatch(text):
        return Fraction(text)
    if _DECIMAL_COMMA.fullmatch(text):
        return Fraction(text.replace(',', '.'))
    if _GROUPED.fullmatch(text):
        return Fraction(text.replace(',', ''))
    return None


def tokenize(text: str) -> tuple[Token, ...]:
    """Cut a prompt into tokens; hyphens inside compounds vanish, line breaks end a sentence.

    But for breaks inside a sentence that was wrapped.
    """
    raw: list[Token] = []
    wrapped = _wraps(text)
    last_end = -1
    for match in _TOKEN.finditer(text):
        kind = match.lastgroup
        piece = match.group()
        start, end = match.span()
        glued = start == last_end
        if kind == 'space':
            if '\n' in piece and raw and start not in wrapped:
                raw.append(Token(kind=TokenKind.MARK, norm='\n', start=start, end=end))
            continue
        last_end = end
        if kind == 'number':
            raw.append(
                Token(
                    kind=TokenKind.NUMBER,
                    norm=piece.lower(),
                    start=start,
                    end=end,
                    value=_number(piece),
                    glued=glued,
                )
            )
        elif kind == 'word':
            words = _words(piece.lower().replace('’', "'"), start, end, glued)
            if len(words[0].norm) == 1 and piece[0].isupper():  # `drone B's task`
                words[0] = replace(words[0], capital=True)
            elif piece[0].isupper():
                words[0] = replace(words[0], proper=True, upper=piece.isupper())
            raw += words
        else:
            if piece in '>→' and raw and (piece == '→' or (raw[-1].norm in '-=' and glued)):
                if piece == '>':
                    start = raw.pop().start
                piece = '→'
            mark = {'–': '-', '—': ';', '×': 'x', '−': '-', '＆': '&'}.get(piece, piece)
            token_kind = TokenKind.WORD if mark == 'x' else TokenKind.MARK
            raw.append(Token(kind=token_kind, norm=mark, start=start, end=end, glued=glued))
    return _join_signs(_drop_hyphens(_list_marks(_abbreviations(_short_forms(raw)))))


def _wraps(text: str) -> frozenset[int]:
    """Return where breaks begin that only wrap a line: in prose, in the middle of a sentence.

    Notes without a full stop have one thing in each line.
    """
    if _FULL_STOP.search(text) is None:
        return frozenset()
    return frozenset(match.start() for match in _WRAPPED.finditer(text))


def _words(norm: str, start: int, end: int, glued: bool) -> list[Token]:
    """Cut the possessive `'s` off a noun; contractions stay whole."""
    stem = norm.removesuffix("'s")
    if stem != norm and stem in _SUBJECTS:  # `once it's there`
        cut = end - 2
        return [
            Token(kind=TokenKind.WORD, norm=stem, start=start, end=cut, glued=glued),
            Token(kind=TokenKind.WORD, norm='is', start=cut, end=end, glued=True),
        ]
    if stem == norm or stem in _CONTRACTED:
        return [Token(kind=TokenKind.WORD, norm=norm, start=start, end=end, glued=glued)]
    cut = end - 2
    return [
        Token(kind=TokenKind.WORD, norm=stem, start=start, end=cut, glued=glued),
        Token(kind=TokenKind.WORD, norm="'s", start=cut, end=end, glued=True),
    ]


# Short forms with marks inside, by the word that they stand for.
_SHORT_FORMS = {
    ('w', '/', 'out'): 'without',
    ('w', '/', 'o'): 'without',
    ('i', '.', 'e', '.'): 'i.e',
    ('i', '.', 'e'): 'i.e',
    ('e', '.', 'g', '.'): 'e.g',
    ('e', '.', 'g'): 'e.g',
}


def _short_forms(tokens: list[Token]) -> list[Token]:
    """Make one word of `w/o`, `i.e.`"""
    kept: list[Token] = []
    i = 0
    while i < len(tokens):
        for form, word in _SHORT_FORMS.items() if tokens[i].norm in 'wie' else ():
            parts = tokens[i : i + len(form)]
            if tuple(t.norm for t in parts) == form and all(t.glued for t in parts[1:]):
                kept.append(replace(tokens[i], norm=word, end=parts[-1].end, capital=False))
                i += len(form)
                break
        else:
            kept.append(tokens[i])
            i += 1
    return kept


# Words that are cut short with a dot inside a sentence: `min. 10 s`, `max. distance`.
_CUT_SHORT = frozenset(
    (
        *('min', 'max', 'approx', 'ca', 'alt', 'dist', 'spd', 'dur', 'lat', 'rad', 'vel', 'avg'),
        *('alti', 'horiz', 'vert', 'incl', 'resp', 'perm', 'allow', 'acc'),
    )
)


def _abbreviations(tokens: list[Token]) -> list[Token]:
    """Drop the dot of `min. 10 s`; `for 2 min. 3 cars …` ends a sentence."""
    kept: list[Token] = []
    for i, token in enumerate(tokens):
        before = kept[-1] if kept else None
        behind = tokens[i + 1] if i + 1 < len(tokens) else None
        goes_on = behind is not None and (
            behind.kind is TokenKind.NUMBER
            or (behind.kind is TokenKind.WORD and not behind.proper and not behind.capital)
        )
        short = before is not None and before.norm in _CUT_SHORT and not before.glued
        unit = any(t.kind is TokenKind.NUMBER for t in kept[-3:-1])
        if token.norm == '.' and token.glued and goes_on and short and not unit:
            continue
        kept.append(token)
    return kept


def _list_marks(tokens: list[Token]) -> list[Token]:
    """`a) hover … b) land`, `1) …`: the mark of a step ends the sentence before it."""
    kept: list[Token] = []
    depth = 0
    i = 0
    while i < len(tokens):
        token = tokens[i]
        behind = tokens[i + 1] if i + 1 < len(tokens) else None
        depth += token.norm == '('
        closes = behind is not None and behind.norm == ')' and behind.glued
        short = len(token.norm) == 1 and token.kind in (TokenKind.WORD, TokenKind.NUMBER)
        if closes and short and not depth and not token.glued and behind is not None:
            kept.append(Token(kind=TokenKind.MARK, norm=';', start=token.start, end=behind.end))
            i += 2
            continue
        depth -= token.norm == ')' and depth > 0
        kept.append(token)
        i += 1
    return kept


def _drop_hyphens(tokens: list[Token]) -> list[Token]:
    """Drop the hyphen of `stand-off` and `35-meter`; one between two numbers is a range."""
    kept: list[Token] = []
    for i, token in enumerate(tokens):
        if token.norm == '-' and 0 < i < len(tokens) - 1:
            before, after = tokens[i - 1], tokens[i + 1]
            numbers = before.kind is TokenKind.NUMBER and after.kind is TokenKind.NUMBER
            word = TokenKind.WORD in (before.kind, after.kind)
            if token.glued and after.glued and word and not numbers:
                continue
            if not token.glued and not after.glued:  # a dash between blanks ends a clause
                kept.append(Token(kind=TokenKind.MARK, norm=';', start=token.start, end=token.end))
                continue
        kept.append(token)
    return kept


def _join_signs(tokens: list[Token]) -> tuple[Token, ...]:
    """Make one number of a minus sign and the number glued behind it."""
    joined: list[Token] = []
    i = 0
    while i < len(tokens):
        token = tokens[i]
        follows = tokens[i + 1] if i + 1 < len(tokens) else None
        if (
            token.norm in ('-', '+')
            and follows is not None
            and follows.kind is TokenKind.NUMBER
            and follows.glued
            and not token.glued
        ):
            sign = -1 if token.norm == '-' else 1
            joined.append(
                Token(
                    kind=TokenKind.NUMBER,
                    norm=token.norm + follows.norm,
                    start=token.start,
                    end=follows.end,
                    value=None if follows.value is None else sign * follows.value,
                )
            )
            i += 2
            continue
        joined.append(token)
        i += 1
    return tuple(joined)
