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

from aurora_core.parsing.atom_runs import HELPERS, by_sentence, skip, stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.morphology import VerbForm

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION)
_WITH_OBJECT = frozenset({'track', 'follow', 'observe', 'orbit', 'navigate', 'overtake', 'cross'})


_GOES_OUT = ('drive', 'start', 'leave', 'send', 'come', 'reach')


def predicates(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with acts that are nouns as verbs."""

    def told(sentence: list[Atom]) -> list[Atom]:
        acts = _message(sentence, prompt)
        return _target(acts, prompt)

    return by_sentence(list(atoms), told)


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


@lru_cache(maxsize=1)
def act_nouns() -> dict[str, str]:
    """Return the key of the verb of every act that is told with a noun."""
    listed = read_data('lexicon.yaml')['act_nouns']
    return {word: key for key, words in listed.items() for word in words}


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
