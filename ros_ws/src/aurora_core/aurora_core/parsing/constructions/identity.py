# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who somebody is, and who is not there."""

from __future__ import annotations

import re

from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pronouns import ground
from aurora_core.spec.vocabulary import AgentType, ClauseStatus, Role

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


def is_of_type(frame: Frame) -> None:
    """`the first vehicle is a truck, 20 m ahead`: one vehicle, and now its type is known."""
    nouns = frame.subject_nouns
    if frame.key != 'be' or frame.negated or len(nouns) != 1:
        return
    about = nouns[0]
    told = next((a for a in frame.free(AdjunctKind.OBJECT) if _names_type(a)), None)
    if told is None or about.plural or about.count > 1:
        return
    if about.kind in (NounKind.VEHICLE, NounKind.AGENT) and _told_by_place(frame, about):
        told.used = True
        frame.subject_nouns = told.nouns
        frame.resolver.note(about, frame.resolver.actors(told.nouns, accept=ground))
        return
    if about.kind is not NounKind.VEHICLE:
        return
    known = len(frame.scene.entities)
    found = frame.subjects(ground)
    if len(found) != 1 or not found[0].generic:
        return
    entity, kind = found[0], AgentType(told.nouns[0].key)
    if kind is AgentType.PEDESTRIAN:
        return
    told.used = True
    entity.type, entity.generic = kind, False
    new = entity.role is not Role.EGO and len(frame.scene.entities) > known
    if new and kind is not AgentType.CAR:
        entity.id = frame.scene.new_id(kind.value)
    frame.resolver.note(told.nouns[0], found)


def _told_by_place(frame: Frame, about: NounPhrase) -> bool:
    """`the vehicle ahead of the ego is a bus`: where tells who, and it is nobody named before."""
    verb = frame.verb
    if verb is None or about.determiner is not Determiner.DEFINITE or about.index:
        return False
    return any(
        about.end <= a.start < verb.start and not frame.scene.prompt[about.end : a.start].strip()
        for a in frame.free(AdjunctKind.PLACE)
    )


def _names_type(adjunct: Adjunct) -> bool:
    noun = adjunct.nouns[0] if len(adjunct.nouns) == 1 else None
    new = (Determiner.INDEFINITE, Determiner.ONE)
    return noun is not None and noun.kind is NounKind.AGENT and noun.determiner in new
