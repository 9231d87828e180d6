# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What may not begin before something else: `must not land until the bus has stopped`.

The same as `lands when the bus has stopped`, in front of its cause or behind it, and with the
words of `not before the bus has stopped may the drone land` in plain order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import LOOSE, by_sentence, runs, skip
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.pieces import has_verb
from aurora_core.parsing.reactions import REACTIONS
from aurora_core.parsing.told_pieces import FLOWN

_WAITS = ('before', 'until', 'unless')
_CAUSES = ('when', 'after')
_BEGINS = frozenset(
    {*REACTIONS, *FLOWN, 'drive', 'walk', 'land', 'ascend', 'send', 'alert', 'report'}
)
_PAUSES = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.RELATIVE)


def not_before(atoms: Sequence[Atom]) -> list[Atom]:
    """Return the atoms with every denied beginning as one that waits for its cause."""
    return by_sentence(atoms, lambda told: _behind(_in_front(told)))


def _behind(atoms: list[Atom]) -> list[Atom]:
    """`it must not land before the bus stops`: the denied beginning comes first."""
    for at, atom in enumerate(atoms):
        if not _waits(atom) or not _tells(atoms, at + 1):
            continue
        begin = at
        while begin and atoms[begin - 1].kind not in _PAUSES:
            begin -= 1
        told = any(a.is_actor for a in atoms[:begin])  # `the bus, parked there, must not start …`
        no = _denied(atoms[begin:at], named=told)
        if no is not None:
            when = replace(atom, kind=AtomKind.SUBORDINATOR, key='when')
            rest = [*atoms[begin : begin + no], *atoms[begin + no + 1 : at]]
            return [*atoms[:begin], *rest, when, *_behind(atoms[at + 1 :])]
    return atoms


def _in_front(atoms: list[Atom]) -> list[Atom]:
    """`not before the bus stops may it land`, `until the bus stops, it must not land`."""
    first = skip(atoms, 0)
    no = first < len(atoms) and atoms[first].kind is AtomKind.NEGATION
    at = skip(atoms, first + 1) if no else first
    if at >= len(atoms) or atoms[at].kind is not AtomKind.SUBORDINATOR:
        return atoms
    when = replace(atoms[at], key='when')
    turned = _turned(atoms, at + 1)
    if atoms[at].key in _CAUSES and not no:
        if turned is None:
            return atoms
        return [*atoms[:turned], _comma(atoms[turned]), *atoms[turned + 1 :]]
    if not _waits(atoms[at]) or not _tells(atoms, at + 1):
        return atoms
    if no and turned is not None:
        return [when, *atoms[at + 1 : turned], _comma(atoms[turned]), *atoms[turned + 1 :]]
    comma = next((i for i in range(at, len(atoms)) if atoms[i].kind is AtomKind.COMMA), None)
    denied = _denied(atoms[comma:]) if comma is not None and not no else None
    if comma is None or denied is None:
        return atoms
    rest = [*atoms[comma : comma + denied], *atoms[comma + denied + 1 :]]
    return [*atoms[:at], when, *atoms[at + 1 : comma], *rest]


def _waits(atom: Atom) -> bool:
    joins = atom.kind in (AtomKind.SUBORDINATOR, AtomKind.PREPOSITION)
    return joins and atom.key in _WAITS


def _tells(atoms: Sequence[Atom], i: int) -> bool:
    """Return whether a clause follows, and no time."""
    ahead = next(runs(atoms[i:], AtomKind.COMMA))[0]
    first = skip(ahead, 0)
    timed = first < len(ahead) and ahead[first].key == TIME
    return has_verb(ahead) and not timed


def _denied(atoms: Sequence[Atom], *, named: bool = False) -> int | None:
    """Return where the negation stands of a clause that denies a beginning."""
    no = next((i for i, a in enumerate(atoms) if a.kind is AtomKind.NEGATION), None)
    if no is None:
        return None
    verbs = [a for a in atoms[no:] if a.kind is AtomKind.VERB]
    named = named or any(a.is_actor for a in atoms)
    measured = any(a.measure is not None for a in atoms)
    begins = bool(verbs) and verbs[-1].key in _BEGINS and not measured
    return no if begins and named else None


def _turned(atoms: Sequence[Atom], i: int) -> int | None:
    """Return where `may the drone land` begins behind the verb of the cause."""
    told = False
    for at in range(i, len(atoms) - 1):
        if atoms[at].kind in (AtomKind.COMMA, AtomKind.SUBORDINATOR):
            return None
        helps = atoms[at].kind is AtomKind.AUXILIARY or atoms[at].key == 'be'
        behind = skip(atoms, at + 1, LOOSE)
        acts = behind < len(atoms) and atoms[behind].is_actor and has_verb(atoms[behind:])
        if told and helps and acts:
            return at
        told = told or atoms[at].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
    return None


def _comma(at: Atom) -> Atom:
    return Atom(kind=AtomKind.COMMA, key=',', start=at.start, end=at.end)
