# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Messages told with verbs that say little by themselves.

`gives the ego a warning`, `lets the ego know`, `gives a short signal to the bus`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm


def messages_told(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with these messages as `alerts`, or as sent."""
    told = list(atoms)
    atoms = tuple(told)
    turns = shipped_lexicon().turns
    for i, atom in enumerate(atoms):
        who = skip(told, i + 1)
        if who >= len(told):
            break
        words = text_of(atom, prompt)
        if words in ('call', 'called'):
            told[i] = replace(atom, kind=AtomKind.UNKNOWN)  # `a drone called Alpha`
        elif told[who].is_actor:
            behind = skip(told, who + 1, HELPERS)
            if behind >= len(told):
                continue
            if words in turns['gives'] and told[behind].kind is AtomKind.MESSAGE:
                told[i] = _alert(atom, words)
            elif words in turns['lets'] and text_of(told[behind], prompt) in turns['know']:
                told[i] = _alert(atom, words)
                told[behind] = replace(told[behind], kind=AtomKind.FILL, noun=None)
        elif words in turns['gives'] and told[who].kind is AtomKind.MESSAGE:
            to = told[who + 1 : who + 3]
            if len(to) == 2 and to[0].key == 'to' and to[1].is_actor:
                told[i] = replace(_alert(atom, words), key='send')
    return told


def _alert(atom: Atom, words: str) -> Atom:
    form = VerbForm.ING if words.endswith('ing') else VerbForm.THIRD
    return replace(atom, kind=AtomKind.VERB, key='alert', form=form)
