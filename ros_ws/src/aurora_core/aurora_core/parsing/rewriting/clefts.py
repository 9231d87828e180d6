# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sentences turned round so that something stands out, put back into plain order.

`it is the park that the drone hovers over`, `the park is what it hovers over`, `parked at the
kerb is a van`, `a bus, which a police car is following, …`, `the bus has two cars following it`,
`its tracker is a drone`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import HELPERS, by_sentence, skip, stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.morphology import VerbForm

_JOINING = (AtomKind.SUBORDINATOR, AtomKind.RELATIVE, AtomKind.THEN)
# Participles that `reader.py` ties to what follows.
_KEPT_FRONTED = frozenset({'approach', 'receive', 'start', 'see', 'reach'})
_WHICH = ('which', 'who', 'whom', 'that')
_GOVERNING = (AtomKind.PREPOSITION, AtomKind.RELATION)


def plain_order(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with every sentence in the order subject, predicate, rest."""
    return by_sentence(atoms, lambda sentence: _sentence(tuple(sentence), prompt))


# A second look reads the other sentences of a prompt again and again.
@lru_cache(maxsize=64)
def _sentence(atoms: tuple[Atom, ...], prompt: str) -> tuple[Atom, ...]:
    sentence = list(atoms)
    for turn in _TURNS:
        sentence = turn(sentence, prompt)
    return tuple(sentence)


def _is_be(atoms: Sequence[Atom], i: int) -> bool:
    here = i < len(atoms) and atoms[i].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
    return here and atoms[i].key == 'be'


def _named(atoms: Sequence[Atom], i: int) -> bool:
    return i < len(atoms) and (atoms[i].is_actor or atoms[i].is_place)


def _behind_verb(rest: list[Atom], focus: list[Atom]) -> list[Atom]:
    """`the drone hovers over … for 20 s`: what stood in front goes where it belongs."""
    verb = next((i for i, a in enumerate(rest) if a.kind is AtomKind.VERB), None)
    if verb is None:
        return rest + focus
    at = verb + 1
    while at < len(rest) and rest[at].kind is AtomKind.FILL:
        at += 1
    governed = at < len(rest) and rest[at].kind in _GOVERNING
    if governed and focus[0].noun is not None:
        return rest[: at + 1] + focus + rest[at + 1 :]
    for i in range(at, len(rest)):
        if rest[i].kind in _GOVERNING and focus[0].noun is not None:
            return rest[: i + 1] + focus + rest[i + 1 :]
    return rest[: verb + 1] + focus + rest[verb + 1 :]


def _turned(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`parked 30 m before the junction is a truck`, `visible to it must be the van`."""
    first = skip(atoms, 0)
    if first >= len(atoms):
        return atoms
    lead = atoms[first]
    participle = lead.kind is AtomKind.VERB and lead.form in (VerbForm.ING, VerbForm.PAST)
    if not participle and lead.kind not in (AtomKind.STATE, AtomKind.IN_VIEW):
        return atoms
    for k in range(first + 1, len(atoms)):
        phase = k + 1 < len(atoms) and atoms[k + 1].kind in (AtomKind.ROUTE, AtomKind.THING)
        if atoms[k].kind is AtomKind.VERB and not _is_be(atoms, k) and not phase:
            return atoms
        if atoms[k].kind in (AtomKind.SUBORDINATOR, AtomKind.RELATIVE):
            return atoms
        helper = atoms[k].kind is AtomKind.AUXILIARY or _is_be(atoms, k)
        finite = helper or text_of(atoms[k], prompt) in ('is', 'are', 'was', 'were')
        if not finite:
            continue
        who = skip(atoms, k + 1, (*HELPERS, AtomKind.VERB))
        if who >= len(atoms) or not atoms[who].is_actor or not _are_helpers(atoms[k:who]):
            return atoms
        subject = [atoms[who]]
        end = who + 1
        while end + 1 < len(atoms) and atoms[end].kind is AtomKind.CONJUNCTION:
            if not atoms[end + 1].is_actor:
                break
            subject += atoms[end : end + 2]
            end += 2
        be = replace(atoms[k], kind=AtomKind.AUXILIARY, key='be')
        if lead.kind is AtomKind.IN_VIEW:
            be = replace(be, kind=AtomKind.VERB, form=VerbForm.THIRD)
        return [*atoms[:first], *subject, be, *atoms[first:k]]
    return atoms


def _are_helpers(atoms: Sequence[Atom]) -> bool:
    return all(a.kind in HELPERS or a.key == 'be' for a in atoms)


def _participle(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`driving at 8 m/s, a car approaches`: `a car is driving at 8 m/s; it approaches`."""
    first = skip(atoms, 0)
    if first >= len(atoms) or atoms[first].kind is not AtomKind.VERB:
        return atoms
    lead = atoms[first]
    if lead.form not in (VerbForm.ING, VerbForm.PAST) or lead.key in _KEPT_FRONTED:
        return atoms
    for k in range(first + 1, len(atoms) - 2):
        if atoms[k].kind in (AtomKind.VERB, *_JOINING):
            return atoms
        if atoms[k].kind is not AtomKind.COMMA:
            continue
        who = skip(atoms, k + 1)
        if who >= len(atoms) or not atoms[who].is_actor:
            return atoms
        subject, noun = atoms[who], atoms[who].noun
        assert noun is not None
        verb = skip(atoms, who + 1, (*HELPERS, AtomKind.NEGATION))
        finite = verb < len(atoms) and atoms[verb].kind is AtomKind.VERB
        if not finite or noun.kind is NounKind.UAV or noun.kind is NounKind.PRONOUN:
            return atoms
        be = Atom(kind=AtomKind.AUXILIARY, key='be', start=lead.start, end=lead.end)
        return [*atoms[:first], subject, be, *atoms[first:k], stop_at(atoms[k]), *atoms[k + 1 :]]
    return atoms


def _sent(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`park a drone above the square`, `send a UAV down the main road`: it hovers, it flies."""
    first = skip(atoms, 0)
    if first + 2 >= len(atoms):
        return atoms
    told, who = atoms[first], atoms[first + 1]
    mode = next((m for m, words in _orders().items() if text_of(told, prompt) in words), None)
    if mode is None or who.noun is None or who.noun.kind is not NounKind.UAV:
        return atoms
    behind = skip(atoms, first + 2)
    clause = atoms[behind:]
    cut = next((i for i, a in enumerate(clause) if a.kind in _JOINING), len(clause))
    acts = any(a.kind in (AtomKind.VERB, AtomKind.CAUSATIVE) for a in clause[:cut])
    if not clause or clause[0].kind not in (*_GOVERNING, AtomKind.THING) or acts:
        return atoms
    verb = replace(told, kind=AtomKind.VERB, key=mode, form=VerbForm.THIRD)
    return [*atoms[:first], who, verb, *atoms[first + 2 :]]


@lru_cache(maxsize=1)
def _orders() -> dict[str, list[str]]:
    return dict(read_data('lexicon.yaml')['orders_to_fly'])


def _relative_object(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`a bus, which a police car is following`: who follows it is a sentence of its own."""
    for i in range(1, len(atoms) - 2):
        if atoms[i].kind is not AtomKind.RELATIVE or text_of(atoms[i], prompt) not in _WHICH:
            continue
        about = i - 1
        while about > 0 and atoms[about].kind is AtomKind.COMMA:
            about -= 1
        who = skip(atoms, i + 1)
        if not _named(atoms, about) or who >= len(atoms) or not atoms[who].is_actor:
            continue
        verb = skip(atoms, who + 1, (*HELPERS, AtomKind.NEGATION))
        if verb >= len(atoms) or atoms[verb].kind is not AtomKind.VERB:
            continue
        end = verb + 1
        while end < len(atoms) and atoms[end].kind not in (
            AtomKind.COMMA,
            AtomKind.CONJUNCTION,
            AtomKind.VERB,
            AtomKind.SUBORDINATOR,
            AtomKind.THEN,
            AtomKind.RELATIVE,
        ):
            end += 1
        behind = skip(atoms, verb + 1)
        if behind < end and atoms[behind].is_actor:
            continue
        told = _behind_verb(atoms[who:end], [atoms[about]])
        rest = atoms[end:]
        goes_on = skip(rest, 0, (AtomKind.COMMA, *HELPERS))
        main = goes_on < len(rest) and rest[goes_on].kind is AtomKind.VERB
        alone = not any(a.kind is AtomKind.VERB for a in atoms[:about])
        conjoined = any(a.kind is AtomKind.CONJUNCTION for a in rest[: goes_on + 1])
        if main and alone and not conjoined:
            kept = atoms[: about + 1] + [a for a in rest if a is not rest[0] or rest[0].key != ',']
            return [*kept, stop_at(atoms[i]), *told]
        if main and not conjoined:
            continue
        return [*atoms[: about + 1], stop_at(atoms[i]), *told, *rest]
    return atoms


def _having(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the bus has two cars following it`: `two cars following the bus`."""
    for i in range(1, len(atoms) - 3):
        has = text_of(atoms[i], prompt) in ('has', 'have', 'having', 'had')
        owner, who = atoms[i - 1], atoms[i + 1]
        if not has or not owner.is_actor or not who.is_actor:
            continue
        verb = skip(atoms, i + 2)
        if verb >= len(atoms) or atoms[verb].form is not VerbForm.ING:
            continue
        for k in range(verb + 1, min(verb + 4, len(atoms))):
            noun = atoms[k].noun
            if noun is not None and noun.kind is NounKind.PRONOUN and noun.key in ('it', 'person'):
                told = replace(owner, start=atoms[k].start, end=atoms[k].end)
                acting = replace(atoms[verb], form=VerbForm.THIRD)
                return [*atoms[: i - 1], who, acting, *atoms[verb + 1 : k], told, *atoms[k + 1 :]]
            if noun is not None:
                break
    return atoms


_TURNS: tuple[Callable[[list[Atom], str], list[Atom]], ...] = (
    _sent,
    _turned,
    _participle,
    _having,
    _relative_object,
)
