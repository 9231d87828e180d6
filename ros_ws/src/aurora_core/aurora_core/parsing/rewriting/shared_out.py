# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One predicate of several whose values are listed: every one gets a clause with its own.

`drones A and B hover over the school and the market respectively`, `two drones hover over the
park at 30 and 45 m`: the first of them there or so high, the second elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from aurora_core.parsing.atom_runs import by_sentence, stop_at
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.measures import COUNT, LENGTH, SPEED, TIME

_SAYS_SO = 'respectively'
_SEPARATORS = (AtomKind.COMMA, AtomKind.CONJUNCTION)
_SHARED = (LENGTH, SPEED, TIME)
_OTHER_CLAUSE = (AtomKind.SUBORDINATOR, AtomKind.RELATIVE, AtomKind.THEN)
# Written so that nothing of it can be read otherwise: `1,000` may be one or a thousand.
# One word for the unit: `1 min 30 s` has two.
_NUMBER = re.compile(r'(\d+(?:\.\d+)?(?:e[+-]?\d+)?)\s*(?![\d.,])[^\s\d]+', re.IGNORECASE)
_MOST = 6
_SHARES = ('one', 'other', 'another')


@dataclass(frozen=True, slots=True, kw_only=True)
class _List:
    """Neighbouring items of one kind with commas and `and` between them.

    Attributes:
        one_unit: `30 and 45 m`: a list for sure; `30 m and 45 m away` may be two things.
    """

    begin: int
    stop: int
    items: tuple[Atom, ...]
    one_unit: bool = False


