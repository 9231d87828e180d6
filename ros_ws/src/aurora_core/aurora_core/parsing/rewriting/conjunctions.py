# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes that other words than `when` join to their effects, written out as `when …`.

`the ego brakes because the drone has warned it`, `it stays parked unless it is warned, in which
case it sets off`, `no sooner has the bus stopped than the drone lands`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import LOOSE, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import TRANSPARENT
from aurora_core.parsing.reactions import REACTIONS

_PAUSES = (AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN, AtomKind.RELATIVE)
_EFFECTS = frozenset({*REACTIONS, 'land', 'ascend', 'descend', 'alert', 'send', 'report'})
# What happens at a moment; `because a boy stands there` is no event.
_HAPPENS = frozenset(
    {
        *_EFFECTS,
        *('receive', 'reach', 'see', 'lose', 'appear', 'vanish', 'exceed', 'fall_below', 'come'),
        *('step_onto', 'finish'),
    }
)


def joined(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with these causes behind `when`."""
    told = _because(list(atoms), prompt)
    return _alike(told)


def _when(atom: Atom) -> Atom:
    return replace(atom, kind=AtomKind.SUBORDINATOR, key='when', other_kinds=frozenset())


def _because(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the ego brakes because the drone has warned it`; `it brakes. Why? Because …`."""
    words = shipped_lexicon().turns['reasons']
    changed = list(atoms)
    for i in range(len(changed) - 1, 0, -1):
        atom = changed[i]
        if atom.kind is not AtomKind.CONJUNCTION or text_of(atom, prompt) not in words:
            continue
        end = i
        while end and _asks_why(changed[end - 1], prompt):
            end -= 1
        begin = end
        while begin and changed[begin - 1].kind not in (AtomKind.STOP, AtomKind.RELATIVE):
            begin -= 1
        effect = changed[begin:end]
        verbs = [a for a in effect if a.kind is AtomKind.VERB]
        waits = any(a.kind in (AtomKind.SUBORDINATOR, AtomKind.NEGATION) for a in effect)
        acts = bool(verbs) and verbs[-1].key in _EFFECTS and any(a.is_actor for a in effect)
        if acts and not waits and _is_event(changed, i + 1):
            changed[end : i + 1] = [_when(atom)]
    return changed


def _asks_why(atom: Atom, prompt: str) -> bool:
    """`. Why? Because`, `, and that is because`."""
    return atom.kind in (AtomKind.STOP, *LOOSE) or text_of(atom, prompt) == 'why'


def _is_event(atoms: Sequence[Atom], i: int) -> bool:
    told: list[Atom] = []
    for atom in atoms[i:]:
        if atom.kind in (AtomKind.STOP, AtomKind.SUBORDINATOR):
            break
        told.append(atom)
    first = skip(told, 0, TRANSPARENT)
    named = first < len(told) and (told[first].is_actor or told[first].kind is AtomKind.MESSAGE)
    return named and any(a.kind is AtomKind.VERB and a.key in _HAPPENS for a in told[first:])


def _alike(atoms: list[Atom]) -> list[Atom]:
    """`the second truck starts 5 s after the first one`: after the first one starts."""
    written: list[Atom] = []
    verb: Atom | None = None
    for i, atom in enumerate(atoms):
        written.append(atom)
        if atom.kind is AtomKind.VERB:
            verb = atom
        elif atom.kind in (AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION):
            verb = None
        before = atoms[i - 1] if i else None
        ends = i + 1 == len(atoms) or atoms[i + 1].kind in _PAUSES
        named = atom.is_actor and atom.key not in ('it', 'they', 'person')
        behind = before is not None and before.key == 'after' and named and ends
        if behind and verb is not None and verb.key in REACTIONS:
            assert before is not None
            written[-2] = replace(before, kind=AtomKind.SUBORDINATOR)
            written.append(replace(verb, start=atom.start, end=atom.end, form=VerbForm.THIRD))
            verb = None
    return written
