# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The size of a flown pattern: waypoints, radius, sides."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.constructions.flight_types import (
    FlightValues,
    noun_target,
    stated_value,
    use,
)
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import COUNT, LENGTH, Measure
from aurora_core.spec.parameter import Parameter, Provenance, Span
from aurora_core.spec.vocabulary import Pattern


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
