# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flights told with nouns: `the patrol is over`, `it gives up the pursuit and tracks the bus`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, LOOSE, runs, skip
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.rewriting.nominal import act_nouns
from aurora_core.parsing.told_pieces import FLOWN, PHASES

_FLIGHTS = PHASES | {'navigate', 'orbit'}
_NEXT = _FLIGHTS | {'land', 'ascend', 'descend'}
_PAUSES = (AtomKind.COMMA, AtomKind.CONJUNCTION)
_ENDED = ('finish', 'trace')
_BREAKS_OFF = frozenset({'break_off', 'stop', 'finish', 'keep'})


def flights(atoms: Sequence[Atom]) -> list[Atom]:
    """Return the atoms with flights as such, and without the end that the next one implies."""
    ordered = [a for told, stop in runs(atoms, AtomKind.STOP) for a in _ordered(told, stop)]
    named = _centred(_owned(_on_the_way(ordered)))
    return _broken_off(_after_that(named))


def _ordered(atoms: list[Atom], stop: Atom | None) -> list[Atom]:
    """`before tracking the van, the drone hovers`: it hovers, then it tracks the van."""
    end = [stop] if stop is not None else []
    first = skip(atoms, 0)
    verb = skip(atoms, first + 1)
    opens = first < len(atoms) and atoms[first].words == 'before' and verb < len(atoms)
    if not opens or atoms[verb].form is not VerbForm.ING or atoms[verb].key not in _NEXT:
        return [*atoms, *end]
    pause = next((i for i, a in enumerate(atoms) if a.kind is AtomKind.COMMA), None)
    named = skip(atoms, pause + 1) if pause is not None else len(atoms)
    noun = atoms[named].noun if named < len(atoms) else None
    if pause is None or noun is None or noun.kind not in (NounKind.UAV, NounKind.PRONOUN):
        return [*atoms, *end]
    then = replace(atoms[first], kind=AtomKind.THEN, key='then')
    later = [replace(atoms[verb], form=VerbForm.THIRD), *atoms[verb + 1 : pause]]
    return [*atoms[:first], *atoms[pause + 1 :], atoms[pause], then, *later, *end]


def _on_the_way(atoms: list[Atom]) -> list[Atom]:
    """`goes over to the park and hovers there`: it flies there."""
    for i, atom in enumerate(atoms):
        to = skip(atoms, i + 1)
        place = skip(atoms, to + 1)
        if place >= len(atoms) or atoms[to].key != 'to' or not atoms[place].is_place:
            continue
        over = atom.kind is AtomKind.VERB and atom.words.endswith(' over')
        if over:  # elsewhere `goes over` is a limit, `moves over` a change of lanes
            atoms[i] = atom = replace(atom, key='drive')
        if atom.kind is not AtomKind.VERB or atom.key != 'drive' or _on_wheels(atoms, i):
            continue
        behind = place + 1
        while behind < len(atoms) and (
            atoms[behind].kind in _BETWEEN or atoms[behind].words == 'it'
        ):
            behind += 1
        if behind < len(atoms) and atoms[behind].key in _STAYS:
            atoms[i] = replace(atom, key='fly')
    return atoms


_BETWEEN = (*HELPERS, AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN, AtomKind.RELATIVE)
_STAYS = ('hover', 'orbit', 'navigate', 'fly')


def _on_wheels(atoms: Sequence[Atom], i: int) -> bool:
    before = next((a for a in reversed(atoms[:i]) if a.kind not in HELPERS), None)
    noun = before.noun if before is not None else None
    return noun is not None and noun.kind not in (NounKind.UAV, NounKind.PRONOUN)


def _owned(atoms: list[Atom]) -> list[Atom]:
    """`through with its scan`, `completing the scan`: no predicate stands there."""
    for i in range(1, len(atoms)):
        flown = atoms[i].kind is AtomKind.VERB and atoms[i].key in _FLIGHTS
        ended = i > 1 and atoms[i - 1].kind is AtomKind.FILL and atoms[i - 2].key in _ENDED
        owned = atoms[i - 1].words in ('its', 'their') or ended
        if flown and atoms[i].form is VerbForm.BASE and owned:
            atoms[i] = replace(atoms[i], kind=AtomKind.ROUTE)
    return atoms


def _centred(atoms: list[Atom]) -> list[Atom]:
    """`a rectangle which is centred on the junction`, `it is centred on …`: flown around it."""
    kept: list[Atom] = []
    for atom in atoms:
        if atom.kind is AtomKind.PREPOSITION and atom.words.startswith(('centre', 'center')):
            told = len(kept)
            while told and (kept[told - 1].kind in HELPERS or kept[told - 1].key == 'be'):
                told -= 1
            about = kept[told - 1] if told else None
            if about is not None and about.kind is AtomKind.RELATIVE:
                del kept[told - 1 :]
            elif about is not None and (about.words == 'it' or about.kind in _SHAPES):
                told = _stop_before(kept, told - 1)
                told = told if any(a.kind in _SHAPES for a in kept[:told]) else len(kept)
                del kept[told:]
        kept.append(atom)
    return kept


