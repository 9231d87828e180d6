# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Defaults agree with the shipped limits; stated values are never clipped."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from aurora_core.knowledge.limits import Limits
from aurora_core.parsing import values
from aurora_core.parsing.measures import Measure
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Unit


def _metres(value: float, **more: float) -> Measure:
    return Measure(dimension='length', value=value, start=3, end=7, **more)  # type: ignore[arg-type]


def test_domains_follow_the_limits(limits: Limits) -> None:
    altitude = values.default('altitude')
    assert (altitude.low, altitude.high) == (limits.uav_altitude_min_m, limits.uav_altitude_max_m)
    assert values.default('standoff').high == limits.uav_standoff_max_m
    assert values.default('route_speed').high == limits.uav_speed_max_mps
    assert values.default('mission_duration').high == limits.uav_endurance_s
    assert values.default('ground_speed').high == limits.vehicle_speed_max_mps
    assert values.default('pedestrian_speed').high == limits.pedestrian_speed_max_mps
    assert values.default('scenario_duration').low == limits.duration_min_s
    assert values.default('scenario_duration').high == limits.duration_max_s
    assert values.default('link_range').value == limits.link_range_sight_m


@pytest.mark.parametrize(
    ('name', 'value', 'unit'),
    [
        ('altitude', 30, Unit.METRE),
        ('standoff', 0, Unit.METRE),
        ('pattern_length', 100, Unit.METRE),
        ('pattern_width', 60, Unit.METRE),
        ('waypoint_count', 4, Unit.ONE),
        ('route_speed', 8, Unit.METRE_PER_SECOND),
        ('mission_duration', 30, Unit.SECOND),
        ('placement_distance', 20, Unit.METRE),
        ('link_loss', 0, Unit.ONE),
        ('link_latency', 0.1, Unit.SECOND),
        ('link_retransmissions', 3, Unit.ONE),
        ('link_retransmission_interval', 0.2, Unit.SECOND),
    ],
)
def test_unsaid_values(name: str, value: float, unit: Unit) -> None:
    parameter = values.default(name)
    assert (parameter.value, parameter.unit) == (value, unit)
    assert parameter.provenance is Provenance.DEFAULT


def test_stated_value_outside_its_limits_stays() -> None:
    parameter = values.explicit('altitude', _metres(500.0))
    assert parameter.value == 500.0
    assert parameter.span is not None
    assert (parameter.span.start, parameter.span.end) == (3, 7)


def test_inferred_value_stays_in_its_domain() -> None:
    assert values.inferred('altitude', 500.0).value == 120.0


def test_range_is_free_inside_and_its_ends_are_stated() -> None:
    measure = _metres(30.0, upper=40.0)
    free = values.ranged('altitude', measure)
    assert (free.value, free.low, free.high) == (35.0, 30.0, 40.0)
    assert free.provenance is Provenance.INFERRED
    low, high = values.range_ends('condition_distance', measure)
    assert (low.value, high.value) == (30.0, 40.0)
    assert {low.provenance, high.provenance} == {Provenance.EXPLICIT}


def test_only_the_right_dimension_is_accepted() -> None:
    assert values.accepts('altitude', _metres(30.0))
    assert not values.accepts('mission_duration', _metres(30.0))
    assert not values.accepts('altitude', _metres(30.0, upper=40.0))
    assert not values.accepts('altitude', _metres(30.0, second=40.0))


def test_bound_is_kept_through_validation() -> None:
    parameter = values.rebound(values.explicit('altitude', _metres(60.0)), Bound.AT_MOST)
    assert isinstance(parameter, Parameter)
    assert parameter.bound is Bound.AT_MOST


def test_infinite_values_are_refused() -> None:
    with pytest.raises(ValidationError):
        values.explicit('altitude', _metres(float('inf')))
