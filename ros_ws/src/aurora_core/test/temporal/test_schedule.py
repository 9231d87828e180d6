# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The schedule quotes the grounded plan: what conditions will be judged by."""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt

import pytest

from aurora_core.judging.build import Inputs
from aurora_core.judging.mission import climb_mps, descent_mps
from aurora_core.knowledge.basis import Basis, Tables
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.settings import Settings
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import PlanFacts, Schedule
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]

PROMPTS = [
    'survey',
    'motorcycle',
    'convoy',
    'tailgate',
    'A drone hovers over the ego car at 50 m and then flies an orbit around the intersection at '
    '40 m.',
    'Three drones track the bus.',
]


@pytest.mark.parametrize('prompt', PROMPTS)
def test_facts_are_those_of_the_plan(
    prompt: str, read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances
) -> None:
    map_name = 'downtown' if prompt == 'survey' else 'junction'
    spec = read_prompt(prompt, map_name)
    found = ground(spec, map_name)
    schedule = plan_time(spec, found, limits, tolerances)
    assert [f.mission for f in schedule.facts.missions] == [m.id for m in spec.missions]
    plans = {m.id: (u, m) for u in found.uavs for m in u.missions}
    for facts in schedule.facts.missions:
        uav, plan = plans[facts.mission]
        assert (facts.uav, facts.mode) == (uav.id, plan.mode)
        assert facts.altitude_m == plan.altitude_m
        assert facts.waypoints == plan.waypoints
        assert facts.hover_point == plan.hover_point
        assert facts.duration_s == plan.duration_s
        assert facts.standoff_m == (plan.standoff_m if plan.mode.value == 'track' else None)
    assert schedule.horizon_s == schedule.facts.horizon_s
    assert schedule.horizon_s >= limits.horizon_inferred_min_s
    assert not schedule.stated_horizon


def test_transit_is_the_way_to_the_first_point(
    read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances
) -> None:
    spec = read_prompt(PROMPTS[4])
    found = ground(spec)
    first, second = plan_time(spec, found, limits, tolerances).facts.missions
    uav = found.uavs[0]
    hover, start = uav.missions[0].hover_point, uav.missions[1].waypoints[0]
    assert hover is not None
    assert first.transit_m == pytest.approx(
        sqrt((hover[0] - uav.home_x_m) ** 2 + (hover[1] - uav.home_y_m) ** 2)
    )
    # The second mission starts where the first one ends.
    assert second.transit_m == pytest.approx(
        sqrt((hover[0] - start[0]) ** 2 + (hover[1] - start[1]) ** 2)
    )
    assert second.transit_speed_mps == 8.0


def test_transit_to_a_target_ends_at_its_offset(
    read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances
) -> None:
    spec = read_prompt('convoy')
    found = ground(spec)
    [facts] = plan_time(spec, found, limits, tolerances).facts.missions
    uav = found.uavs[0]
    plan = uav.missions[0]
    target = next(a for a in found.agents if a.id == plan.target)
    x, y = target.x_m + plan.offset_m[0], target.y_m + plan.offset_m[1]
    assert facts.transit_m == pytest.approx(
        sqrt((x - uav.home_x_m) ** 2 + (y - uav.home_y_m) ** 2)
    )


def test_a_stated_horizon_is_kept(
    read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances
) -> None:
    spec = read_prompt('The scenario lasts 90 seconds. A drone hovers 40 m above the ego car.')
    schedule = plan_time(spec, ground(spec), limits, tolerances)
    assert (schedule.horizon_s, schedule.stated_horizon) == (90.0, True)


def test_canonical_json_round_trip(
    read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances
) -> None:
    spec = read_prompt('survey')
    schedule = plan_time(spec, ground(spec), limits, tolerances)
    again = Schedule.model_validate_json(schedule.canonical_json())
    assert again == schedule
    assert again.canonical_json() == schedule.canonical_json()


def test_rates_are_told_where_the_multirotor_does_less_than_the_limits(
    read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances, settings: Settings
) -> None:
    spec = read_prompt(PROMPTS[2], 'junction')
    found = ground(spec, 'junction')

    def facts(**flight: float) -> PlanFacts:
        changed = Settings.model_validate(
            settings.model_dump() | {'flight': settings.flight.model_dump() | flight}
        )
        tables = Tables(limits=limits, tolerances=tolerances, settings=changed)
        basis = Basis.of('0', tables)
        made = GroundedScenario.model_validate(found.model_dump() | {'basis': basis.model_dump()})
        return plan_time(spec, made, limits, tolerances).facts

    assert facts() == plan_time(spec, found, limits, tolerances).facts
    assert 'climb_mps' not in facts().model_dump()
    slow = facts(climb_mps=2.0, descent_mps=1.0)
    assert (slow.climb_mps, slow.descent_mps) == (1.5, 0.75)
    inputs = Inputs(spec=spec, facts=slow, limits=limits, tolerances=tolerances)
    assert (climb_mps(inputs), descent_mps(inputs)) == (1.5, 0.75)
