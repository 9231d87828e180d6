# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A quantitative parameter: value, unit, domain, provenance and where the prompt states it."""

from __future__ import annotations

from enum import StrEnum
from typing import Self

from pydantic import FiniteFloat, model_validator

from aurora_core.document import Document


class Provenance(StrEnum):
    """Who chose a value."""

    EXPLICIT = 'explicit'  # the prompt states it; never changed
    INFERRED = 'inferred'  # follows from what the prompt says
    DEFAULT = 'default'  # the contract's default


class Unit(StrEnum):
    """Units inside AURORA: SI, angles in degrees as the contract states them."""

    METRE = 'm'
    SECOND = 's'
    METRE_PER_SECOND = 'm/s'
    METRE_PER_SECOND_SQUARED = 'm/s^2'
    DEGREE = 'deg'
    ONE = '1'


class Bound(StrEnum):
    """How a stated number binds: `exactly 40 m`, `at least 40 m`, `at most 40 m`."""

    EXACTLY = 'exactly'
    AT_LEAST = 'at_least'
    AT_MOST = 'at_most'


class Span(Document):
    """Half-open character range [start, end) of the prompt."""

    start: int
    end: int

    @model_validator(mode='after')
    def _ordered(self) -> Self:
        if not 0 <= self.start < self.end:
            raise ValueError(f'span needs 0 <= start < end, found [{self.start}, {self.end})')
        return self


class Parameter(Document):
    """One number of the request.

    Attributes:
        value: In `unit`.
        unit: SI unit (degrees for angles).
        low: Lower end of the domain inside which repair may move it (same unit).
        high: Upper end.
        provenance: `explicit` values are never changed.
        span: Where the prompt states it; required for explicit values.
        bound: One-sided requests ("at least 40 m").
        approximate: "about 40 m": the tolerance widens to 10 %.
    """

    value: FiniteFloat
    unit: Unit
    low: FiniteFloat
    high: FiniteFloat
    provenance: Provenance
    span: Span | None = None
    bound: Bound = Bound.EXACTLY
    approximate: bool = False

    @model_validator(mode='after')
    def _consistent(self) -> Self:
        if not self.low <= self.high:
            raise ValueError(f'a domain needs low <= high, found [{self.low}, {self.high}]')
        if self.provenance is Provenance.EXPLICIT and self.span is None:
            raise ValueError('an explicit value needs the span of the prompt that states it')
        if self.provenance is not Provenance.EXPLICIT and not self.low <= self.value <= self.high:
            raise ValueError(f'{self.value} {self.unit} is outside [{self.low}, {self.high}]')
        return self

    def inside(self, slack: float) -> float:
        """Return what a plan aims at: the value, inside a one-sided bound by `slack` (`unit`)."""
        if self.bound is Bound.AT_LEAST:
            return self.value + slack
        if self.bound is Bound.AT_MOST:
            return self.value - slack
        return self.value


_SUFFIXES = (
    ('_mps2', Unit.METRE_PER_SECOND_SQUARED),
    ('_mps', Unit.METRE_PER_SECOND),
    ('_deg', Unit.DEGREE),
    ('_m', Unit.METRE),
    ('_s', Unit.SECOND),
)


def unit_of(name: str) -> Unit:
    """Return the unit that the end of a parameter's name says; otherwise it is a pure number."""
    return next((unit for end, unit in _SUFFIXES if name.endswith(end)), Unit.ONE)


class Element(Document):
    """Base of the elements: a parameter has the unit that its field's name says."""

    @model_validator(mode='after')
    def _units_fit_names(self) -> Self:
        for name in type(self).model_fields:
            value = getattr(self, name)
            for parameter in value if isinstance(value, tuple) else (value,):
                if not isinstance(parameter, Parameter):
                    continue
                wanted = self._unit_of(name)
                if parameter.unit is not wanted:
                    raise ValueError(f'{name} is in {wanted}, found {parameter.unit}')
        return self

    def _unit_of(self, name: str) -> Unit:
        """Return the unit of a field that holds a parameter."""
        return unit_of(name)
