# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Regular English word forms, so that the lexicon lists each word once."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum

_VOWELS = 'aeiou'


class VerbForm(StrEnum):
    BASE = 'base'
    THIRD = 'third'
    ING = 'ing'
    PAST = 'past'


def plural(noun: str) -> str:
    """Return the regular plural of the last word of a phrase."""
    if noun.endswith(('s', 'x', 'z', 'ch', 'sh')):
        return noun + 'es'
    if noun.endswith('y') and len(noun) > 1 and noun[-2] not in _VOWELS:
        return noun[:-1] + 'ies'
    return noun + 's'


def _doubles(verb: str) -> bool:
    return (
        len(verb) >= 3
        and verb[-1] not in _VOWELS + 'wxy'
        and verb[-2] in _VOWELS
        and verb[-3] not in _VOWELS
    )


def verb_forms(verb: str, irregular: Mapping[str, list[str]]) -> tuple[tuple[str, VerbForm], ...]:
    """Return every form of a verb or of the first word of a verb phrase."""
    head, _, rest = verb.partition(' ')
    tail = f' {rest}' if rest else ''
    forms: list[tuple[str, VerbForm]] = [(head, VerbForm.BASE)]
    if head in irregular:
        for form in irregular[head]:
            if form.endswith('ing'):
                forms.append((form, VerbForm.ING))
            elif form.endswith('s') or form in ('is', 'are', 'am'):
                forms.append((form, VerbForm.THIRD))
            else:
                forms.append((form, VerbForm.PAST))
        known = {kind for _, kind in forms}
        if VerbForm.PAST not in known:
            forms.append((head, VerbForm.PAST))
    else:
        stem = head[:-1] if head.endswith('e') else head
        third = plural(head)
        past = head[:-1] + 'ied' if third.endswith('ies') else stem + 'ed'
        forms += [(third, VerbForm.THIRD), (past, VerbForm.PAST), (stem + 'ing', VerbForm.ING)]
        if _doubles(head):
            forms += [
                (head + head[-1] + 'ed', VerbForm.PAST),
                (head + head[-1] + 'ing', VerbForm.ING),
            ]
    return tuple((form + tail, kind) for form, kind in forms)
