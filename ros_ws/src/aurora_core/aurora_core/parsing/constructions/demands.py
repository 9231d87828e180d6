# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions that hang on a clause: shares of the time, seconds in view, distances, deadlines.

They stand alone (`visible at least 80 % of the time`) or behind something else (`…, keeping at
least 8 m between them`), so they are read last, from what the other constructions left.
"""

from __future__ import annotations

import re

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, AtomKind, NounKind
from aurora_core.parsing.constructions.conditions import Op, add_condition
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import LENGTH, RATIO, TIME
from aurora_core.parsing.scene import Entity, LinkDraft
from aurora_core.spec.parameter import Bound

_SEEN = re.compile(r'\b(visible|seen|sees?|view|sight|visibility|in frame)\b')
_TRACKED = re.compile(r'\btrack')
_DELIVERED = re.compile(r'\b(deliver|arriv|receiv|get through|gets through)')
_APART = re.compile(
    r'\b(apart|each other|one another|separation|of another|each pair|any two|'
    r'between (?:them|the two|(?:the )?(?:two )?(?:drones|uavs|copters|aircraft)))\b'
)
_CLOSER = re.compile(
    r'\b(nearer|closer)(?:\s+(?:together|to (?:each other|one another)))?\s+than\s*$'
)
_STRICT = re.compile(r'(less than|under|below|quicker than|faster than|<)\s*$')
_UNBROKEN = re.compile(
    r'\b(without (?:interruption|a break)|uninterrupted|consecutive|in one go|at a stretch)'
)
_MOST = re.compile(r'\b(max(?:imum|imal)?|limit(?:ed)?|at most)\b')
# `within 60 s of that` and `then lands within 60 s` do not count from the start.
_THEN = re.compile(r'\b(?:then|afterwards?|thereafter|after (?:that|this)),?\s*$')
_OF_THAT = re.compile(r'\s+(?:of|after|from|following)\s+(?:that|this|it)\b')
_ENDS = re.compile(r'\b(on the ground|landed|lands?|down)\b')


def demands(frame: Frame) -> None:
    """Take every such condition of a clause."""
    readers = (_share, _separation, _keeps_off, _seen_for, _deadline, _told_within, _drift)
    for reader in readers:
        reader(frame)


def _text(frame: Frame) -> str:
    return frame.scene.prompt[frame.piece.start : frame.piece.end].lower()


def _in_front(frame: Frame, adjunct: Adjunct) -> str:
    """Return the words of the clause in front of the number."""
    end = adjunct.measure.start if adjunct.measure is not None else adjunct.start
    return frame.scene.prompt[frame.piece.start : end].lower()


def _named(frame: Frame) -> list[Entity]:
    """Return the actors that the clause names, subjects first."""
    found = list(frame.scene.clause.subjects)
    for noun in frame.nouns():
        if noun.kind in ACTORS and noun.kind is not NounKind.PRONOUN:
            found += [e for e in frame.resolver.known(noun) if e not in found]
    return found


def _observer(frame: Frame) -> Entity | None:
    """Return the UAV that the clause names, else the only one."""
    flying = [e for e in _named(frame) if e.is_uav] or frame.scene.uavs
    return flying[0] if len(flying) == 1 else None


def _watched(frame: Frame, observer: Entity) -> str | None:
    """Return what the clause names besides the UAV, else what the UAV is about."""
    agents = [e.id for e in _named(frame) if not e.is_uav]
    targets = [m.target for m in frame.scene.missions_of(observer) if m.target is not None]
    found = agents or targets[-1:]
    return found[0] if found else None


def _share(frame: Frame) -> None:
    """`visible at least 80 % of the time`, `tracked properly for 85 %`."""
    adjunct = frame.measure(RATIO)
    if adjunct is None or adjunct.measure is None:
        return
    if not values.accepts('condition_ratio', adjunct.measure):
        return
    text = _text(frame)
    op: Op = '<=' if adjunct.measure.bound is Bound.AT_MOST else '>='
    value = values.explicit('condition_ratio', adjunct.measure)
    if _DELIVERED.search(text):
        link = _link(frame)
        if link is not None and link.sender and link.receiver:
            adjunct.used = True
            add_condition(frame, 'delivery_ratio', (link.sender, link.receiver), op, value)
        return
    quantity = 'visible_fraction' if _SEEN.search(text) else 'tracked_fraction'
    observer = _observer(frame)
    target = _watched(frame, observer) if observer is not None else None
    if observer is None or target is None:
        return
    if quantity == 'tracked_fraction' and not _TRACKED.search(text):
        return
    adjunct.used = True
    _clear(frame, AtomKind.IN_VIEW.value)
    add_condition(frame, quantity, (observer.id, target), op, value)


def _clear(frame: Frame, kind: str) -> None:
    for mark in frame.free(AdjunctKind.MARK, kind):
        mark.used = True


def _separation(frame: Frame) -> None:
    """`at least 8 m between them`, `they must never come within 10 m of each other`."""
    adjunct = _length(frame)
    if adjunct is None or adjunct.measure is None or not _APART.search(_text(frame)):
        return
    named = [e for e in _named(frame) if e.is_uav]
    flying = named if len(named) > 1 else frame.scene.uavs
    they = all(n.kind is NounKind.PRONOUN for n in frame.subject_nouns)
    grouped = they and len(flying) > 1 and all(e.group is not None for e in flying)
    on_ground = [e for e in frame.scene.clause.subjects if not e.is_uav and not grouped]
    if len(flying) < 2 or on_ground or not values.accepts('condition_distance', adjunct.measure):
        return
    near = adjunct.prep in ('within', 'below') or adjunct.measure.bound is Bound.AT_MOST
    adjunct.used = True
    for mark in frame.free(AdjunctKind.MARK, 'thing'):
        mark.used = mark.value in ('separation', 'gap', 'standoff')
    for phrase in frame.free(AdjunctKind.PHRASE, 'between', 'of', 'to', 'from'):
        phrase.used = True
        frame.objects([n for n in phrase.nouns if n.kind is NounKind.UAV])
    add_condition(
        frame,
        'separation',
        tuple(e.id for e in flying),
        '<=' if near and not frame.negated else '>=',
        values.explicit('condition_distance', adjunct.measure),
    )


def _length(frame: Frame) -> Adjunct | None:
    for adjunct in frame.free(AdjunctKind.ATTRIBUTE, 'separation', 'gap', 'standoff', 'away'):
        return adjunct
    return frame.length()


def keeps_off(frame: Frame, adjunct: Adjunct) -> bool:
    """Return whether a length is a least distance: `never nearer than 15 m`."""
    measure = adjunct.measure
    if measure is None:
        return False
    near = frame.scene.prompt[frame.piece.start : measure.start].lower()
    told = measure.bound is Bound.AT_LEAST or (adjunct.prep == 'within' and frame.negated)
    return told and _CLOSER.search(near) is not None


def _keeps_off(frame: Frame) -> None:
    """`never nearer than 15 m`, `must not come closer than 20 m to the bus`."""
    for adjunct in frame.free(AdjunctKind.ATTRIBUTE, 'away', 'gap', 'standoff') + frame.free(
        AdjunctKind.MEASURE, LENGTH
    ):
        measure = adjunct.measure
        if measure is None or not keeps_off(frame, adjunct):
            continue
        observer = _who_keeps_off(frame)
        if observer is None or not values.accepts('condition_distance', measure):
            continue
        named = [n for n in adjunct.nouns if n.kind in ACTORS]
        others = [e.id for e in frame.resolver.actors(named, exclude=(observer,), as_object=True)]
        behind = frame.scene.prompt[measure.end : frame.piece.end].split()
        for phrase in frame.free(AdjunctKind.PHRASE, 'to') if not others else ():
            place = next((p for n in phrase.nouns for p in [frame.resolver.place(n)] if p), None)
            if place is not None:
                phrase.used = True
                others = [place]
        if not others and behind[:1] != ['to']:
            others = [one for one in (_watched(frame, observer),) if one is not None]
        if not others:
            continue  # `to either`: of whom is not read
        adjunct.used = True
        value = values.explicit('condition_distance', measure)
        for other in others:
            add_condition(frame, 'distance', (observer.id, other), '>=', value)
        return


def _who_keeps_off(frame: Frame) -> Entity | None:
    acting = frame.scene.clause.subjects or (frame.subjects() if frame.subject_nouns else ())
    return acting[0] if len(acting) == 1 else _observer(frame)


def _seen_for(frame: Frame) -> None:
    """`we want to see the cyclist for at least 25 s`."""
    if frame.key != 'see' or frame.negated:
        return
    adjunct = frame.time('for', '')
    observer = _observer(frame)
    if adjunct is None or adjunct.measure is None or observer is None:
        return
    for named in frame.free(AdjunctKind.OBJECT):
        named.used = bool(frame.objects([n for n in named.nouns if n.kind in ACTORS]))
    agents = [e.id for e in frame.scene.clause.objects if not e.is_uav]
    target = agents[0] if agents else _watched(frame, observer)
    if target is None or not values.accepts('condition_time', adjunct.measure):
        return
    adjunct.used = True
    value = values.explicit('condition_time', adjunct.measure)
    hold = value if _UNBROKEN.search(_text(frame)) else None
    add_condition(frame, 'visible_time', (observer.id, target), '>=', value, hold=hold)


def seen_for(frame: Frame) -> bool:
    """Read `must see the ego for 15 s` before it could be taken for a phase."""
    before = len(frame.scene.conditions)
    if frame.key == 'see' and frame.subjects() and frame.free(AdjunctKind.OBJECT):
        _seen_for(frame)
    return len(frame.scene.conditions) > before


def _deadline(frame: Frame) -> None:
    """`must be on the ground by 120 s`, `is to be finished after at most 12 minutes`."""
    text = _text(frame)
    ends = frame.key == 'finish' or (frame.key in ('land', 'be', '') and _ENDS.search(text))
    if not ends or frame.negated:
        return
    observer = _observer(frame)
    for adjunct in frame.free(AdjunctKind.MEASURE, TIME):
        measure = adjunct.measure
        if measure is None or observer is None:
            return
        late = measure.bound is Bound.AT_MOST and adjunct.prep in ('', 'after', 'in')
        if not (late or adjunct.prep in ('by', 'within', 'before')):
            continue
        ahead = frame.scene.prompt[: frame.piece.start].lower()
        behind = frame.scene.prompt[measure.end :].lower()
        counts = _THEN.search(ahead) is None and _OF_THAT.match(behind) is None
        if not counts or not values.accepts('condition_time', measure):
            continue
        adjunct.used = True
        add_condition(
            frame,
            'landed',
            (observer.id,),
            '==',
            values.inferred('condition_ratio', 1.0),
            by=values.explicit('condition_time', measure),
        )
        return


def _told_within(frame: Frame) -> None:
    """`reports this to the police car within 3 s`."""
    named = frame.key == '' and _DELIVERED.search(_text(frame))  # `loss 5 %, delivery within 1 s`
    denied = frame.negated and frame.key in ('last', 'be', 'come', 'contain')
    arrives = frame.key in ('receive', 'reach', 'come', 'be', 'contain', 'last', 'overtake') and (
        frame.has_mark(AtomKind.MESSAGE.value) or _about_message(frame)
    )
    if not (named or arrives or frame.key in ('alert', 'send', 'report')):
        return
    if frame.negated and not (denied and arrives):
        return
    adjunct = frame.time('within')
    link = _link(frame)
    if adjunct is None or adjunct.measure is None or link is None:
        return
    if not values.accepts('condition_time', adjunct.measure) or not link.sender:
        return
    assert link.receiver is not None
    adjunct.used = True
    for mark in frame.free(AdjunctKind.MARK, AtomKind.MESSAGE.value):
        mark.used = True
    if arrives:
        frame.subjects()
        for taken in frame.free(AdjunctKind.OBJECT):
            taken.used = True
    value = values.explicit('condition_time', adjunct.measure)
    op: Op = '<' if _STRICT.search(_in_front(frame, adjunct)) else '<='
    add_condition(frame, 'delivery_latency', (link.sender, link.receiver), op, value)


def _about_message(frame: Frame) -> bool:
    """`the car must get it within 1 s`: the message that was told before."""
    told = frame.scene.links and any(e.action for e in frame.scene.events)
    nouns = [n for n in frame.nouns() if n.kind is NounKind.PRONOUN and n.key == 'it']
    return (
        bool(told) and bool(nouns) and frame.key in ('receive', 'come', 'reach', 'last', 'contain')
    )


def _drift(frame: Frame) -> None:
    """`it must not drift more than 3 m`."""
    observer = _observer(frame)
    named = frame.attribute('drift')
    if named is None and frame.has_mark('thing', 'drift'):
        near = frame.length('within', 'below', 'at', '')
        if near is not None and near.measure is not None:
            bound = near.prep in ('within', 'below') or near.measure.bound is Bound.AT_MOST
            named = near if bound or frame.negated else None
    if named is not None and named.measure is not None and observer is not None:
        if values.accepts('condition_distance', named.measure):
            named.used = True
            frame.mark('thing', 'drift')
            value = values.explicit('condition_distance', named.measure)
            add_condition(frame, 'hover_drift', (observer.id,), '<=', value)
        return
    adjunct = frame.length() or frame.attribute('altitude')
    if frame.key != 'drift' or observer is None or adjunct is None or adjunct.measure is None:
        return
    bounded = adjunct.measure.bound is Bound.AT_MOST or adjunct.prep in ('within', 'below')
    if not (frame.negated or bounded or _MOST.search(_text(frame))):
        return
    if not values.accepts('condition_distance', adjunct.measure):
        return
    adjunct.used = True
    value = values.explicit('condition_distance', adjunct.measure)
    add_condition(frame, 'hover_drift', (observer.id,), '<=', value)


def _link(frame: Frame) -> LinkDraft | None:
    """Return the link of the clause, else the last one with two ends."""
    owned = [link for link in frame.scene.links if link.sender and link.receiver]
    of_clause = [link for link in owned if link.id in frame.scene.clause.ids]
    found = of_clause or owned
    return found[-1] if found else None
