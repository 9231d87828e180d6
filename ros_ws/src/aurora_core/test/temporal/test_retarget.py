# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Triggers that nobody states are put in reach of the grounding; stated ones stay."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any

import pytest

from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.triggers import as_realised
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.retarget import Between, retargeted

Make = Callable[..., tuple[ScenarioSpec, GroundedScenario]]

TAILGATE = 'tailgate'  # the van begins 45 m behind the ego
HOVER = 'A drone hovers over City Hall at 50 m. The bus brakes when the drone is at 40 m.'
DRIVES = 'A car drives at 12 m/s. A van brakes when the car is faster than 8 m/s.'
DATED = 'The scenario lasts 60 s. The bus brakes at 20 s.'


@pytest.fixture
def made(
    read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> Make:
    """Return a request whose first trigger is changed, beside the grounding of its prompt."""

    def make(prompt: str, **trigger: Any) -> tuple[ScenarioSpec, GroundedScenario]:
        spec = read_prompt(prompt)
        document = spec.model_dump()
        document['events'][0]['trigger'] |= trigger
        return ScenarioSpec.model_validate(document), ground(spec)

    return make


def number(value: float, unit: str = 'm', provenance: str = 'default') -> dict[str, Any]:
    span = {'start': 0, 'end': 1} if provenance == 'explicit' else None
    given = {'value': value, 'unit': unit, 'low': 0.0, 'high': 500.0}
    return {**given, 'provenance': provenance, 'span': span}


def value(spec: ScenarioSpec, name: str = 'value_m') -> float:
    found: float = getattr(spec.events[0].trigger, name).value
    return found


def apart_m(grounded: GroundedScenario, a: str, b: str) -> float:
    at = {agent.id: agent for agent in grounded.agents}
    return hypot(at[a].x_m - at[b].x_m, at[a].y_m - at[b].y_m)


def realised(spec: ScenarioSpec, grounded: GroundedScenario, limits: Limits) -> ScenarioSpec:
    return as_realised(spec, retargeted(spec, grounded, limits))


def test_a_distance_that_is_there_from_the_start_moves_inside(made: Make, limits: Limits) -> None:
    spec, grounded = made(TAILGATE, value_m=number(60.0))
    start_m = apart_m(grounded, 'van1', 'ego')
    assert start_m < 60.0
    moved = retargeted(spec, grounded, limits)
    [row] = [r for r in moved.realised if 'trigger' in r.path]
    assert (row.path, row.requested) == ('events/e1/trigger/value_m', 60.0)
    assert row.realised == pytest.approx(start_m - 2.0)
    assert value(as_realised(spec, moved)) == row.realised
    assert value(spec) == 60.0  # what was asked for is not touched
    assert retargeted(spec, moved, limits) == moved


def test_a_distance_that_bodies_do_not_come_to_moves_out(made: Make, limits: Limits) -> None:
    spec, grounded = made(TAILGATE, value_m=number(1.0))
    lengths = {a.id: a.length_m for a in grounded.agents}
    nearest = (lengths['van1'] + lengths['ego']) / 2.0
    assert value(realised(spec, grounded, limits)) == pytest.approx(nearest + 2.0)


def test_a_uav_stays_as_far_away_as_it_is_high(made: Make, limits: Limits) -> None:
    spec, grounded = made(TAILGATE, a='uav1', b='van1', value_m=number(10.0))
    [uav] = grounded.uavs
    far = uav.model_copy(update={'home_x_m': uav.home_x_m + 300.0})
    plan = uav.missions[0]
    near = value(realised(spec, grounded.model_copy(update={'uavs': (far,)}), limits))
    assert near == pytest.approx(hypot(plan.altitude_m, plan.standoff_m) + 2.0)


def test_a_distance_that_is_to_grow_begins_above_the_first_one(made: Make, limits: Limits) -> None:
    spec, grounded = made(TAILGATE, on='distance_above', value_m=number(20.0))
    start_m = apart_m(grounded, 'van1', 'ego')
    assert value(realised(spec, grounded, limits)) == pytest.approx(start_m + 2.0)


def test_a_height_above_the_flight_moves_down(made: Make, limits: Limits) -> None:
    spec, grounded = made(HOVER, value_m=number(80.0))
    assert value(realised(spec, grounded, limits)) == 48.0


def test_a_speed_above_the_stated_one_moves_down(made: Make, limits: Limits) -> None:
    spec, grounded = made(DRIVES, value_mps=number(20.0, 'm/s'))
    assert value(realised(spec, grounded, limits), 'value_mps') == 10.0


def test_a_time_after_the_stated_duration_moves_inside(made: Make, limits: Limits) -> None:
    spec, grounded = made(DATED, at_s=number(90.0, 's'))
    assert value(realised(spec, grounded, limits), 'at_s') == 30.0


@pytest.mark.parametrize(
    ('prompt', 'trigger'),
    [
        (TAILGATE, {'value_m': number(60.0, provenance='explicit')}),
        (TAILGATE, {'value_m': number(60.0, provenance='inferred')}),
        (TAILGATE, {'value_m': number(20.0)}),  # neither met nor out of reach
        (TAILGATE, {'value_m': {**number(60.0), 'low': 50.0}}),  # its domain is above
        (HOVER, {'value_m': number(80.0, provenance='explicit')}),
        (DATED, {'at_s': number(90.0, 's', 'explicit')}),
    ],
)
def test_what_is_stated_or_in_reach_stays(
    prompt: str, trigger: dict[str, Any], made: Make, limits: Limits
) -> None:
    spec, grounded = made(prompt, **trigger)
    moved = retargeted(spec, grounded, limits)
    assert moved == grounded
    assert as_realised(spec, moved) is spec


def test_where_nothing_lies_between_a_trigger_stays() -> None:
    assert Between(30.0, 20.0).near(25.0) == 25.0
    assert [Between(20.0, 30.0).near(v) for v in (10.0, 25.0, 40.0)] == [20.0, 25.0, 30.0]


def test_a_recording_cannot_move_what_is_stated(made: Make, limits: Limits) -> None:
    spec, grounded = made(TAILGATE, value_m=number(60.0))
    moved = retargeted(spec, grounded, limits)
    stated, _ = made(TAILGATE, value_m=number(60.0, provenance='explicit'))
    assert as_realised(stated, moved) is stated
    narrow, _ = made(TAILGATE, value_m={**number(60.0), 'low': 55.0})
    assert as_realised(narrow, moved) is narrow
