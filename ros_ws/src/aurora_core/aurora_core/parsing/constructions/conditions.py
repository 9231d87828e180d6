# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions that the prompt states: `stays within 20 m of`, `never goes above 60 m`."""

from __future__ import annotations

import re
from itertools import takewhile
from typing import Literal

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind
from aurora_core.parsing.criteria.parties import left_out_before
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import RATIO
from aurora_core.parsing.scene import Entity
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import StatedCondition
from aurora_core.spec.vocabulary import MissionMode

_ALWAYS = re.compile(r'\b(the whole time|all the time|at all times|always|the entire time)\b')
_MUST = ('must', 'should', 'shall', 'have to', 'need to', 'be to', 'be required to')
Op = Literal['<=', '<', '>=', '>', '==']
_STAYING = frozenset(
    {'', 'keep', 'be', 'fly', 'drive', 'track', 'follow', 'hover', 'come', 'trail'}
)


def condition(frame: Frame) -> bool:
    """Read a clause that is nothing but a condition."""
    readers = (_latency, _limit, _in_view, _delivery)
    # Without a predicate the place comes first: `a child on the sidewalk within 20 m of it`.
    return any(reader(frame) for reader in readers) or (bool(frame.key) and _near(frame))


def add_condition(
    frame: Frame,
    quantity: str,
    of: tuple[str, ...],
    op: Op,
    value: Parameter,
    *,
    hold: Parameter | None = None,
    by: Parameter | None = None,
) -> None:
    """Add a stated condition to the scene."""
    made = StatedCondition(
        id=frame.scene.new_id('c'),
        quantity=quantity,
        of=of,
        op=op,
        value=value,
        hold_s=hold,
        by_s=by,
        span=frame.span,
    )
    frame.scene.conditions.append(made)
    frame.scene.became(made.id)


def _near(frame: Frame) -> bool:
    """`stays within 20 m of the bus`, `keeps at least 10 m away from it`."""
    if frame.negated or frame.key not in _STAYING:
        return False
    for adjunct in frame.free(AdjunctKind.ATTRIBUTE, 'away', 'gap', 'standoff'):
        measure = adjunct.measure
        if measure is None or not values.accepts('condition_distance', measure):
            continue
        near = adjunct.prep in ('within', 'below') or measure.bound is Bound.AT_MOST
        far = adjunct.prep == 'beyond' or measure.bound is Bound.AT_LEAST
        if not (near or far) or not adjunct.nouns:
            continue
        subjects = frame.subjects()
        other = _reference(frame, adjunct)
        if len(subjects) != 1 or other is None:
            continue
        adjunct.used = True
        _track_it(frame, subjects[0], other)
        lasts = frame.time('for')
        hold = None
        if lasts is not None and lasts.measure is not None:
            lasts.used = True
            hold = values.explicit('condition_time', lasts.measure)
        told = frame.scene.prompt[frame.piece.start : frame.piece.end].lower()
        add_condition(
            frame,
            'horizontal_distance' if 'horizontal' in told else 'distance',
            (subjects[0].id, other),
            '<=' if near else '>=',
            values.explicit('condition_distance', measure),
            hold=hold,
        )
        return True
    return False


def _track_it(frame: Frame, subject: Entity, other: str) -> None:
    """The clause's own mission may have named the target only here."""
    for draft in frame.scene.missions_of(subject)[-1:]:
        if draft.needs_target and draft.mode is MissionMode.TRACK and draft.target is None:
            draft.target, draft.needs_target = other, False


def _reference(frame: Frame, adjunct: Adjunct) -> str | None:
    for noun in adjunct.nouns:
        place = frame.resolver.place(noun)
        if place is not None:
            frame.scene.clause.places += (place,)
            return place
    found = frame.objects([n for n in adjunct.nouns if n.kind in ACTORS])
    return found[0].id if found else None


def _latency(frame: Frame) -> bool:
    """`the latency must not exceed 300 ms`: asked of the messages, no property of the link."""
    must = any(a.kind is AtomKind.AUXILIARY and a.key in _MUST for a in frame.piece.atoms)
    marks = frame.free(AdjunctKind.MARK, 'thing')
    named = [m for m in marks if m.value == 'latency']
    value = frame.attribute('latency') or (frame.time('', 'below', 'within') if named else None)
    exceeds = frame.key == 'exceed' and frame.negated
    if not (must or exceeds) or value is None or value.measure is None:
        return False
    below = value.prep in ('below', 'within') or value.measure.bound is Bound.AT_MOST
    owned = [link for link in frame.scene.links if link.sender and link.receiver]
    if not (exceeds or (below and not frame.negated)) or not owned:
        return False
    if not values.accepts('condition_time', value.measure):
        return False
    for taken in (value, *named):
        taken.used = True
    link = owned[-1]
    assert link.sender is not None
    assert link.receiver is not None
    limit = values.explicit('condition_time', value.measure)
    add_condition(frame, 'delivery_latency', (link.sender, link.receiver), '<=', limit)
    return True


def _limit(frame: Frame) -> bool:
    """`never goes above 60 m`, `must not exceed 10 m/s`, `stays below 60 m`."""
    upper = frame.key == 'exceed' and frame.negated
    lower = frame.key == 'fall_below' and frame.negated
    if frame.key in ('keep', 'fly', 'be', 'drive') and not frame.negated:
        preps = {a.prep for a in frame.adjuncts if not a.used and a.measure is not None}
        upper = bool(preps & {'below', 'within'})
        lower = 'beyond' in preps or (frame.key == 'keep' and frame.length('over') is not None)
    if upper == lower:
        return False
    if frame.has_mark('thing', 'gap', 'standoff', 'separation', 'drift'):
        return False
    op: Op = '<=' if upper else '>='
    speed = frame.attribute('speed')
    if speed is not None and speed.measure is not None:
        return _each(frame, 'speed', op, speed, 'condition_speed')
    height = frame.attribute('altitude')
    if height is None and not _is_cut_off(frame):
        height = frame.length('', 'below', 'beyond', 'within', 'over')
    if height is not None and height.measure is not None and not height.nouns:
        subjects = frame.subjects(lambda e: e.is_uav)
        if subjects:
            return _each(frame, 'altitude', op, height, 'condition_distance')
    return False


