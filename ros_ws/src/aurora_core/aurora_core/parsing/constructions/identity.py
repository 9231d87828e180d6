# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who somebody is: `one of them is our test vehicle`, `the first vehicle is a truck`."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import Determiner, NounKind, NounPhrase
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pronouns import ground
from aurora_core.spec.vocabulary import AgentType, Role


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
