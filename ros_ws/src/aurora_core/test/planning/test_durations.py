# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Default durations make room for the times that conditions state; stated ones stay."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.planning.complete import lasting
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    EventDoneTrigger,
    GroundAgent,
    ScenarioSpec,
    SendMessage,
    StatedCondition,
    TimeTrigger,
    Uav,
    UavMission,
    World,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode

Make = Callable[..., Parameter]
HALL, PARK = 'landmark:City Hall', 'landmark:Meadow Park'


def _spec(
    make: Make, *, stated: bool = False, world: World | None = None, **said: Any
) -> ScenarioSpec:
    missions = tuple(
        UavMission(
            id=f'm{k}',
            uav='uav1',
            mode=MissionMode.HOVER,
            target=target,
            altitude_m=make(50.0),
            duration_s=make(30.0, 's', explicit=stated),
        )
        for k, target in enumerate((HALL, PARK))
    )
    fields = {'id': 'c1', 'of': ('uav1', HALL), 'op': '>='} | said
    return ScenarioSpec(
        prompt='x',
        world=world or World(),
        uavs=(Uav(id='uav1'),),
        missions=missions,
        conditions=(StatedCondition(**fields),),
    )


def _lengths(spec: ScenarioSpec) -> list[float]:
    return [m.duration_s.value for m in lasting(spec).missions if m.duration_s is not None]


def test_a_time_of_sight_needs_a_longer_phase_of_that_target(parameter: Make) -> None:
    spec = _spec(parameter, quantity='visible_time', value=parameter(60.0, 's'))
    assert _lengths(spec) == [75.0, 30.0]  # a quarter more than 60 s


def test_a_stretch_needs_a_longer_phase(parameter: Make) -> None:
    spec = _spec(
        parameter,
        of=('uav1',),
        quantity='altitude',
        value=parameter(45.0),
        hold_s=parameter(40.0, 's'),
    )
    # It is about no target: which phase it holds in is open.
    assert _lengths(spec) == [50.0, 50.0]


def test_stated_lengths_stay(parameter: Make) -> None:
    spec = _spec(parameter, stated=True, quantity='visible_time', value=parameter(60.0, 's'))
    assert _lengths(spec) == [30.0, 30.0]


def test_a_scenario_of_stated_length_has_no_room_to_spare(parameter: Make) -> None:
    world = World(duration_s=parameter(120.0, 's'))
    spec = _spec(parameter, world=world, quantity='visible_time', value=parameter(60.0, 's'))
    assert _lengths(spec) == [60.0, 30.0]


@pytest.mark.parametrize(('asked_s', 'op'), [(20.0, '>='), (60.0, '<=')])
def test_what_fits_changes_nothing(asked_s: float, op: str, parameter: Make) -> None:
    spec = _spec(parameter, quantity='visible_time', value=parameter(asked_s, 's'), op=op)
    assert _lengths(spec) == [30.0, 30.0]


def test_no_phase_gets_longer_than_its_domain(parameter: Make) -> None:
    spec = _spec(parameter, quantity='visible_time', value=parameter(1e6, 's'))
    high = spec.missions[0].duration_s
    assert high is not None
    assert _lengths(spec)[0] == high.high


def test_who_is_to_send_at_a_stated_time_has_not_landed_by_then(parameter: Make) -> None:
    spec = _spec(parameter, quantity='altitude', of=('uav1',), value=parameter(45.0))
    ego = GroundAgent(id='ego', type=AgentType.CAR)
    spec = spec.model_copy(update={'agents': (ego,)})
    stop = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(60.0, 's')),
        action=AgentAction(do='stop', agent='ego'),
    )
    told = Event(
        id='e2',
        trigger=EventDoneTrigger(on='event_done', event='e1', after_s=parameter(3.0, 's')),
        action=SendMessage(do='send_message', sender='uav1', receiver='ego'),
        delay_s=parameter(1.0, 's'),
    )
    assert _lengths(spec.model_copy(update={'events': (stop,)})) == [30.0, 30.0]
    # A quarter more than 64 s, in the last phase.
    assert _lengths(spec.model_copy(update={'events': (stop, told)})) == [30.0, 80.0]
    # Who wait for each other have no time.
    after_told = EventDoneTrigger(on='event_done', event='e2')
    loop = (stop.model_copy(update={'trigger': after_told}), told)
    assert _lengths(spec.model_copy(update={'events': loop})) == [30.0, 30.0]
