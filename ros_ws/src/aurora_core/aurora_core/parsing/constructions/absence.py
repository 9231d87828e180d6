# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`there are no buses`: who is not there. Whoever is asked for nevertheless is missing."""

from __future__ import annotations

import re

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import NounKind, NounPhrase
from aurora_core.parsing.frames import Frame
from aurora_core.spec.vocabulary import ClauseStatus

_BEING = frozenset({'', 'be', 'exist', 'contain', 'put', 'appear', 'come'})
# `no other bicycle`: those that are named are all.
_MORE = re.compile(r'\b(other|further|more|additional|else|another|extra)\b')
_PLAIN = frozenset({NounKind.SURROUNDINGS, NounKind.STREET, NounKind.AGENT})


def none_such(frame: Frame) -> bool:
    """Note the kinds of actors that a clause excludes."""
    if not frame.negated or frame.key not in _BEING:
        return False
    nouns = [n for n in frame.nouns() if n.key != 'there']
    agents = [n for n in nouns if n.kind is NounKind.AGENT]
    placed = frame.free(AdjunctKind.PLACE) or any(a.measure for a in frame.adjuncts)
    if not agents or placed or any(n.kind not in _PLAIN or n.states for n in nouns):
        return False
    if not all(_denied(frame, noun) for noun in agents):
        return False
    for adjunct in frame.adjuncts:
        adjunct.used = adjunct.used or bool(adjunct.nouns)
    for noun in agents:
        frame.resolver.deny(noun, strictly=_MORE.search(_before(frame, noun)) is None)
    frame.scene.clause.status = ClauseStatus.ENCODED
    return True


def _before(frame: Frame, noun: NounPhrase) -> str:
    return frame.scene.prompt[frame.piece.start : noun.start].lower()[-24:]


def _denied(frame: Frame, noun: NounPhrase) -> bool:
    """`no buses`, `without any bus`; in `the car is not a bus` a car is spoken of."""
    words = re.findall(r"[a-z']+", _before(frame, noun))
    return bool({'no', 'without', 'not', 'neither', 'nor', "aren't", "isn't"} & set(words[-3:]))
