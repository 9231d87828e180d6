# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Several UAVs fly at different altitudes unless the prompt says otherwise."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.planning.complete import layered
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import (
    Event,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode

Make = Callable[..., Parameter]


def _spec(make: Make, *altitudes: tuple[str, float, bool]) -> ScenarioSpec:
    missions = tuple(
        UavMission(
            id=f'm{k}',
            uav=uav,
            mode=MissionMode.TRACK,
            target='a',
            altitude_m=make(height, explicit=explicit),
            standoff_m=make(0.0, explicit=False),
            duration_s=make(30.0, 's', explicit=False),
        )
        for k, (uav, height, explicit) in enumerate(altitudes)
    )
    uavs = tuple(Uav(id=u) for u in sorted({a[0] for a in altitudes}))
    agents = (GroundAgent(id='a', type=AgentType.CAR),)
    return ScenarioSpec(prompt='x', agents=agents, uavs=uavs, missions=missions)


def _heights(spec: ScenarioSpec) -> list[float]:
    return [m.altitude_m.value for m in spec.missions]


def test_free_altitudes_are_stacked(parameter: Make, limits: Limits) -> None:
    spec = _spec(parameter, ('u1', 30.0, False), ('u2', 30.0, False), ('u3', 30.0, False))
    assert _heights(layered(spec, limits)) == [30.0, 40.0, 50.0]
    assert _heights(spec) == [30.0, 30.0, 30.0]


def test_who_is_told_something_is_lowest(parameter: Make, limits: Limits) -> None:
    spec = _spec(parameter, ('u1', 30.0, False), ('u2', 30.0, False))
    tell = SendMessage(do='send_message', sender='u1', receiver='u2')
    spec = spec.model_copy(update={'events': (Event(id='e1', action=tell),)})
    assert _heights(layered(spec, limits)) == [40.0, 30.0]


def test_stated_altitudes_stay_and_the_others_make_room(parameter: Make, limits: Limits) -> None:
    spec = _spec(parameter, ('u1', 30.0, False), ('u2', 35.0, True), ('u3', 35.0, True))
    assert _heights(layered(spec, limits)) == [50.0, 35.0, 35.0]


def test_missions_of_one_uav_do_not_push_each_other(parameter: Make, limits: Limits) -> None:
    spec = _spec(parameter, ('u1', 30.0, False), ('u1', 30.0, False), ('u2', 30.0, False))
    assert _heights(layered(spec, limits)) == [30.0, 30.0, 40.0]


def test_without_room_below_the_limit_nothing_moves(parameter: Make, limits: Limits) -> None:
    spec = _spec(parameter, ('u1', 115.0, True), ('u2', 115.0, False))
    assert _heights(layered(spec, limits)) == [115.0, 115.0]


def test_one_uav_is_left_alone(read_prompt: Callable[..., ScenarioSpec], limits: Limits) -> None:
    spec = read_prompt('convoy')
    assert layered(spec, limits) == spec


def test_uavs_over_the_same_target_are_grounded_apart(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
) -> None:
    found = ground(read_prompt('Three drones track the bus.', 'junction'), 'junction')
    assert len(found.uavs) == 3
    for a, b in combinations(found.uavs, 2):
        for first in a.missions:
            for second in b.missions:
                assert abs(first.altitude_m - second.altitude_m) >= limits.separation_min_m
        apart = (a.home_x_m - b.home_x_m) ** 2 + (a.home_y_m - b.home_y_m) ** 2
        assert apart >= limits.separation_min_m**2
    rows = {r.path: r for r in found.realised if r.path.endswith('altitude_m')}
    assert sorted(r.realised for r in rows.values()) == [30.0, 40.0, 50.0]
    assert all(r.requested == r.realised for r in rows.values())
