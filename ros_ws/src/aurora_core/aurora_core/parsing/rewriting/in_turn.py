# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is listed one after the other: `first comes a bus`, `the next one is a taxi`.

Also values that are listed with their owners (`40 km/h for the ego and 30 km/h for the bus`), and
who is between two others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.adjunct_reader import fits
from aurora_core.parsing.atom_runs import HELPERS, by_sentence, runs, skip, stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import LENGTH
from aurora_core.parsing.morphology import VerbForm

_GOVERNORS = (AtomKind.RELATION, AtomKind.PREPOSITION)
_COMES = ('comes', 'come', 'came', 'follows', 'follow', 'followed')
_GROUND = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)
_NEW = (Determiner.INDEFINITE, Determiner.ONE, Determiner.ANOTHER)


def in_turn(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with a plain clause for everybody who is listed."""
    told = by_sentence(atoms, lambda sentence: _comes(sentence, prompt))
    told = by_sentence(_members(told, prompt), _in_between)
    return _owners(told)


def _comes(sentence: list[Atom], prompt: str) -> list[Atom]:
    """`last comes a van`, `12 m behind it comes a taxi`: there is one, and where it is."""
    verb = next(
        (i for i, a in enumerate(sentence) if a.kind is AtomKind.VERB and a.key in _KEYS), None
    )
    if verb is None or text_of(sentence[verb], prompt) not in _COMES:
        return sentence
    new = sentence[verb + 1].noun if verb + 1 < len(sentence) else None
    if new is None or new.kind not in _GROUND:
        return sentence
    where = [i for i in range(verb) if _places(sentence, i)]
    told = shipped_lexicon().turns['in_a_row']
    lead = next((k for k in (verb, *where) if _in_front(sentence, k, prompt) in told), None)
    lead = 0 if lead is None and 0 in where else lead
    where = [] if lead is None else [i for i in where if i >= lead]
    if lead is None or any(
        i not in where and sentence[i].kind not in (AtomKind.COMMA, *HELPERS)
        for i in range(lead, verb)
    ):
        return sentence
    if sentence[verb].key == 'follow' and where:
        return sentence  # `behind it follows a van` is read as it stands
    filled = [replace(a, kind=AtomKind.FILL, noun=None) for a in sentence[:lead]]
    there = replace(sentence[verb], key='exist', form=VerbForm.THIRD)
    return [*filled, *(sentence[i] for i in where), there, *sentence[verb + 1 :]]


def _in_front(sentence: Sequence[Atom], i: int, prompt: str) -> str:
    return prompt[sentence[0].start : sentence[i].start].lower().strip(' ,')


_KEYS = frozenset({'come', 'follow', 'approach', 'trail'})


def _places(sentence: Sequence[Atom], i: int) -> bool:
    """Return whether an atom tells where: a relation, a length, or whom one of them governs."""
    atom = sentence[i]
    if atom.kind in _GOVERNORS or atom.key == LENGTH:
        return True
    return atom.noun is not None and i > 0 and sentence[i - 1].kind in _GOVERNORS


def _members(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the second one is a taxi`, with no group named before: there is a taxi."""
    written: list[Atom] = []
    grouped = False
    for sentence, stop in runs(atoms, AtomKind.STOP):
        grouped = grouped or any(_is_group(a) for a in sentence)
        link = next((i for i, a in enumerate(sentence) if a.kind is AtomKind.VERB), 0)
        words = prompt[sentence[0].start : sentence[link].start].lower().strip() if link else ''
        new = sentence[link + 1].noun if 0 < link < len(sentence) - 1 else None
        told = words in shipped_lexicon().turns['one_of_a_row'] and sentence[link].key == 'be'
        if told and not grouped and new is not None and new.determiner in _NEW:
            filled = [replace(a, kind=AtomKind.FILL, noun=None) for a in sentence[:link]]
            sentence = [*filled, replace(sentence[link], key='exist'), *sentence[link + 1 :]]
        written += sentence
        if stop is not None:
            written.append(stop)
    return written


def _is_group(atom: Atom) -> bool:
    noun = atom.noun
    return noun is not None and noun.kind in _GROUND and (noun.count > 1 or noun.plural)


def _in_between(sentence: list[Atom]) -> list[Atom]:
    """`the ego is between a truck 15 m ahead and a bus 20 m behind`: where each of them is."""
    at = next((i for i, a in enumerate(sentence) if a.key == 'between'), None)
    who = next((a for a in sentence if a.is_actor), None)
    verbs = [a for a in sentence[:at] if a.kind is AtomKind.VERB] if at is not None else []
    if at is None or who is None or len(verbs) != 1:
        return sentence
    join = next(
        (i for i in range(at, len(sentence)) if sentence[i].kind is AtomKind.CONJUNCTION), None
    )
    if join is None or who not in sentence[:at]:
        return sentence
    sides = sentence[at + 1 : join], sentence[join + 1 :]
    if not all(_stands_there(side) for side in sides):
        return sentence
    first, second = ([*side, who] for side in sides)
    acts = [] if verbs[0].key == 'be' else [*sentence[:at], stop_at(sentence[at])]
    return [*acts, *first, stop_at(sentence[join]), *second]


def _stands_there(side: Sequence[Atom]) -> bool:
    """`a truck 15 m ahead`: an actor, a distance or none, and on which side."""
    kinds = [a.kind for a in side if a.kind not in HELPERS]
    return kinds in (
        [AtomKind.NOUN, AtomKind.RELATION],
        [AtomKind.NOUN, AtomKind.MEASURE, AtomKind.RELATION],
    )


def _owners(atoms: Sequence[Atom]) -> list[Atom]:
    """`the speed is 9 m/s for the ego and 7 m/s for the bus`: each has its own."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        name = atoms[i]
        link = skip(atoms, i + 1, HELPERS) if name.kind is AtomKind.THING else len(atoms)
        listed, stop = _listed(atoms, link + 1, name) if link < len(atoms) else ([], i)
        if len(listed) < 2 or atoms[link].key not in ('be', ':'):
            written.append(name)
            i += 1
            continue
        for k, (value, owner) in enumerate(listed):
            be = Atom(
                kind=AtomKind.VERB,
                key='be',
                start=value.start,
                end=value.end,
                form=VerbForm.THIRD,
            )
            written += [*([stop_at(owner)] if k else []), owner, name, be, value]
        i = stop
    return written


def _listed(atoms: Sequence[Atom], i: int, name: Atom) -> tuple[list[tuple[Atom, Atom]], int]:
    """Return the values with their owners from here on, and where the list ends."""
    found: list[tuple[Atom, Atom]] = []
    stop = i
    while True:
        i = skip(atoms, i, (AtomKind.COMMA, AtomKind.CONJUNCTION, *HELPERS))
        if i + 2 >= len(atoms):
            return found, stop
        value, word, owner = atoms[i : i + 3]
        valued = value.measure is not None and fits(name.key, value.measure)
        if not valued or word.key != 'for' or not owner.is_actor:
            return found, stop
        found.append((value, owner))
        i = stop = i + 3