_SHAPES = (AtomKind.PATTERN, AtomKind.ROUTE)


def _stop_before(atoms: Sequence[Atom], i: int) -> int:
    """Return where the pause stands in front of which only small words are, else the end."""
    while i and atoms[i - 1].kind in HELPERS:
        i -= 1
    paused = i and atoms[i - 1].kind in (AtomKind.STOP, *_PAUSES)
    return i - 1 if paused else len(atoms)


def _after_that(atoms: list[Atom]) -> list[Atom]:
    """`after that patrol, …`: when the patrol is over."""
    for i, atom in enumerate(atoms):
        if atom.kind is not AtomKind.THEN or atom.words not in ('after that', 'after this'):
            continue
        stop = flight_end(atoms, i + 1)
        ends = stop is not None and stop < len(atoms)
        if stop is not None and ends and (atoms[stop].is_actor or atoms[stop].kind in _PAUSES):
            that = replace(atom, kind=AtomKind.FILL, words='that', start=atom.end - len('that'))
            atoms[i] = replace(atom, kind=AtomKind.SUBORDINATOR, key='after')
            atoms.insert(i + 1, that)
    return atoms


def _broken_off(atoms: list[Atom]) -> list[Atom]:
    """`gives up the patrol and tracks it`, `the patrol is aborted and …`: the change says it."""
    i = 0
    while i < len(atoms):
        stop = _given_up(atoms, i)
        if stop is not None:
            said = replace(atoms[i], kind=AtomKind.FILL, end=atoms[stop - 1].end, noun=None)
            atoms[i:stop] = [said]
        i += 1
    return atoms


def _given_up(atoms: Sequence[Atom], i: int) -> int | None:
    """Return where the next act begins behind `gives up the patrol and`."""
    if atoms[i].kind is AtomKind.NEGATION:
        return None
    leaves = atoms[i].key == 'start' and atoms[i].words.startswith(('leav', 'left'))
    if atoms[i].kind is not AtomKind.VERB or not (atoms[i].key in _BREAKS_OFF or leaves):
        return None
    given_up = atoms[i].key == 'break_off'
    stop = flight_end(atoms, i + 1, named=given_up or leaves) or (i + 1 if given_up else None)
    return _next_act(atoms, stop) if stop is not None else None


def _next_act(atoms: Sequence[Atom], stop: int) -> int | None:
    """Return where the predicate of the same UAV begins behind a pause."""
    if stop >= len(atoms) or not (atoms[stop].kind in _PAUSES or atoms[stop].key == ':'):
        return None
    behind = skip(atoms, stop + 1, (*LOOSE, AtomKind.CONJUNCTION, AtomKind.THEN))
    if behind < len(atoms) and atoms[behind].words == 'it':
        behind = skip(atoms, behind + 1)
    acts = behind < len(atoms) and atoms[behind].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
    return behind if acts else None


def flight_end(atoms: Sequence[Atom], i: int, *, named: bool = False) -> int | None:
    """Return where the words of a flight end that begin at i: `its tracking of the bus`.

    Args:
        atoms: The prompt.
        i: Where a flight may begin.
        named: Whether whom or what a patrol is about belongs to it.
    """
    first = i
    before = atoms[i - 1] if i else None
    noun = before is not None and (before.key in _BREAKS_OFF or before.kind is AtomKind.THEN)
    i = skip(atoms, i)
    if i < len(atoms) and atoms[i].words in ('its', 'their'):
        i = skip(atoms, i + 1)
    nouns = i
    while i < len(atoms) and _is_flight(atoms[i], article=i > first or noun):
        i += 1
    if i == nouns:
        return None
    of = i < len(atoms) and atoms[i].key in ('of', 'over', 'around', 'along')
    k = i + 1 if of else i
    about = k < len(atoms) and (atoms[k].is_actor or atoms[k].is_place)
    gerund = atoms[i - 1].form is VerbForm.ING and atoms[i - 1].kind is AtomKind.VERB
    return k + 1 if about and (gerund or (of and named)) else i


def _is_flight(atom: Atom, *, article: bool) -> bool:
    if atom.kind in (AtomKind.ROUTE, AtomKind.PATTERN) or act_nouns().get(atom.words) in FLOWN:
        return True
    flown = atom.kind is AtomKind.VERB and atom.key in _FLIGHTS
    return flown and (atom.form is VerbForm.ING or (article and atom.form is VerbForm.BASE))