def shared_out(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with a sentence of its own for each of several that share a predicate."""
    return by_sentence(atoms, lambda sentence: _sentence(sentence, prompt))


def shares(atoms: Sequence[Atom]) -> list[Atom]:
    """`hover over it one at 30 m the other at 50 m`: each share is a clause of its own."""
    written: list[Atom] = []
    acted = False
    for i, atom in enumerate(atoms):
        before = written[-1] if written else None
        behind = atoms[i + 1] if i + 1 < len(atoms) else None
        acts = atom.kind is AtomKind.VERB or (atom.is_actor and atom.key in _SHARES)
        acted = acts or (acted and atom.kind is not AtomKind.STOP)
        if atom.kind is AtomKind.COMMA and acted and _of_both(atoms, i + 1):
            atom = replace(atom, kind=AtomKind.STOP, key=';')
        member = atom.noun is not None and atom.noun.kind is NounKind.PRONOUN
        named = atom.key in _SHARES or atom.key.startswith('nth')
        placed = behind is not None and behind.kind in (AtomKind.PREPOSITION, AtomKind.RELATION)
        told = before is not None and (before.is_place or before.measure is not None)
        actor = before is not None and before.is_actor and atom.key == 'one'
        if (
            member
            and named
            and placed
            and before is not None
            and (told or actor)
            and before.end < atom.start
        ):
            written.append(Atom(kind=AtomKind.COMMA, key=',', start=before.end, end=atom.start))
        written.append(atom)
    return written


def _of_both(atoms: Sequence[Atom], i: int) -> bool:
    """`one over the school, one over the park, both at 45 m`: told of all of them."""
    both = i < len(atoms) and atoms[i].noun is not None and atoms[i].key == 'both'
    value = i + 1 if i + 1 < len(atoms) and atoms[i + 1].measure is not None else i + 2
    stop = atoms[i + 1 : value]
    valued = value < len(atoms) and atoms[value].measure is not None
    return both and valued and all(a.kind is AtomKind.PREPOSITION for a in stop)


def _sentence(atoms: list[Atom], prompt: str) -> list[Atom]:
    told_so = any(a.key == _SAYS_SO for a in atoms)
    verb = next((i for i, a in enumerate(atoms) if a.kind is AtomKind.VERB), None)
    if verb is None or any(a.kind in _OTHER_CLAUSE for a in atoms):
        return atoms
    if sum(a.kind is AtomKind.VERB for a in atoms) > 1:
        return atoms
    who = _sharers(atoms[:verb])
    if who is None:
        return atoms
    lists = [
        found
        for found in _lists(atoms, verb + 1, prompt)
        if len(found.items) == len(who.items) and told_so
    ]
    if not lists:
        return atoms
    return _written(atoms, who, lists)


def _sharers(atoms: Sequence[Atom]) -> _List | None:
    """Return who shares: those listed in front of the verb, or the members of a group."""
    nouns = [i for i, a in enumerate(atoms) if a.is_actor]
    if not nouns:
        return None
    listed = _list_at(atoms, nouns[0])
    if listed is not None and listed.stop == nouns[-1] + 1:
        return listed
    group = atoms[nouns[-1]].noun
    if len(nouns) > 1 or group is None or not 2 <= group.count <= _MOST:
        return None
    if group.kind is NounKind.PRONOUN:
        return None
    members = tuple(_member(atoms[nouns[0]], k + 1) for k in range(group.count))
    return _List(begin=nouns[0], stop=nouns[0] + 1, items=members)


def _member(group: Atom, number: int) -> Atom:
    """`the first`, in the place of the words that name the group."""
    noun = NounPhrase(
        kind=NounKind.PRONOUN,
        key=f'nth{number}',
        start=group.start,
        end=group.start + number,  # each mention has a span of its own
        head_text='',
        determiner=Determiner.DEFINITE,
    )
    return replace(group, key=noun.key, noun=noun)


def _lists(atoms: Sequence[Atom], begin: int, prompt: str) -> list[_List]:
    found: list[_List] = []
    i = begin
    while i < len(atoms):
        made = _list_at(atoms, i)
        if made is None:
            i += 1
            continue
        whole = _with_units(made, prompt)
        found += [whole] if whole is not None else []
        i = made.stop
    return found


def _list_at(atoms: Sequence[Atom], i: int) -> _List | None:
    kind = _kind(atoms[i])
    if kind is None:
        return None
    items = [atoms[i]]
    stop = k = i + 1
    while k < len(atoms):
        if atoms[k].kind in _SEPARATORS:
            k += 1
        elif k > stop and _kind(atoms[k]) == kind:
            items.append(atoms[k])
            stop = k = k + 1
        else:
            break
    return _List(begin=i, stop=stop, items=tuple(items)) if len(items) > 1 else None


def _kind(atom: Atom) -> str | None:
    if atom.measure is not None:
        plain = atom.measure.second is None and atom.measure.upper is None
        return 'measure' if plain else None
    if atom.noun is None or atom.noun.count > 1:
        return None
    return 'actor' if atom.is_actor else 'place' if atom.is_place else None


def _with_units(found: _List, prompt: str) -> _List | None:
    """`30, 45 and 60 ft`: the last has the unit of all of them."""
    last = found.items[-1].measure
    if last is None:
        return found
    if last.dimension not in _SHARED:
        return None
    number = _NUMBER.fullmatch(prompt[last.start : last.end])
    items = []
    alone = [a for a in found.items[:-1] if a.key == COUNT]
    for atom in found.items:
        told = atom.measure
        assert told is not None
        if told.dimension == COUNT and number is not None and float(number[1]):
            value = told.value * last.value / float(number[1])
            told = replace(told, dimension=last.dimension, value=value)
            atom = replace(atom, key=last.dimension, measure=told)
        if told.dimension != last.dimension:
            return None
        items.append(atom)
    one_unit = len(alone) == len(items) - 1
    return replace(found, items=tuple(items), one_unit=one_unit)


def _written(atoms: Sequence[Atom], who: _List, lists: Sequence[_List]) -> list[Atom]:
    written: list[Atom] = list(atoms[: who.begin])
    if who.items[0].noun is not None and who.items[0].noun.key.startswith('nth'):
        group = atoms[who.begin]
        written += [group, stop_at(group)]
    starts = {one.begin: one for one in lists}
    for number, member in enumerate(who.items):
        if number:
            written.append(stop_at(written[-1]))
        written.append(member)
        i = who.stop
        while i < len(atoms):
            if i in starts:
                written.append(starts[i].items[number])
                i = starts[i].stop
            else:
                if atoms[i].key != _SAYS_SO:
                    written.append(atoms[i])
                i += 1
    return written
