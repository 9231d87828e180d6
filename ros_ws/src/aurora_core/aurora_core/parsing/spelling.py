# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words as they were meant: shorthand written out, one wrong letter put right."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
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


_SHORTEST = 5
_VOWELS = 'aeiou'
_SHORT = 6  # a word cut short that is shorter has no vowel left: `hvr`, `drn`
# English words that only look like a slip (`in the form of`).
_REAL = frozenset(
    {'form', 'trial', 'angel', 'quite', 'dose', 'causal', 'martial', 'clam', 'sliver'}
)


class Speller:
    """Finds the one known word within one insertion, deletion, change or swap of letters."""

    def __init__(self, words: Iterable[str], every: Iterable[str] = ()) -> None:
        """Index the words.

        Args:
            words: Words with a meaning of their own: any slip.
            every: All words: two neighbouring letters swapped, and nothing else.
        """
        self._swapped: dict[str, set[str]] = {}
        for word in every:
            if len(word) >= _SHORTEST - 2 and word.isalpha():
                for i in range(len(word) - 1):
                    slip = word[:i] + word[i + 1] + word[i] + word[i + 2 :]
                    self._swapped.setdefault(slip, set()).add(word)
        self._by_deletion: dict[str, list[str]] = {}
        self._by_consonants: dict[str, list[str]] = {}
        for word in sorted(words):
            if len(word) >= _SHORTEST - 1 and word.isalpha():
                self._by_consonants.setdefault(_consonants(word), []).append(word)
            if len(word) >= _SHORTEST and word.isalpha():
                for key in _deletions(word):
                    self._by_deletion.setdefault(key, []).append(word)

    def correct(self, word: str) -> str | None:
        """Return the known word that was meant, None when there is none or several."""
        if len(word) < _SHORTEST - 2 or not word.isalpha():
            return None
        candidates = {
            known
            for key in _deletions(word)
            for known in self._by_deletion.get(key, ())
            if _alike(word, known) and _one_slip(word, known)
        }
        if not candidates and word not in _REAL:
            candidates = set(self._swapped.get(word, ())) or self._written_out(word)
        return candidates.pop() if len(candidates) == 1 else None

    def _written_out(self, word: str) -> set[str]:
        """`hvr`, `intersctn`: words whose consonants these are, with fewer vowels."""
        vowels = sum(c in _VOWELS for c in word)
        if len(word) < _SHORT and vowels:
            return set()
        fitting = self._by_consonants.get(_consonants(word), ())
        found = [
            k for k in fitting if k[0] == word[0] and _is_part(word, k) and len(k) > len(word)
        ]
        shortest = min((len(k) for k in found), default=0)
        return {k for k in found if len(k) == shortest}


def _consonants(word: str) -> str:
    return ''.join(c for c in word if c not in _VOWELS)


def _is_part(short: str, long: str) -> bool:
    """Return whether the letters of one word stand in the other in the same order."""
    letters = iter(long)
    return all(c in letters for c in short)


def _alike(word: str, known: str) -> bool:
    """Same first letter; another or a further last letter makes another word (`blocks`)."""
    if known[0] != word[0] or word.startswith(known):
        return False
    if len(word) < _SHORTEST:  # `hovr`, `drne`: a vowel is missing inside; `cope` is a word
        vowels = sum(c in _VOWELS for c in word)
        missing = sum(c in _VOWELS for c in known) == vowels + 1
        return len(known) > len(word) and known[-1] == word[-1] and missing and vowels < 2
    swapped = word[-2:] == known[:-3:-1] and word[:-2] == known[:-2]  # `lenght`
    return len(known) != len(word) or known[-1] == word[-1] or swapped


def _deletions(word: str) -> tuple[str, ...]:
    return (word, *(word[:i] + word[i + 1 :] for i in range(len(word))))


def _one_slip(a: str, b: str) -> bool:
    if a == b or abs(len(a) - len(b)) > 1:
        return False
    if len(a) == len(b):
        differ = [i for i in range(len(a)) if a[i] != b[i]]
        if len(differ) == 1:
            return True
        return (
            len(differ) == 2
            and differ[1] == differ[0] + 1
            and a[differ[0]] == b[differ[1]]
            and a[differ[1]] == b[differ[0]]
        )
    short, long = sorted((a, b), key=len)
    return any(long[:i] + long[i + 1 :] == short for i in range(len(long)))
