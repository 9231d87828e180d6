# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When things happen, told beside the clause that says what happens.

`25 s in, the van brakes`, `20 s: the van brakes`, `drives on until 40 s, and then brakes`,
`the van brakes, which happens at 20 s`, `it is at 20 s that the van brakes`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.earlier_phases import before_that
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import TIME

_PAUSES = (AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)
_SMALL = (AtomKind.FILL, AtomKind.FRAME, AtomKind.AUXILIARY)
_HAPPENS = frozenset({'happen', 'be', 'do so'})


def dated(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with every time in the clause of what happens then."""
    told = _leaving(before_that(_exact(atoms, prompt)))
    told = _in_that_case(_that_happens(told, prompt), prompt)
    return _into_it(_later(told))


def _exact(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """`for a minute and no longer`: for a minute."""
    kept: list[Atom] = []
    said = 0  # up to where a time has told it all
    for i, atom in enumerate(atoms):
        if atom.start < said:
            continue
        kept.append(atom)
        found = _no_longer().match(prompt.lower(), atom.end) if _is_time(atoms, i) else None
        said = found.end() if found is not None else said
    return kept


@lru_cache(maxsize=1)
def _no_longer() -> re.Pattern[str]:
    words = '|'.join(sorted(shipped_lexicon().turns['no_longer'], key=len, reverse=True))
    ends = r'(?=\s*(?:[,.;:!?]|and\b|but\b|then\b|$))'
    return re.compile(rf'[,\s]*(?:(?:and|but)\s+)?(?:{words})\b{ends}')


def _is_time(atoms: Sequence[Atom], i: int) -> bool:
    return 0 <= i < len(atoms) and atoms[i].measure is not None and atoms[i].key == TIME


def _is_pronoun(atom: Atom) -> bool:
    return atom.noun is not None and atom.noun.kind is NounKind.PRONOUN


def _at(atom: Atom) -> Atom:
    return Atom(kind=AtomKind.PREPOSITION, key='at', start=atom.start, end=atom.end)


def _ends(atoms: Sequence[Atom], i: int) -> bool:
    return i >= len(atoms) or atoms[i].kind in _PAUSES


def _into_it(atoms: list[Atom]) -> list[Atom]:
    """`25 seconds in, …`: from the start."""
    changed = list(atoms)
    for i in range(1, len(changed)):
        inside = changed[i].kind is AtomKind.PREPOSITION and changed[i].key == 'in'
        acts = i + 2 < len(changed) and changed[i + 1].is_actor
        acts = acts and changed[i + 2].kind is AtomKind.VERB  # `8 s in it stops`
        if inside and _is_time(changed, i - 1) and (acts or _ends(changed, i + 1)):
            changed[i] = replace(changed[i], kind=AtomKind.FROM_START)
    return changed


def _leaving(atoms: list[Atom]) -> list[Atom]:
    """`leaves the station`, `sets off from the park`: it starts at that place."""
    written: list[Atom] = []
    for i, atom in enumerate(atoms):
        before = written[-1] if written else None
        starts = before is not None and before.kind is AtomKind.VERB and before.key == 'start'
        if atom.is_place and starts:
            written.append(_at(atom))
        behind = atoms[i + 1] if i + 1 < len(atoms) else None
        away = atom.kind is AtomKind.PREPOSITION and atom.key in ('from', 'of')
        if away and starts and behind is not None and behind.is_place:
            atom = _at(atom)
        written.append(atom)
    return written


def _later(atoms: list[Atom]) -> list[Atom]:
    """`5 s later`: a time, and no word of sequence."""
    changed = list(atoms)
    for i in range(1, len(changed)):
        then = (
            changed[i].kind is AtomKind.THEN
            and changed[i].key in shipped_lexicon().turns['behind_a_time']
        )
        if then and _is_time(changed, i - 1):
            changed[i] = replace(changed[i], kind=AtomKind.FILL)
    return changed


def _that_happens(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`…, which happens at 20 s`, `…. That will be 5 s later`: of the clause in front."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        stop = _dating(atoms, i, prompt) if atoms[i].kind in _PAUSES else None
        if stop is None or not written:
            written.append(atoms[i])
            i += 1
        else:
            i = stop
    return written


def _in_that_case(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`It may lose the van. When that happens, …`: then."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        stop = _that_case(atoms, i, prompt)
        if stop is None or not written:
            written.append(atoms[i])
            i += 1
            continue
        then = replace(atoms[i], kind=AtomKind.THEN, key='then', end=atoms[stop - 1].end)
        while stop < len(atoms) and atoms[stop].kind is AtomKind.COMMA:
            stop += 1
        if written[-1].kind in _PAUSES:
            if written[-1].kind is AtomKind.STOP:
                written[-1] = replace(written[-1], kind=AtomKind.COMMA, key=',')
            written.append(then)
        else:
            begin = len(written)
            while begin and written[begin - 1].kind not in (AtomKind.STOP, AtomKind.COMMA):
                begin -= 1
            if begin and written[begin - 1].kind is AtomKind.STOP:
                written[begin - 1] = replace(written[begin - 1], kind=AtomKind.COMMA, key=',')
            written.insert(begin, then)
        i = stop
    return written


def _that_case(atoms: Sequence[Atom], i: int, prompt: str) -> int | None:
    """Return where `when that happens` ends that begins at i."""
    if atoms[i].kind is not AtomKind.SUBORDINATOR or atoms[i].key not in ('when', 'after'):
        return None
    k = i + 1
    referred = text_of(atoms[i], prompt).endswith(' that')  # `the moment that happens`
    while k < len(atoms) and (
        atoms[k].kind in (*_SMALL, AtomKind.RELATIVE) or _is_pronoun(atoms[k])
    ):
        words = text_of(atoms[k], prompt)
        referred = referred or words in ('that', 'this', 'it', 'so', 'which')
        k += 1
    happens = k < len(atoms) and atoms[k].kind is AtomKind.VERB and atoms[k].key == 'happen'
    end = k + 1 if happens else k
    so = text_of(atoms[k - 1], prompt) == 'so'
    acts = happens and end < len(atoms) and atoms[end].is_actor  # `once that happens it lands`
    return end if referred and (happens or so) and (acts or _ends(atoms, end)) else None


def _dating(atoms: Sequence[Atom], i: int, prompt: str) -> int | None:
    """Return where the time begins of a clause that says nothing but when."""
    while i < len(atoms) and (atoms[i].kind in _PAUSES or text_of(atoms[i], prompt) == 'and'):
        i += 1
    referred = False
    while i < len(atoms) and (
        atoms[i].kind in (*_SMALL, AtomKind.RELATIVE) or _is_pronoun(atoms[i])
    ):
        words = text_of(atoms[i], prompt)
        referred = referred or words in shipped_lexicon().turns['referring']
        i += 1
    if not referred or i >= len(atoms) or atoms[i].kind is not AtomKind.VERB:
        return None
    does = text_of(atoms[i], prompt) in (
        'does',
        'do',
        'does so',
        'do so',
        'does this',
        'does that',
    )
    if atoms[i].key not in _HAPPENS and not does:
        return None
    begin = i + 1
    while begin < len(atoms) and atoms[begin].kind is AtomKind.FILL:
        begin += 1
    timed = begin < len(atoms) and (
        _is_time(atoms, begin)
        or (
            atoms[begin].kind is AtomKind.PREPOSITION
            and atoms[begin].key in ('at', 'after')
            and _is_time(atoms, begin + 1)
        )
    )
    k = begin + 1 if _is_time(atoms, begin) else begin + 2
    while k < len(atoms) and atoms[k].kind in (AtomKind.FROM_START, AtomKind.FILL, AtomKind.THEN):
        k += 1
    return begin if timed and _ends(atoms, k) else None
