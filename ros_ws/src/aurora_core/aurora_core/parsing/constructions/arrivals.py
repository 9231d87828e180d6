# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When somebody has to be somewhere: `must arrive at the station within 90 s`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.constructions.conditions import Op, add_condition
from aurora_core.parsing.constructions.ground import add_behavior
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.pronouns import ground
from aurora_core.parsing.scene import EventDraft
from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import ArrivalTrigger, Behavior
from aurora_core.spec.vocabulary import BehaviorKind

_COMES = frozenset({'reach', 'drive', 'come', 'be', 'walk', 'emergency_run', 'finish'})
_IN_TIME = ('within', 'by', 'before')
_LATEST = re.compile(r'\blatest\b')


def arrival(frame: Frame) -> bool:
    """Read the deadline of an arrival; whether nothing is left that `behavior` has to read."""
    if frame.negated or frame.key not in _COMES:
        return False
    told = next(_told(frame), None)
    found = _time(frame)
    if told is None or found is None:
        return False
    taken, place = told
    adjunct, op = found
    assert adjunct.measure is not None
    who = frame.subjects(ground)
    if len(who) != 1 or who[0].is_uav or not values.accepts('condition_time', adjunct.measure):
        return False
    adjunct.used = True
    made = EventDraft(
        id=frame.scene.new_id('e'),
        trigger=ArrivalTrigger(on='arrives', who=who[0].id, place=place),
        span=frame.span,
    )
    frame.scene.events.append(made)
    frame.scene.became(made.id)
    value = values.explicit('condition_time', adjunct.measure)
    add_condition(frame, 'event_time', (made.id,), op, value)
    if frame.key == 'be':
        taken.used = True
        goes = Behavior(kind=BehaviorKind.DRIVE, target=place, span=frame.span)
        add_behavior(who[0], goes, ())
        return True
    return False


def _told(frame: Frame) -> Iterator[tuple[Adjunct, str]]:
    """Yield where it has to be."""
    phrases = frame.free(AdjunctKind.PHRASE, 'at', 'to', 'in', 'into')
    for adjunct in [*frame.free(AdjunctKind.OBJECT), *phrases, *frame.free(AdjunctKind.PLACE)]:
        for noun in adjunct.nouns:
            place = frame.resolver.place(noun)
            if place is not None:
                yield adjunct, place


def _time(frame: Frame) -> tuple[Adjunct, Op] | None:
    """`within 90 s`, `by t = 90 s`, `no later than 75 s after start`, `75 s … at the latest`."""
    for adjunct in frame.free(AdjunctKind.MEASURE, TIME):
        measure = adjunct.measure
        if measure is None or measure.second is not None or measure.upper is not None:
            continue
        if measure.bound is Bound.AT_MOST or adjunct.prep in _IN_TIME:
            return adjunct, '<='
        if _latest(frame):
            return adjunct, '<='
    return None


def _latest(frame: Frame) -> bool:
    """`at the latest`, `latest`."""
    text = frame.scene.prompt
    for adjunct in frame.adjuncts:
        if adjunct.measure is None and _LATEST.search(text[adjunct.start : adjunct.end].lower()):
            adjunct.used = True
            return True
    return False
