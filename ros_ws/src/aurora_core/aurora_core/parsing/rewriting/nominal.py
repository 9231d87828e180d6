# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Acts told with nouns, put as predicates.

`tracking of a bus is done by a drone`, `the landing of the drone`, `the last part is a hover`,
`behind it a van`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import HELPERS, LOOSE, by_sentence, skip, stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.rewriting.counts import counted, said_twice

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION)
_WITHOUT_OBJECT = frozenset({'land', 'hover', 'ascend', 'descend', 'start', 'stop', 'brake'})
_WITH_OBJECT = frozenset({'track', 'follow', 'observe', 'orbit', 'navigate', 'overtake', 'cross'})


_GOES_OUT = ('drive', 'start', 'leave', 'send', 'come', 'reach')


def predicates(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with acts that are nouns as verbs."""

    def told(sentence: list[Atom]) -> list[Atom]:
        acts = _acts(said_twice(_front_siren(_kept(_message(sentence, prompt))), prompt), prompt)
        return _verbless(_of_whom(_done_by(_target(acts, prompt), prompt)))

    return by_sentence(counted(_steps(atoms, prompt), prompt), told)


def _message(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`a message goes out from the UAV to the car`: the UAV sends it."""
    for i in range(len(atoms) - 4):
        if atoms[i].kind is not AtomKind.MESSAGE:
            continue
        verb = skip(atoms, i + 1, HELPERS)
        if verb >= len(atoms) or atoms[verb].key not in _GOES_OUT:
            continue
        k = skip(atoms, verb + 1)
        ends = {a.key: n for n, a in enumerate(atoms) if n >= k and a.key in ('from', 'to')}
        start, goal = ends.get('from'), ends.get('to')
        if start is None and (i == 0 or atoms[i - 1].kind is AtomKind.FILL):
            atoms = _is_sent(atoms, verb, prompt)
        if start is None or goal is None or goal + 1 >= len(atoms) or start + 1 >= len(atoms):
            continue
        sender, receiver = atoms[start + 1], atoms[goal + 1]
        if not sender.is_actor or not receiver.is_actor:
            continue
        send = replace(atoms[verb], kind=AtomKind.VERB, key='send', form=VerbForm.THIRD)
        rest = atoms[max(start, goal) + 2 :]
        begin = i - 1 if i and atoms[i - 1].kind is AtomKind.FILL else i
        return [*atoms[:begin], sender, send, atoms[i], atoms[goal], receiver, *rest]
    return atoms


def _is_sent(atoms: list[Atom], verb: int, prompt: str) -> list[Atom]:
    """`a warning goes out to the car`, `the call comes at 20 s`: it is sent."""
    moved = atoms[verb]
    behind = atoms[verb + 1] if verb + 1 < len(atoms) else None
    words = text_of(moved, prompt) + ('' if behind is None else ' ' + text_of(behind, prompt))
    if not words.startswith(tuple(shipped_lexicon().turns['goes_out'])):
        return atoms
    helper = replace(moved, kind=AtomKind.AUXILIARY, key='be', end=moved.start + 1)
    sent = replace(moved, kind=AtomKind.VERB, key='send', form=VerbForm.PAST)
    return [*atoms[:verb], helper, sent, *atoms[verb + 1 :]]


def _kept(atoms: list[Atom]) -> list[Atom]:
    """`a van is kept in view by a drone`: a drone keeps it in view."""
    for i in range(1, len(atoms)):
        if atoms[i].kind is not AtomKind.IN_VIEW:
            continue
        by = next((k for k in range(i + 1, len(atoms) - 1) if atoms[k].key == 'by'), None)
        verb = i - 1
        while verb > 0 and atoms[verb].kind in LOOSE:
            verb -= 1
        held = atoms[verb].key in ('keep', 'be kept', 'hold')
        who = verb - 1
        while who >= 0 and (atoms[who].kind in HELPERS or atoms[who].key == 'be'):
            who -= 1
        passive = verb > who + 1 or atoms[verb].key == 'be kept'
        if by is None or not held or not passive or who < 0 or not atoms[who].is_actor:
            continue
        if not atoms[by + 1].is_actor:
            continue
        keep = replace(atoms[verb], kind=AtomKind.VERB, key='keep', form=VerbForm.THIRD)
        middle = atoms[i:by]
        return [*atoms[:who], atoms[by + 1], keep, atoms[who], *middle, *atoms[by + 2 :]]
    return atoms


def _front_siren(atoms: list[Atom]) -> list[Atom]:
    """`with its siren on, an ambulance …`: behind the one who has it."""
    first = skip(atoms, 0)
    if first + 2 >= len(atoms) or atoms[first].kind is not AtomKind.SIREN:
        return atoms
    who = skip(atoms, first + 1, (AtomKind.COMMA, *LOOSE))
    if who >= len(atoms) or not atoms[who].is_actor:
        return atoms
    return [*atoms[:first], atoms[who], atoms[first], *atoms[who + 1 :]]


@lru_cache(maxsize=1)
def _step() -> re.Pattern[str]:
    """`the last part is`, `as a next step`: only the order counts."""
    data = read_data('lexicon.yaml')['steps']
    words = {name: '|'.join(re.escape(w) for w in listed) for name, listed in data.items()}
    ordinal = rf'(?P<first>{words["first"]})|(?:{words["later"]})'
    head = rf'(?:{ordinal})\s+(?:{words["nouns"]})'
    again = head.replace('?P<first>', '?P<front>')
    owner = r'(?:\s+of\s+(?:the|this|our|its)\s+\w+)?'
    verb = (
        r'(?:\s+(?:is|are|will be|should be|shall be|must be|consists of|being)(?:\s+to)?\b|\s*:)'
    )
    return re.compile(
        rf'\b(?:(?:the|a|its|our)\s+{head}{owner}{verb}'
        rf'|(?:as|in|for|with)\s+(?:the|a|its|our)\s+(?:{again}),?)'
    )


def _steps(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    found = [(m.start(), m.end(), m.groupdict()) for m in _step().finditer(prompt.lower())]
    written: list[Atom] = []
    for atom in atoms:
        span = next((s for s in found if s[0] <= atom.start and atom.end <= s[1]), None)
        if span is None:
            written.append(atom)
            continue
        opening = any(span[2].values())
        told = Atom(
            kind=AtomKind.FILL if opening else AtomKind.THEN,
            key='first' if opening else 'then',
            start=span[0],
            end=span[1],
        )
        if not written or written[-1] != told:
            written.append(told)
    return written


@lru_cache(maxsize=1)
def _done() -> frozenset[str]:
    return frozenset(read_data('lexicon.yaml')['done_words'])


def _is_done(words: str) -> bool:
    return words in _done() or words.rpartition(' ')[2] in _done()


def _done_by(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`tracking, from 25 m, is done by a UAV`: a UAV tracks from 25 m."""
    by = next(
        (
            i
            for i in range(2, len(atoms) - 1)
            if atoms[i].key == 'by' and atoms[i + 1].is_actor and text_of(atoms[i - 1], prompt)
        ),
        None,
    )
    if by is None:
        return atoms
    begin = by - 1
    while begin > 0 and (
        _is_done(text_of(atoms[begin], prompt))
        or atoms[begin].kind in HELPERS
        or atoms[begin].key == 'be'
    ):
        begin -= 1
    told = [text_of(a, prompt) for a in atoms[begin + 1 : by]]
    act = next((i for i, a in enumerate(atoms[: begin + 1]) if a.kind is AtomKind.VERB), None)
    if act is None or not any(_is_done(w) for w in told):
        return atoms
    if atoms[act].form is not VerbForm.ING or any(
        a.kind is AtomKind.VERB for a in atoms[act + 1 : begin + 1]
    ):
        return atoms
    verb = replace(atoms[act], form=VerbForm.THIRD)
    between = atoms[act + 1 : begin + 1]
    while between and between[0].kind is AtomKind.COMMA:
        between = between[1:]
    while between and between[-1].kind is AtomKind.COMMA:
        between = between[:-1]
    if between and between[0].key == 'of':
        between = between[1:]
    return [*atoms[:act], atoms[by + 1], verb, *between, *atoms[by + 2 :]]


@lru_cache(maxsize=1)
def act_nouns() -> dict[str, str]:
    """Return the key of the verb of every act that is told with a noun."""
    listed = read_data('lexicon.yaml')['act_nouns']
    return {word: key for key, words in listed.items() for word in words}


def _acts(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the observation of the bus`: as `observing` it."""
    changed = list(atoms)
    for i in range(len(changed) - 2):
        words = re.sub(r'^(?:the|a|an|its)\s+', '', text_of(changed[i], prompt))
        key = act_nouns().get(words)
        about = changed[i + 2].is_actor or changed[i + 2].is_place
        if key is not None and changed[i + 1].key == 'of' and about:
            changed[i] = replace(
                changed[i], kind=AtomKind.VERB, key=key, form=VerbForm.ING, noun=None
            )
    return changed


def _target(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`tracking is done by a UAV, the target being a truck`: a UAV tracks a truck."""
    for i in range(1, len(atoms) - 2):
        word = re.sub(r'^(?:the|its)\s+', '', text_of(atoms[i], prompt))
        if word != 'target':
            continue
        be = skip(atoms, i + 1)
        who = skip(atoms, be + 1 if be < len(atoms) and atoms[be].key == 'be' else be)
        copula = prompt[atoms[i].end : atoms[who].start].split() if who < len(atoms) else []
        if not {'is', 'being', 'was'}.intersection(copula) or not atoms[who].is_actor:
            continue
        act = next(
            (
                k
                for k, a in enumerate(atoms[:i])
                if a.kind is AtomKind.VERB and a.key in _WITH_OBJECT
            ),
            None,
        )
        if act is None or (atoms[act + 1].is_actor or atoms[act + 1].key == 'of'):
            continue
        stop = stop_at(atoms[i])
        before = atoms[act + 1 : i]
        while before and before[-1].kind in _BREAKS:
            before.pop()
        more = atoms[who + 1 :]
        later = [stop, atoms[who], *more] if more else []
        return [*atoms[: act + 1], atoms[who], *before, *later]
    return atoms


def _of_whom(atoms: list[Atom]) -> list[Atom]:
    """`the landing of the drone`, `the tracking of a bus by a drone`."""
    changed = list(atoms)
    for i in range(len(changed) - 2):
        act, of, noun = changed[i : i + 3]
        if act.kind is not AtomKind.VERB or act.form is not VerbForm.ING or of.key != 'of':
            continue
        if of.kind is not AtomKind.PREPOSITION or not (noun.is_actor or noun.is_place):
            continue
        if act.key in _WITHOUT_OBJECT and noun.is_actor:
            changed[i : i + 3] = [noun, replace(act, form=VerbForm.THIRD)]
            return _of_whom(changed)
        if act.key in _WITH_OBJECT:
            changed[i + 1 : i + 3] = [noun]
            return _of_whom(changed)
    return changed


def _verbless(atoms: list[Atom]) -> list[Atom]:
    """`…, behind it a van`: a van is behind it."""
    changed = list(atoms)
    for i in range(len(changed) - 2):
        opens = i == 0 or changed[i - 1].kind in _BREAKS
        near = i + 1 if changed[i].measure is not None else i
        if not opens or near + 2 >= len(changed) or changed[near].kind is not AtomKind.RELATION:
            continue
        known, new = changed[near + 1], changed[near + 2]
        ends = near + 3 == len(changed) or changed[near + 3].kind in _BREAKS
        if not ends or known.noun is None or new.noun is None or not new.is_actor:
            continue
        told = known.noun.kind is NounKind.PRONOUN or known.noun.determiner is Determiner.DEFINITE
        fresh = (
            new.noun.determiner in (Determiner.INDEFINITE, Determiner.ANOTHER) or new.noun.count
        )
        if not known.is_actor or not told or not fresh:
            continue
        word = changed[near]
        be = Atom(
            kind=AtomKind.VERB, key='be', start=word.start, end=word.end, form=VerbForm.THIRD
        )
        stop = [stop_at(word)] if i else []
        begin = i - 1 if i else i
        return [*changed[:begin], *stop, new, be, *changed[i : near + 2], *changed[near + 3 :]]
    return changed
