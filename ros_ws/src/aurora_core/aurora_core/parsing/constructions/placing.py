# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who stands where: clauses that place somebody and tell of nothing that he does."""

from __future__ import annotations

from aurora_core.parsing.adjuncts import AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind, NounKind
from aurora_core.parsing.constructions.ground import add_behavior, names_actor, speed_of
from aurora_core.parsing.constructions.places import (
    add_placement,
    placements_of,
)
from aurora_core.parsing.constructions.spacing import column
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.pronouns import ground
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.vocabulary import BehaviorKind, Place, Relation

_PLACING = frozenset({'be', 'put', 'exist', 'contain', 'appear', 'keep', 'start', ''})
_IN_LINE = (Relation.AHEAD, Relation.BEHIND, Relation.SAME_LANE, Relation.ADJACENT_LANE)


def placing(frame: Frame) -> bool:
    """`a bus is 20 m ahead of the ego`, `put a van behind it`, `an ambulance behind it`."""
    if frame.negated or frame.key not in _PLACING:
        return False
    nouns = frame.subject_nouns
    if not nouns or all(n.kind is NounKind.PRONOUN and n.key == 'there' for n in nouns):
        lead = next((a for a in frame.free(AdjunctKind.OBJECT) if names_actor(a)), None)
        if lead is not None:
            lead.used = True
            nouns = lead.nouns
    elif frame.key == 'contain':
        return False
    if not nouns and frame.piece.head is not None and frame.piece.head.noun is not None:
        nouns = (frame.piece.head.noun,)
    nouns = tuple(n for n in nouns if n.kind in ACTORS)
    if nouns:
        subjects = frame.resolver.actors(nouns, accept=ground)
    else:
        subjects = frame.inherited(ground) if frame.verb is not None else ()
    if not subjects or any(e.is_uav for e in subjects):
        return False
    frame.scene.clause.subjects = subjects
    column(frame, subjects, kept=False)
    placements = placements_of(frame, subjects, kept=False)
    speed = speed_of(frame)
    _on_one_road(frame, placements)
    for entity in subjects:
        for placement in placements:
            if placement.of != entity.id:
                add_placement(entity, placement)
        if speed is not None:
            made = Behavior(kind=BehaviorKind.DRIVE, speed_mps=speed, span=frame.span)
            add_behavior(entity, made, ())
    if frame.key == 'keep' and not placements and speed is None:
        return False
    if frame.has_mark(AtomKind.UNKNOWN.value) and not placements and frame.verb is not None:
        return False
    frame.scene.became(*(e.id for e in subjects))
    return True


def _on_one_road(frame: Frame, placements: tuple[Placement, ...]) -> None:
    """`A is 35 m ahead of B on the main road`: then B is on it as well."""
    roads = [p for p in placements if p.relation is Relation.ON and p.of == Place.MAIN_ROAD]
    for placement in placements:
        other = frame.scene.by_id(placement.of or '')
        if roads and other is not None and placement.relation in _IN_LINE:
            add_placement(other, roads[0])
