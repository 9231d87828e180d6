# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes that compare: `as soon as less than 30 m are left between the car and a pedestrian`.

The words of a condition, in any order, behind `when`: crossing the number is the event.
"""

from __future__ import annotations

import re
from typing import Literal

from aurora_core.parsing import values
from aurora_core.parsing.constructions.distances import DistanceCause
from aurora_core.parsing.constructions.places import place_party
from aurora_core.parsing.criteria.criterion import Criterion, Limit
from aurora_core.parsing.criteria.parties import Parties
from aurora_core.parsing.criteria.slots import criterion
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.scene import Entity
from aurora_core.spec.scenario import (
    BatteryTrigger,
    SpeedTrigger,
    Trigger,
)

_OF_HEIGHT = re.compile(r'\b(?:altitude|height|elevation|agl|above (?:the )?ground)\b')


def threshold(frame: Frame) -> DistanceCause | Trigger | None:
    """Return what the clause waits for, None when it compares nothing or more than one thing."""
    told = criterion(frame.piece.atoms, asked=True)
    if told is None or len(told.limits) != 1 or told.event is not None:
        return None
    if told.hold is not None or told.by is not None or told.share is not None:
        return None
    who = Parties(frame.scene, frame.resolver, told.nouns)
    limit = told.limits[0]
    found: DistanceCause | Trigger | None = None
    if limit.dimension == 'V':
        found = _speed(who, limit)
    elif limit.dimension == 'P' and 'battery' in told.topics:
        found = _battery(who, limit)
    elif limit.dimension == 'L' and not _OF_HEIGHT.search(told.words):
        found = _distance(who, told, limit)
    if found is not None:
        frame.taken()
        for placed in told.placed:
            place_party(frame.resolver, placed)
    return found


def _below(limit: Limit) -> bool:
    return limit.op in ('<', '<=')


def _speed(who: Parties, limit: Limit) -> SpeedTrigger | None:
    last = who.it()
    one = who.actors() or ([last] if last is not None else [])
    if len(one) != 1 or not values.accepts('trigger_speed', limit.measure):
        return None
    on: Literal['speed_below', 'speed_above'] = 'speed_below' if _below(limit) else 'speed_above'
    value = values.explicit('trigger_speed', limit.measure)
    return SpeedTrigger(on=on, who=one[0].id, value_mps=value)


def _battery(who: Parties, limit: Limit) -> BatteryTrigger | None:
    flyers = who.flyers()
    fits = values.accepts('condition_ratio', limit.measure)
    if len(flyers) != 1 or not _below(limit) or not fits:
        return None
    value = values.explicit('condition_ratio', limit.measure)
    return BatteryTrigger(on='battery_below', uav=flyers[0].id, value=value)


def _distance(who: Parties, told: Criterion, limit: Limit) -> DistanceCause | None:
    ends = who.named() or list(who.several() or ())
    if len(ends) == 1 and told.owned:
        other = who.it(avoid=ends)
        ends = [other, *ends] if other is not None else ends
    first = next((e for e in ends if isinstance(e, Entity)), None)
    if len(ends) != 2 or first is None:
        return None
    if not values.accepts('trigger_distance', limit.measure):
        return None
    second = ends[1] if ends[0] is first else ends[0]
    return DistanceCause(
        below=_below(limit),
        a=first,
        b=second if isinstance(second, str) else second.id,
        value_m=values.explicit('trigger_distance', limit.measure),
    )
