# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flown patterns: which one, and its size."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import AtomKind
from aurora_core.parsing.constructions.flight_types import (
    FlightValues,
    noun_target,
    stated_value,
    use,
)
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import COUNT, LENGTH, Measure
from aurora_core.spec.parameter import Parameter, Provenance, Span
from aurora_core.spec.vocabulary import MissionMode, Pattern, Place


def take_pattern_values(frame: Frame, found: FlightValues, pattern: Pattern | None) -> None:
    count = frame.attribute('waypoint')
    if count is not None and count.measure is not None:
        found.waypoint_count = stated_value('waypoint_count', count.measure)
        if found.waypoint_count is not None:
            use(found, count)
    if pattern is None:
        return
    if pattern is Pattern.ORBIT:
        _radius(frame, found)
        _turns(frame, found)
    else:
        _size(frame, found, pattern)


def _turns(frame: Frame, found: FlightValues) -> None:
    """Take `for three laps`, `twice`."""
    adjunct = frame.attribute('turn') or frame.measure(COUNT, '')
    if adjunct is not None and adjunct.measure is not None:
        found.turns = stated_value('turns', adjunct.measure)
        if found.turns is not None:
            use(found, adjunct)


def _radius(frame: Frame, found: FlightValues) -> None:
    for name, scale in (('radius', 1.0), ('diameter', 0.5)):
        adjunct = frame.attribute(name)
        if adjunct is None or adjunct.measure is None:
            continue
        if values.accepts('orbit_radius', adjunct.measure):
            found.radius = values.explicit('orbit_radius', adjunct.measure, scale)
            use(found, adjunct)
            if adjunct.nouns:
                found.target = noun_target(frame, adjunct)


def _size(frame: Frame, found: FlightValues, pattern: Pattern) -> None:
    length, width = frame.attribute('length'), frame.attribute('width')
    if length is not None and length.measure is not None:
        first = stated_value('pattern_length', length.measure)
        second = None
        if width is not None and width.measure is not None:
            second = stated_value('pattern_width', width.measure)
        if first is not None and (second is not None or pattern is Pattern.LINE):
            found.size = (first, second or no_width())
            use(found, length)
            if width is not None and second is not None:
                use(found, width)
            return
    for adjunct in frame.free(AdjunctKind.MEASURE, LENGTH):
        measure = adjunct.measure
        if measure is None or adjunct.prep not in ('', 'of', 'with', 'over', 'in', 'along', 'for'):
            continue
        if measure.second is not None and measure.second_start is not None:
            found.size = _two_sides(measure)
            use(found, adjunct)
            return
        square = _near(frame, adjunct, 'square')
        if measure.upper is None and (pattern is Pattern.LINE or square):
            side = values.explicit('pattern_length', measure)
            found.size = (side, no_width() if pattern is Pattern.LINE else side)
            use(found, adjunct)
            return
    found.square = any(
        a.kind is AdjunctKind.MARK and text_of_adjunct(frame, a).endswith('square')
        for a in frame.adjuncts
    )


def _near(frame: Frame, adjunct: Adjunct, word: str) -> bool:
    """`50 m square`, `a square of 50 m`: the word beside the measure."""
    around = frame.scene.prompt[max(0, adjunct.start - 14) : adjunct.end + 10].lower()
    return word in around


def text_of_adjunct(frame: Frame, adjunct: Adjunct) -> str:
    """Return the words of an adjunct, in lower case."""
    return frame.scene.prompt[adjunct.start : adjunct.end].lower()


def _two_sides(measure: Measure) -> tuple[Parameter, Parameter]:
    assert measure.second is not None
    assert measure.second_start is not None
    first = values.explicit('pattern_length', measure)
    second = Parameter.model_validate(
        first.model_dump()
        | {'value': measure.second, 'span': Span(start=measure.second_start, end=measure.end)}
    )
    return first, second


def no_width() -> Parameter:
    """Return the width of a line."""
    return Parameter(
        value=0.0,
        unit=values.default('pattern_width').unit,
        low=0.0,
        high=0.0,
        provenance=Provenance.INFERRED,
    )


# Prepositions of where a flight leads.
WAYPOINT_PREPS = ('to', 'through', 'via')
_BOTH_WAYS = frozenset(
    {'back and forth', 'to and fro', 'there and back', 'up and down', 'out and back'}
)


def flown_pattern(frame: Frame, mode: MissionMode | None, target: str | None) -> Pattern | None:
    """Return the pattern of a flight, None for one that has none."""
    told = _told_pattern(frame, target)
    if told is not None:
        return told
    if frame.verb is not None and frame.key == 'navigate' and mode is MissionMode.NAVIGATE:
        word = frame.scene.prompt[frame.verb.start : frame.verb.end].lower()
        if word.startswith('mow'):
            return Pattern.LAWNMOWER
    if frame.key == 'orbit':
        return Pattern.ORBIT
    if mode is not MissionMode.NAVIGATE:
        return None
    if frame.attribute('waypoint') is not None or frame.key == 'visit':
        return Pattern.WAYPOINTS
    if frame.attribute('radius', 'diameter') is not None:
        return Pattern.ORBIT  # `a circuit with a radius of 40 m`
    phrases = [a.key for a in frame.adjuncts if a.kind is AdjunctKind.PHRASE and a.used]
    if (
        'around' in phrases
        and not frame.has_mark(AtomKind.ROUTE.value)
        and frame.key != 'navigate'
    ):
        return Pattern.ORBIT
    if 'along' in phrases or target == Place.MAIN_ROAD:
        return Pattern.LINE
    if frame.key in ('fly', 'drive', '') and any(p in WAYPOINT_PREPS for p in phrases):
        return Pattern.WAYPOINTS
    return Pattern.RECTANGLE


def _told_pattern(frame: Frame, target: str | None) -> Pattern | None:
    """Return the pattern that is named; `back and forth` is how a line is flown as well."""
    marks = frame.free(AdjunctKind.MARK, AtomKind.PATTERN.value)
    vague = [m for m in marks if text_of_adjunct(frame, m) in _BOTH_WAYS]
    clear = [m for m in marks if m not in vague]
    if not marks:
        return None
    chosen = (clear or vague)[0]
    for mark in marks:
        mark.used = mark in vague or mark.value == chosen.value
    along = any(a.key == 'along' for a in frame.adjuncts if a.kind is AdjunctKind.PHRASE)
    if not clear and (along or target == Place.MAIN_ROAD):
        return Pattern.LINE
    return Pattern(chosen.value)
