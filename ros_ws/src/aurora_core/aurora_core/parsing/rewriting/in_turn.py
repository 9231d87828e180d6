# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is listed one after the other: `first comes a bus`, `the next one is a taxi`.

Also values that are listed with their owners (`40 km/h for the ego and 30 km/h for the bus`), and
who is between two others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, by_sentence, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import LENGTH
from aurora_core.parsing.morphology import VerbForm

_GOVERNORS = (AtomKind.RELATION, AtomKind.PREPOSITION)
_COMES = ('comes', 'come', 'came', 'follows', 'follow', 'followed')
_GROUND = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def in_turn(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with a plain clause for everybody who is listed."""
    return by_sentence(atoms, lambda sentence: _comes(sentence, prompt))


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
