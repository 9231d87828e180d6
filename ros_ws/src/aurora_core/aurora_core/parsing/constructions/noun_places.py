# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places that belong to a noun, not to the predicate: `follows the van behind the ego`."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import NounPhrase
from aurora_core.parsing.constructions.places import add_placement, placement_at
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.scene import Entity

_KINDS = (AdjunctKind.PLACE, AdjunctKind.PHRASE)


def noun_places(frame: Frame) -> None:
    """Place ground agents by the free place words right behind their nouns."""
    for adjunct in frame.adjuncts:
        if adjunct.used or adjunct.kind not in _KINDS:
            continue
        entity = _owner(frame, adjunct)
        if entity is None:
            continue
        placement = placement_at(frame, adjunct, entity)
        if placement is not None:
            adjunct.used = True
            add_placement(entity, placement)


def _owner(frame: Frame, adjunct: Adjunct) -> Entity | None:
    """Return the one ground agent whose noun ends where the place begins."""
    nouns: list[NounPhrase] = list(frame.nouns())
    for noun in nouns:
        between = frame.scene.prompt[noun.end : adjunct.start]
        if noun.end <= adjunct.start and not between.strip():
            known = frame.resolver.known(noun)
            ground = [e for e in known if not e.is_uav]
            return ground[0] if len(known) == len(ground) == 1 else None
    return None
