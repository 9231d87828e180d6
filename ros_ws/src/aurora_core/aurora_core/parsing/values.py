# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters: stated, inferred or by default, each with its domain."""

from __future__ import annotations

from functools import lru_cache

from aurora_core.document import Document
from aurora_core.parsing.data_files import read_data
from aurora_core.parsing.measure import (
    ACCELERATION,
    ANGLE,
    COUNT,
    LENGTH,
    RATE,
    RATIO,
    SPEED,
    TIME,
    Measure,
)
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span, Unit

_DIMENSIONS = {
    Unit.METRE: (LENGTH, COUNT),
    Unit.SECOND: (TIME,),
    Unit.METRE_PER_SECOND: (SPEED,),
    Unit.METRE_PER_SECOND_SQUARED: (ACCELERATION,),
    Unit.DEGREE: (ANGLE, COUNT),
    Unit.ONE: (RATIO, COUNT, RATE),
}


class DefaultValue(Document):
    """One line of `defaults.yaml`."""

    value: float
    unit: Unit
    low: float
    high: float


@lru_cache(maxsize=1)
def _table() -> dict[str, DefaultValue]:
    return {
        name: DefaultValue.model_validate(line)
        for name, line in read_data('defaults.yaml').items()
    }


def unsaid_values() -> dict[str, float]:
    """Return the value of everything that a prompt may leave unsaid; SI, angles in degrees."""
    return {name: line.value for name, line in _table().items()}


def accepts(name: str, measure: Measure) -> bool:
    """Return whether a measure has the dimension of the parameter and is one number."""
    return (
        measure.dimension in _DIMENSIONS[_table()[name].unit]
        and measure.upper is None
        and measure.second is None
    )


def default(name: str) -> Parameter:
    """Return the value that stands for what the prompt leaves unsaid."""
    line = _table()[name]
    return Parameter(
        value=line.value,
        unit=line.unit,
        low=line.low,
        high=line.high,
        provenance=Provenance.DEFAULT,
    )


def inferred(name: str, value: float, span: Span | None = None) -> Parameter:
    """Return a value that follows from the prompt without being stated; clipped to its domain."""
    line = _table()[name]
    return Parameter(
        value=min(max(value, line.low), line.high),
        unit=line.unit,
        low=line.low,
        high=line.high,
        provenance=Provenance.INFERRED,
        span=span,
    )


def explicit(name: str, measure: Measure, scale: float = 1.0) -> Parameter:
    """Return a stated value as it was stated, inside its limits or not."""
    line = _table()[name]
    return Parameter(
        value=measure.value * scale,
        unit=line.unit,
        low=line.low,
        high=line.high,
        provenance=Provenance.EXPLICIT,
        span=Span(start=measure.start, end=measure.end),
        bound=measure.bound,
        approximate=measure.approximate,
    )


def stated(name: str, value: float, start: int, end: int) -> Parameter:
    """Return a value that words state without a number (`north`, `no retries`)."""
    line = _table()[name]
    return Parameter(
        value=value,
        unit=line.unit,
        low=line.low,
        high=line.high,
        provenance=Provenance.EXPLICIT,
        span=Span(start=start, end=end),
    )


def ranged(name: str, measure: Measure) -> Parameter:
    """Return the middle of a stated range, free inside the range."""
    assert measure.upper is not None
    return Parameter(
        value=(measure.value + measure.upper) / 2,
        unit=_table()[name].unit,
        low=measure.value,
        high=measure.upper,
        provenance=Provenance.INFERRED,
        span=Span(start=measure.start, end=measure.end),
    )


def range_ends(name: str, measure: Measure) -> tuple[Parameter, Parameter]:
    """Return both ends of a stated range, as stated."""
    assert measure.upper is not None
    low = explicit(name, measure)
    return low, Parameter.model_validate(low.model_dump() | {'value': measure.upper})


def bounded(parameter: Parameter, prep: str) -> Parameter:
    """Return a parameter as a preposition bounds it: `less than 40 m`, `beyond 20 m`."""
    bound = {'below': Bound.AT_MOST, 'within': Bound.AT_MOST, 'beyond': Bound.AT_LEAST}.get(prep)
    return parameter if bound is None else rebound(parameter, bound)


def rebound(parameter: Parameter, bound: Bound) -> Parameter:
    """Return the same stated value, one-sided."""
    return Parameter.model_validate(parameter.model_dump() | {'bound': bound})
