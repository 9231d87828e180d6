# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Default altitudes and standoffs lie inside what a request states of them."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any

import pytest

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.planning.bounds import bent
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    Event,
    GroundAgent,
    Placement,
    ScenarioSpec,
    StatedCondition,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode, Pattern, Relation, Side

Make = Callable[..., Parameter]
LIMITS = load_limits(config_path('limits.json'))


def _spec(make: Make, *conditions: dict[str, Any], stated: bool = False, **more: Any) -> Any:
    mission = UavMission(
        id='m1',
        uav='uav1',
        mode=MissionMode.TRACK,
        target='van1',
        altitude_m=make(30.0, explicit=stated),
        standoff_m=make(0.0, explicit=stated),
        duration_s=make(30.0, 's'),
    )
    return ScenarioSpec(
        prompt='x',
        agents=tuple(GroundAgent(id=name, type=AgentType.VAN) for name in ('van1', 'ego')),
        uavs=(Uav(id='uav1'),),
        missions=(mission,),
        conditions=tuple(
            StatedCondition(id=f'c{k}', **fields) for k, fields in enumerate(conditions)
        ),
        **more,
    )


def _flown(spec: ScenarioSpec) -> tuple[float, float]:
    (mission,) = bent(spec, LIMITS).missions
    assert mission.standoff_m is not None
    return mission.altitude_m.value, mission.standoff_m.value


def _says(make: Make, quantity: str, op: str, metres: float, *of: str) -> dict[str, Any]:
    value = make(metres, explicit=True)
    return {'quantity': quantity, 'of': of or ('uav1',), 'op': op, 'value': value}


@pytest.mark.parametrize(
    ('bounds', 'low', 'high'),
    [
        ([('<=', 25.0)], 20.0, 24.0),
        ([('>=', 45.0)], 46.0, 50.0),
        ([('>=', 60.0), ('<=', 64.0)], 61.0, 63.0),
        ([('>=', 10.0)], 30.0, 30.0),
        ([('<=', 1.0)], 3.0, 3.0),  # nobody flies that low
    ],
)
def test_an_altitude_that_nobody_states_is_inside_its_bounds(
    parameter: Make, bounds: list[tuple[str, float]], low: float, high: float
) -> None:
    said = (_says(parameter, 'altitude', op, metres) for op, metres in bounds)
    assert low <= _flown(_spec(parameter, *said))[0] <= high


def test_stated_numbers_stay(parameter: Make) -> None:
    low = _says(parameter, 'altitude', '<=', 25.0)
    far = _says(parameter, 'horizontal_distance', '>=', 50.0, 'uav1', 'van1')
    assert _flown(_spec(parameter, low, far, stated=True)) == (30.0, 0.0)


def test_a_least_distance_sets_the_standoff(parameter: Make) -> None:
    plane = _says(parameter, 'horizontal_distance', '>=', 50.0, 'uav1', 'van1')
    assert 55.0 <= _flown(_spec(parameter, plane))[1] <= 65.0
    space = _says(parameter, 'distance', '>=', 50.0, 'van1', 'uav1')
    altitude_m, standoff_m = _flown(_spec(parameter, space))
    assert 55.0 <= hypot(altitude_m, standoff_m) <= 65.0
    of_others = _says(parameter, 'distance', '>=', 50.0, 'van1', 'ego')
    assert _flown(_spec(parameter, of_others)) == (30.0, 0.0)


@pytest.mark.parametrize(('low_m', 'away_m'), [(None, (20.0, 20.0)), (50.0, (55.0, 65.0))])
def test_a_side_is_kept_from_20_m_unless_the_request_says_more(
    parameter: Make, low_m: float | None, away_m: tuple[float, float]
) -> None:
    says = [] if low_m is None else [_says(parameter, 'distance', '>=', low_m, 'uav1', 'van1')]
    spec = _beside(_spec(parameter, *says))
    altitude_m, standoff_m = _flown(spec)
    assert away_m[0] <= (standoff_m if low_m is None else hypot(altitude_m, standoff_m))
    assert standoff_m <= away_m[1]
    near = _says(parameter, 'horizontal_distance', '<=', 12.0, 'uav1', 'van1')
    assert _flown(_beside(_spec(parameter, near)))[1] == 10.0
    assert _flown(_beside(_spec(parameter, stated=True)))[1] == 0.0


def _beside(spec: ScenarioSpec) -> ScenarioSpec:
    missions = tuple(m.model_copy(update={'side': Side.LEFT}) for m in spec.missions)
    return spec.model_copy(update={'missions': missions})


