# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every rule of a parameter, broken once."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span, Unit

_STATED: dict[str, Any] = {
    'value': 40.0,
    'unit': Unit.METRE,
    'low': 3.0,
    'high': 120.0,
    'provenance': Provenance.EXPLICIT,
    'span': Span(start=2, end=6),
}


def test_stated_value_may_lie_outside_its_domain() -> None:
    assert Parameter.model_validate(_STATED | {'value': 500.0}).value == 500.0


@pytest.mark.parametrize('provenance', [Provenance.INFERRED, Provenance.DEFAULT])
@pytest.mark.parametrize('value', [2.9, 120.1])
def test_chosen_value_stays_in_its_domain(provenance: Provenance, value: float) -> None:
    with pytest.raises(ValidationError, match='outside'):
        Parameter.model_validate(_STATED | {'provenance': provenance, 'value': value})


@pytest.mark.parametrize('value', [3.0, 120.0])
def test_ends_of_the_domain_are_inside(value: float) -> None:
    chosen = Parameter.model_validate(
        _STATED | {'provenance': Provenance.DEFAULT, 'value': value, 'span': None}
    )
    assert chosen.bound is Bound.EXACTLY


def test_stated_value_needs_its_place() -> None:
    with pytest.raises(ValidationError, match='span'):
        Parameter.model_validate(_STATED | {'span': None})


@pytest.mark.parametrize('field', ['value', 'low', 'high'])
@pytest.mark.parametrize('number', [float('nan'), float('inf')])
def test_no_infinities(field: str, number: float) -> None:
    with pytest.raises(ValidationError):
        Parameter.model_validate(_STATED | {field: number})


def test_unknown_fields_are_refused() -> None:
    with pytest.raises(ValidationError, match='extra'):
        Parameter.model_validate(_STATED | {'tolerance': 1.0})


def test_frozen() -> None:
    parameter = Parameter.model_validate(_STATED)
    with pytest.raises(ValidationError, match='frozen'):
        parameter.value = 41.0


@pytest.mark.parametrize(('start', 'end'), [(3, 3), (4, 3), (-1, 2)])
def test_span_has_an_order(start: int, end: int) -> None:
    with pytest.raises(ValidationError, match='span'):
        Span(start=start, end=end)


def test_json_round_trip_is_exact() -> None:
    parameter = Parameter.model_validate(_STATED | {'value': 15.24, 'approximate': True})
    assert Parameter.model_validate_json(parameter.model_dump_json()) == parameter
