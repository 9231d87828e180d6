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

from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind
from aurora_core.parsing.lexicon import read_data
from aurora_core.parsing.measures import COUNT
from aurora_core.parsing.morphology import VerbForm

_LOOSE = (AtomKind.FILL, AtomKind.FRAME)
_HELPERS = (AtomKind.AUXILIARY, *_LOOSE)
_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION)
_WITHOUT_OBJECT = frozenset({'land', 'hover', 'ascend', 'descend', 'start', 'stop', 'brake'})
_WITH_OBJECT = frozenset({'track', 'follow', 'observe', 'orbit', 'navigate', 'overtake', 'cross'})


def predicates(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with acts that are nouns as verbs."""
    written: list[Atom] = []
    sentence: list[Atom] = []
    for atom in (*_steps(atoms, prompt), None):
        if atom is not None and atom.kind is not AtomKind.STOP:
            sentence.append(atom)
            continue
        told = _done_by(_target(_acts(_same_count(sentence, prompt), prompt), prompt), prompt)
        written += _verbless(_of_whom(told))
        sentence = []
        if atom is not None:
            written.append(atom)
    return written


def _word(atom: Atom, prompt: str) -> str:
    return prompt[atom.start : atom.end].lower()


def _skip(atoms: Sequence[Atom], i: int, kinds: tuple[AtomKind, ...] = _LOOSE) -> int:
    while i < len(atoms) and atoms[i].kind in kinds:
        i += 1
    return i


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
    return words in _done() or words.split()[-1] in _done()


def _done_by(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`tracking, from 25 m, is done by a UAV`: a UAV tracks from 25 m."""
    by = next(
        (
            i
            for i in range(2, len(atoms) - 1)
            if atoms[i].key == 'by' and atoms[i + 1].is_actor and _word(atoms[i - 1], prompt)
        ),
        None,
    )
    if by is None:
        return atoms
    begin = by - 1
    while begin > 0 and (
        _is_done(_word(atoms[begin], prompt))
        or atoms[begin].kind in _HELPERS
        or atoms[begin].key == 'be'
    ):
        begin -= 1
    told = [_word(a, prompt) for a in atoms[begin + 1 : by]]
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
def _act_nouns() -> dict[str, str]:
    listed = read_data('lexicon.yaml')['act_nouns']
    return {word: key for key, words in listed.items() for word in words}


def _acts(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the observation of the bus`: as `observing` it."""
    changed = list(atoms)
    for i in range(len(changed) - 2):
        words = re.sub(r'^(?:the|a|an|its)\s+', '', _word(changed[i], prompt))
        key = _act_nouns().get(words)
        about = changed[i + 2].is_actor or changed[i + 2].is_place
        if key is not None and changed[i + 1].key == 'of' and about:
            changed[i] = replace(
                changed[i], kind=AtomKind.VERB, key=key, form=VerbForm.ING, noun=None
            )
    return changed


def _target(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`tracking is done by a UAV, the target being a truck`: a UAV tracks a truck."""
    for i in range(1, len(atoms) - 2):
        word = re.sub(r'^(?:the|its)\s+', '', _word(atoms[i], prompt))
        if word != 'target':
            continue
        be = _skip(atoms, i + 1)
        who = _skip(atoms, be + 1 if be < len(atoms) and atoms[be].key == 'be' else be)
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
        stop = Atom(kind=AtomKind.STOP, key=';', start=atoms[i].start, end=atoms[i].end)
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
        stop = [Atom(kind=AtomKind.STOP, key=';', start=word.start, end=word.end)] if i else []
        begin = i - 1 if i else i
        return [*changed[:begin], *stop, new, be, *changed[i : near + 2], *changed[near + 3 :]]
    return changed


def _same_count(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`a couple of cars, two of them, …`: the number once more."""
    changed = list(atoms)
    for i in range(1, len(changed) - 2):
        measure = changed[i].measure
        them = _word(changed[i + 2], prompt) in ('them', 'these', 'those')
        if measure is None or measure.dimension != COUNT or changed[i + 1].key != 'of' or not them:
            continue
        counted = next((a.noun for a in reversed(changed[:i]) if a.noun is not None), None)
        if counted is not None and counted.count == measure.value:
            for k in range(i, i + 3):
                changed[k] = replace(changed[k], kind=AtomKind.FILL, noun=None, measure=None)
    return changed
