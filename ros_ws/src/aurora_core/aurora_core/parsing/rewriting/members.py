# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is named together with others or before what is said of him.

`one of our three drones`, `of the two, one …`, `the van has a drone above it`, `the second drone:
it hovers`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import LOOSE, runs, skip, stop_at
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.measures import COUNT
from aurora_core.parsing.morphology import VerbForm

_GROUPS = (NounKind.UAV, NounKind.AGENT, NounKind.VEHICLE)


def members(atoms: Sequence[Atom]) -> list[Atom]:
    """Return the atoms with every group named before its members, which are one each."""
    return _named_first(_one_of(_listed(list(atoms))))


def _listed(atoms: list[Atom]) -> list[Atom]:
    """`two drones: a) orbit the park b) track a bus`: an item for each of them."""
    told = runs(atoms, AtomKind.STOP)
    items = [(run, stop) for run, stop in told if run or stop is not None]
    written: list[Atom] = []
    waiting: list[Atom] = []  # members that no item has yet
    for k, (run, stop) in enumerate(items):
        group = _alone(run)
        before = items[k - 1][1] if k else None
        if waiting and before is not None and _is_item(run):
            written.append(_first_of(waiting, before))
        written += run
        if stop is not None:
            written.append(stop)
        if group is not None and group.noun is not None:
            behind = [r for r, _ in items[k + 1 :] if r][: group.noun.count]
            marked = [s for _, s in items[k:] if s is not None and s.end - s.start > 1]
            each = len(behind) == group.noun.count <= len(marked)
            waiting = [group] * group.noun.count if each and all(map(_is_item, behind)) else []
    return written


def _alone(run: Sequence[Atom]) -> Atom | None:
    """Return the group of UAVs that is all that a sentence names."""
    flying = [a for a in run if a.noun is not None and a.noun.kind is NounKind.UAV]
    last = next((a for a in reversed(run) if a.kind not in LOOSE), None)
    noun = flying[0].noun if len(flying) == 1 and flying[0] is last else None
    acts = any(a.kind is AtomKind.VERB and a.key not in ('exist', 'contain') for a in run)
    return flying[0] if noun is not None and noun.count > 1 and not acts else None


def _is_item(run: Sequence[Atom]) -> bool:
    """A command, or a flight told with a noun: nobody is named in front of it."""
    first = next((a for a in run if a.kind not in LOOSE), None)
    if first is None:
        return False
    command = first.kind is AtomKind.VERB and first.form is VerbForm.BASE
    return command or first.kind in (AtomKind.PATTERN, AtomKind.ROUTE)


def _first_of(waiting: list[Atom], at: Atom) -> Atom:
    group = waiting.pop()
    assert group.noun is not None
    key = f'nth{group.noun.count - len(waiting)}'
    noun = NounPhrase(
        kind=NounKind.PRONOUN,
        key=key,
        start=at.start,
        end=at.end,
        head_text='',
        determiner=Determiner.DEFINITE,
    )
    return Atom(kind=AtomKind.NOUN, key=key, start=at.start, end=at.end, noun=noun)


def _one_of(atoms: list[Atom]) -> list[Atom]:
    """`one of our three drones tracks it`: there are three drones; one of them tracks it."""
    written: list[Atom] = []
    opened = 0  # where the sentence begins
    i = 0
    while i < len(atoms):
        group = _group(atoms, skip(atoms, i + 2)) if _is_one(atoms, i) else None
        if group is None:
            written.append(atoms[i])
            opened = len(written) if atoms[i].kind is AtomKind.STOP else opened
            i += 1
            continue
        noun = group.noun
        assert noun is not None
        if noun.count > 1:
            whole = replace(group, noun=replace(noun, determiner=Determiner.BARE))
            written[opened:opened] = [whole, stop_at(group)]
        one = replace(noun, start=atoms[i].start, determiner=Determiner.ONE, plural=False, count=1)
        written.append(replace(group, start=atoms[i].start, noun=one))
        i = atoms.index(group, i) + 1
    return written


def _is_one(atoms: Sequence[Atom], i: int) -> bool:
    measure = atoms[i].measure
    one = measure is not None and measure.dimension == COUNT and measure.value == 1
    of = atoms[i + 1] if i + 1 < len(atoms) else None
    return one and of is not None and of.kind is AtomKind.PREPOSITION and of.key == 'of'


def _group(atoms: Sequence[Atom], i: int) -> Atom | None:
    noun = atoms[i].noun if i < len(atoms) else None
    return atoms[i] if noun is not None and noun.kind in _GROUPS and noun.plural else None


def _named_first(atoms: list[Atom]) -> list[Atom]:
    """`the second drone: it hovers`, `what is left is the third, and it hovers`: one actor."""
    written: list[Atom] = []
    alone: Atom | None = None  # the only thing that the sentence has told yet
    told = 0  # how many atoms there are up to it
    for i, atom in enumerate(atoms):
        written.append(atom)
        behind = skip(atoms, i + 1)
        acts = behind < len(atoms) and atoms[behind].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
        if alone is not None and atom.key in ('it', 'they') and atom.is_actor and acts:
            del written[told:]
        if atom.kind is AtomKind.STOP and atom.key != ':':
            alone = None
        elif atom.is_actor and not any(a.kind is not AtomKind.FRAME for a in _sentence(written)):
            alone, told = atom, len(written)
        elif atom.kind not in _JOINS and atom is not alone:
            alone = None
    return written


_JOINS = (*LOOSE, AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION)


def _sentence(atoms: Sequence[Atom]) -> list[Atom]:
    """Return what the last sentence tells in front of its last atom."""
    begin = len(atoms) - 1
    while begin and atoms[begin - 1].kind is not AtomKind.STOP:
        begin -= 1
    return [a for a in atoms[begin:-1] if a.kind is not AtomKind.FILL]