def test_a_greatest_distance_brings_it_down(parameter: Make) -> None:
    near = _says(parameter, 'distance', '<=', 25.0, 'uav1', 'van1')
    altitude_m, standoff_m = _flown(_spec(parameter, near))
    assert 10.0 <= altitude_m <= 20.0
    assert standoff_m == 0.0


def test_a_greatest_distance_leaves_it_above_the_least_altitude(parameter: Make) -> None:
    near = _says(parameter, 'distance', '<=', 50.0, 'uav1', 'van1')
    high = _says(parameter, 'altitude', '>=', 40.0)
    altitude_m, standoff_m = _flown(_spec(parameter, near, high))
    # At the end of its ascent, 2 m lower, it is above the bound as well.
    assert 42.0 < altitude_m < 50.0
    assert standoff_m == 0.0


def test_an_altitude_that_an_event_waits_for_is_passed(parameter: Make) -> None:
    reached = AltitudeTrigger(
        on='altitude_reached', uav='uav1', value_m=parameter(55.0, explicit=True)
    )
    events = (Event(id='e1', trigger=reached),)
    assert 55.0 < _flown(_spec(parameter, events=events))[0] <= 58.0
    assert _flown(_spec(parameter, events=events, stated=True))[0] == 30.0


@pytest.mark.parametrize(
    ('op', 'bound', 'low', 'high'), [('<=', 5.0, 3.0, 4.5), ('>=', 10.0, 10.5, 12.0)]
)
def test_a_speed_that_nobody_states_is_inside_its_bounds(
    parameter: Make, op: str, bound: float, low: float, high: float
) -> None:
    speed = parameter(8.0, 'm/s', explicit=False).model_copy(update={'low': 2.0, 'high': 15.0})
    route = UavMission(
        id='m1',
        uav='uav1',
        mode=MissionMode.NAVIGATE,
        altitude_m=parameter(30.0),
        speed_mps=speed,
        pattern=Pattern.ORBIT,
        radius_m=parameter(30.0),
    )
    value = parameter(bound, 'm/s', explicit=True)
    asked = StatedCondition.model_validate(
        {'id': 'c1', 'quantity': 'speed', 'of': ('uav1',), 'op': op, 'value': value}
    )
    spec = ScenarioSpec(prompt='x', uavs=(Uav(id='uav1'),), missions=(route,), conditions=(asked,))
    (mission,) = bent(spec, LIMITS).missions
    assert mission.speed_mps is not None
    assert low <= mission.speed_mps.value <= high


@pytest.mark.parametrize(('seen_s', 'lasts_s'), [(8.0, 30.0), (20.0, 60.0), (50.0, 120.0)])
def test_a_duration_that_nobody_states_has_room_for_a_time_of_sight(
    parameter: Make, seen_s: float, lasts_s: float
) -> None:
    asked = {
        'quantity': 'visible_time',
        'of': ('uav1', 'van1'),
        'op': '>=',
        'value': parameter(seen_s, 's'),
    }
    spec = _spec(parameter, asked)
    (mission,) = spec.missions
    free = parameter(30.0, 's', explicit=False).model_copy(update={'low': 10.0, 'high': 120.0})
    open_ = mission.model_copy(update={'duration_s': free})
    (made,) = bent(spec.model_copy(update={'missions': (open_,)}), LIMITS).missions
    assert made.duration_s is not None
    assert made.duration_s.value == lasts_s
    (said,) = bent(spec, LIMITS).missions
    assert said.duration_s is not None
    assert said.duration_s.value == 30.0


def test_several_who_are_overtaken_stand_one_before_the_other(parameter: Make) -> None:
    def behind(other: str, metres: float, *, stated: bool = False) -> Placement:
        gap = parameter(metres, explicit=stated)
        return Placement(relation=Relation.BEHIND, of=other, distance_m=gap)

    def gaps(*placements: Placement) -> list[float]:
        agents = [GroundAgent(id=name, type=AgentType.CAR) for name in ('car1', 'car2', 'car3')]
        ego = GroundAgent(id='ego', type=AgentType.CAR, placements=placements)
        (*_, found) = bent(ScenarioSpec(prompt='x', agents=(*agents, ego)), LIMITS).agents
        return [p.distance_m.value for p in found.placements if p.distance_m is not None]

    first, second, third = gaps(behind('car1', 20.0), behind('car2', 20.0), behind('car3', 20.0))
    assert first == 20.0
    assert second - first >= 20.0
    assert third - second >= 20.0
    assert gaps(behind('car1', 20.0), behind('car2', 25.0, stated=True)) == [20.0, 25.0]
