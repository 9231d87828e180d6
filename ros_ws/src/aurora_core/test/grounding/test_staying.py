# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A hover without a place is planned where its UAV is then: nowhere that is known before."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.report.said_back import said_back
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.temporal.schedule import plan_time

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]


@pytest.mark.parametrize(
    ('prompt', 'height_m', 'keeps'),
    [
        (
            'A drone tracks a truck at 45 m altitude. When the truck stops, the drone holds its '
            'position for 20 seconds and then lands.',
            45.0,
            True,
        ),
        ('A drone hovers over the ego car at 50 m and then hovers for 15 s at 70 m.', 70.0, False),
        ('A drone flies from City Hall to Harbor Market, then hovers for 20 s.', None, True),
    ],
)
def test_who_hovers_at_no_place_after_another_mission_stays_there_and_as_high(
    read_prompt: Read, ground: Ground, prompt: str, height_m: float | None, keeps: bool
) -> None:
    spec = read_prompt(prompt, 'downtown')
    assert [m.target for m in spec.missions][-1] is None
    before, stays = ground(spec, 'downtown').uavs[0].missions
    assert (stays.hover_point, stays.is_placed, stays.keeps_level) == (None, False, keeps)
    assert stays.altitude_m == (before.altitude_m if height_m is None else height_m)
    if keeps:
        asked = spec.missions[-1].altitude_m
        assert asked.provenance is not Provenance.EXPLICIT
        assert asked.value == spec.missions[0].altitude_m.value
    said = next(one.text for one in said_back(spec) if one.id == stays.id)
    assert said.startswith('uav1 then hovers where it is')


def test_a_first_hover_without_a_place_is_over_the_scene(
    read_prompt: Read, ground: Ground
) -> None:
    spec = read_prompt('A drone hovers at 40 m for 20 s.', 'downtown')
    (mission,) = ground(spec, 'downtown').uavs[0].missions
    assert mission.hover_point is not None
    assert mission.rest_mps is None


def test_its_way_is_none_and_nobody_knows_where_the_next_one_begins(
    read_prompt: Read, ground: Ground, limits: Limits, tolerances: Tolerances
) -> None:
    spec = read_prompt(
        'A drone hovers over City Hall at 60 m for 10 s, then tracks the ego car for 20 s, then '
        'hovers for 10 s.',
        'downtown',
    )
    schedule = plan_time(spec, ground(spec, 'downtown'), limits, tolerances)
    assert schedule.facts.missions[-1].transit_m == 0.0
    assert not schedule.conflict