def _is_cut_off(frame: Frame) -> bool:
    """`its wobble, …, must not be more than 2 m`: what is compared stands in front of an aside."""
    ahead = takewhile(lambda a: a.kind is not AtomKind.VERB, frame.piece.atoms)
    if any(a.kind is AtomKind.UNKNOWN for a in ahead):
        return True  # `its yaw must not exceed 2 m`
    if any(n.head_text in ('its', 'their', 'his', 'her') for n in frame.subject_nouns):
        return True
    return not frame.subject_nouns and left_out_before(frame.scene.prompt, frame.piece.start)


def _each(frame: Frame, quantity: str, op: Op, adjunct: Adjunct, name: str) -> bool:
    subjects = frame.subjects()
    if not subjects or adjunct.measure is None or not values.accepts(name, adjunct.measure):
        return False
    adjunct.used = True
    for entity in subjects:
        add_condition(frame, quantity, (entity.id,), op, values.explicit(name, adjunct.measure))
    return True


def _in_view(frame: Frame) -> bool:
    """`keeps the bus in view for at least 20 s`."""
    if (
        frame.key not in ('keep', 'see', 'be')
        or frame.negated
        or not frame.has_mark(AtomKind.IN_VIEW.value)
        or frame.measure(RATIO) is not None  # a stated share is read with the other shares
    ):
        return False
    pair = _watcher_and_watched(frame)
    if pair is None:
        return False
    observer, target = pair
    frame.mark(AtomKind.IN_VIEW.value)
    span_time = frame.time('for', '')
    if span_time is not None and span_time.measure is not None:
        if not values.accepts('condition_time', span_time.measure):
            return False
        span_time.used = True
        add_condition(
            frame,
            'visible_time',
            (observer.id, target),
            '>=',
            values.explicit('condition_time', span_time.measure),
        )
        return True
    add_condition(
        frame,
        'visible_fraction',
        (observer.id, target),
        '>=',
        _all_the_time(frame) or values.default('condition_ratio'),
    )
    return True


def _all_the_time(frame: Frame) -> Parameter | None:
    """`keeps the bus in sight the whole time`: a share of one."""
    start = frame.piece.start
    found = _ALWAYS.search(frame.scene.prompt[start : frame.piece.end].lower())
    if found is None:
        return None
    return values.stated('condition_ratio', 1.0, start + found.start(), start + found.end())


def _watcher_and_watched(frame: Frame) -> tuple[Entity, str] | None:
    """`the drone keeps the bus in view`, `the bus stays visible`."""
    taken = frame.free(AdjunctKind.OBJECT)
    if taken:
        observers = frame.subjects(lambda e: e.is_uav)
        target = _reference(frame, taken[0])
        if len(observers) != 1 or target is None:
            return None
        taken[0].used = True
        return observers[0], target
    seen = frame.subjects(lambda e: not e.is_uav)
    if len(seen) != 1 or len(frame.scene.uavs) != 1:
        return None
    return frame.scene.uavs[0], seen[0].id


def _delivery(frame: Frame) -> bool:
    """`the alert must arrive within 1 s`."""
    if frame.key not in ('reach', 'receive', 'come', 'last') or frame.negated:
        return False
    owned = [link for link in frame.scene.links if link.sender and link.receiver]
    limit = frame.time('within', 'below', 'in', '')
    told = frame.has_mark(AtomKind.MESSAGE.value) or _goes_on_about_a_message(frame)
    if not owned or not told:
        return False
    if limit is None:
        return False
    if limit.measure is None:
        return False
    if not values.accepts('condition_time', limit.measure):
        return False
    limit.used = True
    for mark in frame.free(AdjunctKind.MARK, AtomKind.MESSAGE.value):
        mark.used = True
    for adjunct in frame.free(AdjunctKind.OBJECT) + frame.free(AdjunctKind.PHRASE, 'at', 'to'):
        adjunct.used = bool(frame.objects([n for n in adjunct.nouns if n.kind in ACTORS]))
    link = owned[-1]
    assert link.sender is not None
    assert link.receiver is not None
    if frame.mark(AtomKind.FROM_START.value) is not None:  # a moment, not how long it takes
        one = values.inferred('condition_ratio', 1.0)
        ends, by = (link.sender, link.receiver), values.explicit('condition_time', limit.measure)
        add_condition(frame, 'delivered', ends, '==', one, by=by)
        return True
    add_condition(
        frame,
        'delivery_latency',
        (link.sender, link.receiver),
        '<' if _is_strict(frame, limit) else '<=',
        values.explicit('condition_time', limit.measure),
    )
    return True


def _is_strict(frame: Frame, limit: Adjunct) -> bool:
    """`less than 2 s` leaves the value itself out."""
    assert limit.measure is not None
    before = frame.scene.prompt[frame.piece.start : limit.measure.start].lower().rstrip()
    return before.endswith(('less than', 'under', 'below'))


def _goes_on_about_a_message(frame: Frame) -> bool:
    """`the alert is sent at 20 s and must reach us …`: the message is the subject of both."""
    if frame.subject_nouns or len(frame.scene.clauses) < 2:
        return False
    before = [c for c in frame.scene.clauses[:-1] if c.sentence == frame.piece.sentence]
    return any(i.startswith('link') for c in before for i in c.ids)
