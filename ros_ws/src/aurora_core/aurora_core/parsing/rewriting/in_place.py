# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes in other places and words than behind `when`, as clauses in front of their effect.

Without a verb (`truck above 60 km/h: …`), in the middle of the effect, `were the van to brake, …`.
"""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

from aurora_core.parsing.atom_runs import LOOSE, skip
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.measures import LENGTH, SPEED
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import TRANSPARENT

_ENDS = (AtomKind.STOP, AtomKind.COMMA, AtomKind.THEN, AtomKind.CONJUNCTION)


def verbless(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`truck above 60 km/h: the drone warns it`, `bus out of sight -> it climbs`."""
    told = list(atoms)
    for i in range(1, len(told)):
        colon = told[i].kind is AtomKind.STOP and told[i].key == ':'
        if not colon and not (told[i].kind is AtomKind.THEN and told[i].key == '→'):
            continue
        begin = i
        while begin and told[begin - 1].kind is not AtomKind.STOP:
            begin -= 1
        cause = told[begin:i]
        first = skip(cause, 0)
        if first >= len(cause) or not cause[first].is_actor:
            continue
        text = prompt[cause[0].start : cause[-1].end].lower()
        gone = re.search(r'\b(?:out of (?:sight|view)|hidden|gone|invisible|occluded)$', text)
        linked = any(a.kind is AtomKind.SUBORDINATOR for a in cause)
        if linked or (not gone and any(a.kind is AtomKind.VERB for a in cause)):
            continue
        compared = any(
            a.kind is AtomKind.PREPOSITION
            and a.key in ('within', 'beyond', 'below', 'over')
            and b.measure is not None
            and b.key in (LENGTH, SPEED)
            for a, b in pairwise(cause)
        )
        seen = any(a.kind is AtomKind.IN_VIEW for a in cause)
        effect = any(a.kind is AtomKind.VERB for a in told[i + 1 : i + 6])
        if not effect or not (gone or compared or seen):
            continue
        clause = cause
        if gone:
            word = replace(cause[-1], kind=AtomKind.VERB, key='vanish', form=VerbForm.THIRD)
            clause = [*cause[: first + 1], replace(word, noun=None, measure=None)]
        clause = [
            replace(a, key='beyond') if a.kind is AtomKind.PREPOSITION and a.key == 'over' else a
            for a in clause
        ]
        at = cause[0].start
        when = Atom(kind=AtomKind.SUBORDINATOR, key='when', start=at, end=at + 1)
        told[begin : i + 1] = [when, *clause, replace(told[i], kind=AtomKind.COMMA, key=',')]
        return verbless(told, prompt)
    return told


def interrupted(atoms: list[Atom]) -> list[Atom]:
    """`the car, when it has the message, yields`: the cause first."""
    told = list(atoms)
    for i in range(1, len(told) - 2):
        opens = told[i].kind is AtomKind.COMMA and told[i - 1].is_actor
        if not opens or told[i + 1].kind is not AtomKind.SUBORDINATOR or told[i + 1].key != 'when':
            continue
        begin = i - 1
        while begin and told[begin - 1].kind in LOOSE:
            begin -= 1
        if begin and told[begin - 1].kind not in (*_ENDS, AtomKind.SUBORDINATOR):
            continue
        stop = next((k for k in range(i + 2, len(told)) if told[k].kind is AtomKind.COMMA), None)
        if stop is None or any(a.kind is AtomKind.STOP for a in told[i:stop]):
            continue
        behind = skip(told, stop + 1, TRANSPARENT)
        if behind < len(told) and told[behind].kind is AtomKind.VERB:
            told[begin : stop + 1] = [*told[i + 1 : stop + 1], *told[begin:i]]
    return told
