# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long somebody stands before he goes: `waits for the first 10 s and then sets off`.

Also what goes before who goes: `off it goes`, `away drives the van`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.pieces import TRANSPARENT

_STANDS = frozenset({'wait', 'park'})
_GOES = frozenset({'start', 'drive', 'walk', 'accelerate'})
_GROUNDED = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)
_JOINTS = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)
_ENDS = (AtomKind.STOP, *_JOINTS)
_AWAY = ('off', 'away')


def set_off(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with the end of a wait as the time at which somebody sets off."""
    told = _particles(list(atoms), prompt)
    written: list[Atom] = []
    i = 0
    while i < len(told):
        stop = i
        while stop < len(told) and told[stop].kind in _JOINTS:
            stop += 1
        begin = _begin(written)
        waits = stop > i and _goes_behind(told, stop) and not _caused(written[:begin])
        lasted = _lasted(written, begin, prompt) if waits else None
        if lasted is None:
            written.append(told[i])
            i += 1
            continue
        first, measure = lasted
        time = written[measure]
        at = replace(written[first], key='at')
        del written[first : measure + 1]
        joint = replace(told[i], kind=AtomKind.CONJUNCTION, key='and')
        written += [joint, at, time]
        i = stop
    return written


def _begin(written: Sequence[Atom]) -> int:
    """Return where the clause begins that ends here."""
    k = len(written)
    while k and written[k - 1].kind not in _ENDS:
        k -= 1
    return k


def _caused(before: Sequence[Atom]) -> bool:
    """`when the bus brakes, the van waits for 10 s`: these do not count from the start."""
    for atom in reversed(before):
        if atom.kind is AtomKind.STOP:
            return False
        if atom.kind in (AtomKind.SUBORDINATOR, AtomKind.THEN):
            return True
    return False


def _goes_behind(atoms: Sequence[Atom], i: int) -> bool:
    """`it sets off`, `drives on`: whoever waited, and nobody else."""
    while i < len(atoms) and atoms[i].kind in TRANSPARENT:
        i += 1
    if i < len(atoms) and atoms[i].is_actor:
        noun = atoms[i].noun
        if noun is None or noun.kind is not NounKind.PRONOUN:
            return False
        i += 1
    while i < len(atoms) and atoms[i].kind in TRANSPARENT:
        i += 1
    return i < len(atoms) and atoms[i].kind is AtomKind.VERB and atoms[i].key in _GOES


def _lasted(written: Sequence[Atom], begin: int, prompt: str) -> tuple[int, int] | None:
    """Return where `for the first 10 s` stands in a clause that says who waits."""
    clause = written[begin:]
    verbs = [a for a in clause if a.kind is AtomKind.VERB]
    actors = [a.noun for a in clause if a.noun is not None and a.is_actor]
    waits = len(verbs) == 1 and verbs[0].key in _STANDS
    if not waits or any(a.kind is AtomKind.SUBORDINATOR for a in clause):
        return None
    named = [n for n in actors if n.kind in _GROUNDED]
    if not named or any(n.kind is NounKind.UAV for n in actors):
        return None
    for k in range(begin, len(written)):
        if written[k].measure is None or written[k].key != TIME:
            continue
        first = k - 1
        if first > begin and text_of(written[first], prompt) in ('the first', 'first'):
            first -= 1
        if first >= begin and written[first].key == 'for':
            return first, k
    return None


def _particles(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`off it goes`, `away drives the van`: it sets off."""
    for i in range(len(atoms) - 2):
        opens = i == 0 or atoms[i - 1].kind in _ENDS
        if not opens or text_of(atoms[i], prompt) not in _AWAY:
            continue
        one, other = atoms[i + 1], atoms[i + 2]
        who, verb = (one, other) if one.is_actor else (other, one)
        if who.is_actor and verb.kind is AtomKind.VERB and verb.key == 'drive':
            gone = replace(verb, key='start')
            atoms[i : i + 3] = [replace(atoms[i], kind=AtomKind.FILL, noun=None), who, gone]
    return atoms
