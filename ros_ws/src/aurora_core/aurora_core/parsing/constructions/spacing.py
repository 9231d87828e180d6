# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far ground agents are apart, told beside where they are.

`three cars one behind the other, 10 m apart`; `the gap between them is 12 m`.
"""

from __future__ import annotations

import re
from itertools import pairwise

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import IN_A_ROW, Adjunct, AdjunctKind
from aurora_core.parsing.atoms import NounKind
from aurora_core.parsing.constructions.places import DISTANT, add_placement, is_throughout
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.scene import Entity
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import Relation

_COLUMN = re.compile(r'\b(?:queue|line|row|column|convoy|platoon|string|procession|file) of\b')


def column(frame: Frame, subjects: tuple[Entity, ...], *, kept: bool) -> None:
    """`four trucks in a column with gaps of 12 m`: each behind the one that is named before."""
    if len(subjects) < 2 or any(e.is_uav for e in subjects):
        return
    word = next((a for a in frame.free(AdjunctKind.PLACE, 'behind') if _in_a_row(frame, a)), None)
    told = frame.scene.prompt[frame.piece.start : frame.piece.end].lower()
    if word is None and not _COLUMN.search(told):
        return
    gap = frame.attribute('gap', 'separation')
    distance = word.measure if word is not None else None
    distance = distance or (gap.measure if gap is not None else None)
    if word is None and distance is None:
        return
    if distance is not None and not values.accepts('placement_distance', distance):
        return
    apart = (
        values.default('placement_distance')
        if distance is None
        else values.explicit('placement_distance', distance)
    )
    for before, entity in pairwise(subjects):
        placement = Placement(
            relation=Relation.BEHIND,
            of=before.id,
            distance_m=apart,
            kept_in_motion=kept or is_throughout(frame),
            throughout=is_throughout(frame),
            span=frame.span,
        )
        add_placement(entity, placement)
    for adjunct in (word, gap):
        if adjunct is not None:
            adjunct.used = True
    _between_them(frame)


def _in_a_row(frame: Frame, adjunct: Adjunct) -> bool:
    words = frame.scene.prompt[adjunct.start : adjunct.end].lower()
    return not adjunct.nouns and words.endswith(IN_A_ROW)


def _between_them(frame: Frame) -> None:
    """`12 m between each`: of whom the clause is."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'between'):
        adjunct.used = all(n.kind is NounKind.PRONOUN for n in adjunct.nouns)


def fill_in(about: tuple[Entity, ...], ids: set[str] | None, distance: Parameter) -> bool:
    """Give the distance to the first placement that has none; of a pair, if one is named."""
    for entity in about:
        for i, known in enumerate(entity.placements):
            open_end = known.distance_m is None or known.distance_m.span is None
            if known.relation in DISTANT and open_end and ids in (None, {entity.id, known.of}):
                told = known.model_dump() | {'distance_m': distance}
                entity.placements[i] = Placement.model_validate(told)
                return True
    return False
