# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`the car is the ego`, `one of them is our test vehicle`: who was named is the ego vehicle."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pronouns import ground
from aurora_core.spec.vocabulary import AgentType, Role

_NAMES = (NounKind.AGENT, NounKind.VEHICLE, NounKind.PRONOUN)


def is_ego(frame: Frame) -> bool:
    """Read that one actor is the ego vehicle; not when there is another ego already."""
    named = frame.free(AdjunctKind.OBJECT)
    nouns = frame.subject_nouns
    if frame.key != 'be' or frame.negated or len(nouns) != 1 or len(named) != 1:
        return False
    if (
        nouns[0].kind not in _NAMES
        or nouns[0].key == 'there'
        or frame.resolver.names_ego(nouns[0])
    ):
        return False
    ego = named[0].nouns
    if len(ego) != 1 or not frame.resolver.names_ego(ego[0]) or frame.scene.ego is not None:
        return False
    found = frame.subjects(ground)
    if len(found) != 1 or found[0].type in (AgentType.PEDESTRIAN, AgentType.RSU):
        return False
    found[0].role = Role.EGO
    named[0].used = True
    frame.resolver.note(ego[0], found)
    frame.scene.became(found[0].id)
    return True
