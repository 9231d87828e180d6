# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Of two that drive one behind the other: the front one and the rear one."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atoms import NounPhrase
from aurora_core.parsing.scene import Entity
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import Relation

_FRONT = frozenset({'front', 'leading', 'lead', 'preceding'})
_REAR = frozenset({'rear', 'trailing', 'back', 'following'})
# Labels that tell which of two is meant by where it is.
SIDES = _FRONT | _REAR


def front_or_rear(noun: NounPhrase, known: Sequence[Entity]) -> Entity | None:
    """Return which of two `the front car` is; the first of a pair drives ahead of the second."""
    if len(known) != 2 or any(e.is_uav for e in known) or not noun.labels & SIDES:
        return None
    front, rear = known
    if front.group is None:
        return None
    if not front.placements:
        front.placements.append(Placement(relation=Relation.AHEAD, of=rear.id))
    return front if noun.labels & _FRONT else rear
