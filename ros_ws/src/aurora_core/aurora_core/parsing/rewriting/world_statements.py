# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Statements about the whole scene: how long it lasts, how dense the traffic is."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import stop_at
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.morphology import VerbForm

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION)


def horizon(atoms: list[Atom]) -> list[Atom]:
    """`after 180 s the scenario is over`, `for 120 s, which is its length`: how long it lasts."""
    written: list[Atom] = []
    sentence: list[Atom] = []
    for atom in (*atoms, None):
        if atom is not None and atom.kind is not AtomKind.STOP:
            sentence.append(atom)
            continue
        colon = atom is not None and atom.key == ':'
        written += _clauses(sentence)
        if atom is not None and not (colon and _heads(sentence)):
            written.append(atom)
            sentence = []
        elif atom is not None:
            del written[len(written) - len(sentence) :]
            sentence.append(replace(atom, kind=AtomKind.FILL))
    return written


def _heads(atoms: Sequence[Atom]) -> bool:
    """`total running time of the scenario:`: a name whose value comes next."""
    told = any(a.kind is AtomKind.WORLD_NOUN or _is_scenario(a, atoms) for a in atoms)
    plain = not any(a.is_actor or a.kind is AtomKind.VERB or a.measure is not None for a in atoms)
    return told and plain


def _is_scenario(atom: Atom, atoms: Sequence[Atom]) -> bool:
    """`the length of the scenario`: here the phrase says of what."""
    if atom.kind is AtomKind.FROM_START:
        return atom.key.startswith('of ') and any(a.key in ('length', 'duration') for a in atoms)
    return atom.kind is AtomKind.SCENARIO


_OF_SOMETHING_ELSE = (AtomKind.WORLD, AtomKind.NEGATION, AtomKind.THEN, AtomKind.IN_VIEW)
_ENDINGS = ('finish', 'be', 'last', 'trace', 'keep', 'come', 'stop')


_OVER = re.compile(
    r'\b(?:over|finished|done|completed?|ended|through|terminated|concluded|at an end)'
    r'(?: (?:after|by|at|within|in|no later than|t|=))*$'
)


def _clauses(atoms: list[Atom]) -> list[Atom]:
    """Rewrite the stretch between two commas that tells how long the scenario takes."""
    named = next((i for i, a in enumerate(atoms) if _is_scenario(a, atoms)), None)
    if named is None:
        return atoms
    begin, end = named, named + 1
    while begin and not _parts(atoms[begin - 1]):
        begin -= 1
    while end < len(atoms) and not _parts(atoms[end]):
        end += 1
    told = atoms[begin:end]
    which = begin > 1 and told[0].kind is AtomKind.RELATIVE and atoms[begin - 1].key == ','
    if which and atoms[begin - 2].key == TIME and begin <= _OPENING:
        begin, told = 0, atoms[:end]
    times = [a for a in atoms[begin:named] if a.key == TIME and a.measure is not None]
    behind = [i for i in range(named, end) if atoms[i].key == TIME and atoms[i].measure]
    if behind:  # `the whole run is over after 90 s`
        words = ' '.join(a.words for a in atoms[named + 1 : behind[0]])
        if times or len(behind) > 1 or _OVER.search(words) is None:
            return atoms
        times = [atoms[behind[0]]]
        told = [a for a in told if a.kind is not AtomKind.VERB or a.key not in ('exceed', 'start')]
    verbs = [a for a in told if a.kind is AtomKind.VERB]
    others = any(a.noun is not None and (a.is_actor or a.is_place) for a in told)
    if len(times) != 1 or others or any(v.key not in _ENDINGS for v in verbs):
        return atoms
    if any(a.kind in _OF_SOMETHING_ELSE for a in told):
        return atoms
    if not verbs and not any(a.key in ('length', 'duration') for a in told):
        return atoms
    verb = Atom(
        kind=AtomKind.VERB,
        key='last',
        start=atoms[named].start,
        end=atoms[named].end,
        form=VerbForm.THIRD,
    )
    stop = stop_at(atoms[named])
    sentence = [replace(atoms[named], kind=AtomKind.SCENARIO), verb, times[0]]
    before, after = atoms[:begin], atoms[end:]
    while before and before[-1].kind in _BREAKS:
        before.pop()
    while after and after[0].kind in _BREAKS:
        after.pop(0)
    before = [*before, stop] if before else []
    return [*before, *sentence, *([stop, *after] if after else [])]


# A time of this many words may open the sentence.
_OPENING = 4


def _parts(atom: Atom) -> bool:
    return atom.kind is AtomKind.COMMA or atom.kind is AtomKind.CONJUNCTION


def traffic(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`traffic should be medium`, `a low density of traffic`: one word about the world."""
    found = [(m.start(), m.end(), m.lastgroup or '') for m in _density().finditer(prompt.lower())]
    written: list[Atom] = []
    for atom in atoms:
        span = next((s for s in found if s[0] <= atom.start and atom.end <= s[1]), None)
        if span is None:
            written.append(atom)
            continue
        start, end, level = span
        level = level.rstrip('_')
        world = Atom(kind=AtomKind.WORLD, key=f'traffic_density:{level}', start=start, end=end)
        if not written or written[-1] != world:
            written.append(world)
    return written


@lru_cache(maxsize=1)
def _density() -> re.Pattern[str]:
    data = read_data('lexicon.yaml')['traffic_words']
    amount = r'(?:density|volume|level|amount|flow|intensity|load|conditions?)'
    kind = r'(?:road|street|city|urban|background|ambient|surrounding|other|overall|vehicle)'
    where = (
        r'(?:\s+(?:beneath|below|underneath|under|around|round|about|down there|there|nearby)'
        r'(?:\s+(?:it|them|him|her|the (?:drones?|uavs?|copter|aircraft)))?)?'
    )
    be = (
        r'(?:\s*[:=]\s*|\s+(?:(?:is|are|be|being|stays?|remains?|should|must|shall|will|has to|'
        r'ought to|set|at|of|with|on the (?:roads?|streets?)|supposed|to|meant|a|of|kept)\s+)+)'
    )
    hedge = (
        r'(?:(?:\s+(?:around|about|nearby))?\s*,\s*(?:but\s+)?'
        r'not\s+(?:too|very|so|that)\s+(?:much|heavy|dense|busy)(?:\s+of\s+it)?)?'
    )
    patterns = []
    for level, words in data.items():
        any_of = '|'.join(re.escape(w) for w in words)
        patterns.append(
            rf'(?P<{level}>\b(?:(?:the|a|an)\s+)?(?:{any_of})[-\s]+(?:{amount}\s+)?(?:of\s+)?(?:the\s+)?'
            rf'(?:{kind}\s+)*traffic\b(?:\s+{amount})?{hedge})'
        )
        patterns.append(rf'(?P<{level}___>(?<=, )traffic\s+(?:{any_of})(?=\s*(?:[,;.]|$)))')
        patterns.append(
            rf'(?P<{level}_>\b(?:the\s+)?traffic(?:\s+{amount})?{where}{be}(?:{any_of})\b(?:[-\s]+{amount})?)'
        )
        patterns.append(
            rf'(?P<{level}__>\b(?:the\s+)?(?:{amount}\s+)(?:of\s+(?:the\s+)?)'
            rf'(?:{kind}\s+)*traffic{be}(?:{any_of})\b)'
        )
    return re.compile('|'.join(patterns))
