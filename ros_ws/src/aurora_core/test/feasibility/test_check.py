# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A stated number beyond a limit is refused with a certificate; one at the limit is inside."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import pytest

from aurora_core.feasibility.limits import check_limits
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.feasibility import Certificate, Feasibility
from aurora_core.recheck import recheck
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    Behavior,
    Event,
    GroundAgent,
    Link,
    ScenarioSpec,
    StatedCondition,
    Uav,
    UavAction,
    UavMission,
    World,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, MissionMode, Pattern

Make = Callable[..., Parameter]


def _mission(make: Make, **changes: Any) -> ScenarioSpec:
    fields: dict[str, Any] = {
        'id': 'm1',
        'uav': 'uav1',
        'mode': MissionMode.TRACK,
        'target': 'car1',
        'altitude_m': make(30.0),
        'standoff_m': make(0.0),
        'duration_s': make(30.0, 's'),
    }
    return ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='car1', type=AgentType.CAR),),
        uavs=(Uav(id='uav1'),),
        missions=(UavMission(**(fields | changes)),),
    )


def _route(make: Make, speed: Parameter) -> ScenarioSpec:
    return _mission(
        make,
        mode=MissionMode.NAVIGATE,
        standoff_m=None,
        duration_s=None,
        pattern=Pattern.LINE,
        speed_mps=speed,
    )


def _agent(kind: AgentType, speed: Parameter) -> ScenarioSpec:
    behavior = Behavior(kind=BehaviorKind.DRIVE, speed_mps=speed)
    return ScenarioSpec(
        prompt='x', agents=(GroundAgent(id='a1', type=kind, behaviors=(behavior,)),)
    )


def _link(make: Make, loss: Parameter) -> ScenarioSpec:
    return ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='a1', type=AgentType.CAR),),
        uavs=(Uav(id='uav1'),),
        links=(
            Link(
                id='l1',
                sender='uav1',
                receiver='a1',
                loss=loss,
                latency_s=make(0.1, 's'),
                retransmissions=make(3.0, '1'),
                retransmission_interval_s=make(0.2, 's'),
            ),
        ),
    )


def _event(**parts: Any) -> ScenarioSpec:
    return ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='a1', type=AgentType.CAR),),
        uavs=(Uav(id='uav1'),),
        events=(Event(id='e1', **parts),),
    )


def _lasting(duration: Parameter) -> ScenarioSpec:
    waits = Behavior(kind=BehaviorKind.WAIT, duration_s=duration)
    agent = GroundAgent(id='a1', type=AgentType.CAR, behaviors=(waits,))
    return ScenarioSpec(prompt='x', agents=(agent,))


# name -> (builds a specification from the parameter, unit, low, high, reason, path)
PLACES: dict[str, tuple[Callable[[Make, Parameter], ScenarioSpec], str, Any, Any, str, str]] = {
    'altitude': (
        lambda make, p: _mission(make, altitude_m=p),
        'm', 3.0, 120.0, 'altitude_limit', 'missions/m1/altitude_m',
    ),
    'standoff': (
        lambda make, p: _mission(make, standoff_m=p),
        'm', 0.0, 150.0, 'standoff', 'missions/m1/standoff_m',
    ),
    'route speed': (
        _route, 'm/s', 0.0, 18.0, 'speed_limit', 'missions/m1/speed_mps',
    ),
    'mission duration': (
        lambda make, p: _mission(make, duration_s=p),
        's', 0.0, 1500.0, 'endurance', 'missions/m1/duration_s',
    ),
    'car': (
        lambda _make, p: _agent(AgentType.CAR, p),
        'm/s', 0.0, 50.0, 'speed_limit', 'agents/a1/behaviors/0/speed_mps',
    ),
    'pedestrian': (
        lambda _make, p: _agent(AgentType.PEDESTRIAN, p),
        'm/s', 0.0, 3.0, 'speed_limit', 'agents/a1/behaviors/0/speed_mps',
    ),
    'duration of a behaviour': (
        lambda _make, p: _lasting(p),
        's', None, 1800.0, 'duration', 'agents/a1/behaviors/0/duration_s',
    ),
    'horizon': (
        lambda _make, p: ScenarioSpec(prompt='x', world=World(duration_s=p)),
        's', 5.0, 1800.0, 'duration', 'world/duration_s',
    ),
    'wind': (
        lambda _make, p: ScenarioSpec(prompt='x', world=World(wind_mps=p)),
        'm/s', 0.0, 15.0, 'speed_limit', 'world/wind_mps',
    ),
    'altitude trigger': (
        lambda _make, p: _event(
            trigger=AltitudeTrigger(on='altitude_reached', uav='uav1', value_m=p)
        ),
        'm', None, 120.0, 'altitude_limit', 'events/e1/trigger/value_m',
    ),
    'ascend action': (
        lambda _make, p: _event(action=UavAction(do='ascend', uav='uav1', altitude_m=p)),
        'm', 3.0, 120.0, 'altitude_limit', 'events/e1/action/altitude_m',
    ),
    'slow action': (
        lambda _make, p: _event(action=AgentAction(do='slow', agent='a1', value_mps=p)),
        'm/s', 0.0, 50.0, 'speed_limit', 'events/e1/action/value_mps',
    ),
}  # fmt: skip
EDGES = [
    (name, edge)
    for name, place in PLACES.items()
    for edge, value in (('low', place[2]), ('high', place[3]))
    if value is not None
]


def _certificates(spec: ScenarioSpec, limits: Limits) -> tuple[Certificate, ...]:
    verdict = check_limits(spec, limits)
    assert (verdict.result is Feasibility.INFEASIBLE) == bool(verdict.certificates)
    return verdict.certificates


@pytest.mark.parametrize(('name', 'edge'), EDGES)
def test_inside_at_and_outside_of_a_limit(
    name: str, edge: str, limits: Limits, parameter: Make
) -> None:
    build, unit, low, high, reason, path = PLACES[name]
    limit = low if edge == 'low' else high
    outward = -math.inf if edge == 'low' else math.inf
    assert not _certificates(build(parameter, parameter(limit, unit)), limits)
    inside = math.nextafter(limit, -outward)
    assert not _certificates(build(parameter, parameter(inside, unit)), limits)
    outside = math.nextafter(limit, outward)
    [found] = _certificates(build(parameter, parameter(outside, unit)), limits)
    assert (found.reason, found.path) == (reason, path)
    assert (found.kind, found.requested, found.unit) == ('limit_exceeded', outside, unit)
    assert found.limit == limit
    assert found.span is not None
    assert ('at least' if edge == 'low' else 'at most') in found.sentence
    assert found.limit_name in found.sentence


@pytest.mark.parametrize(('name', 'edge'), EDGES)
def test_one_sided_requests(name: str, edge: str, limits: Limits, parameter: Make) -> None:
    """ "At most 150 m" can be met below a limit of 120 m, "at least 150 m" cannot."""
    build, unit, low, high, _, _ = PLACES[name]
    value = low - 1.0 if edge == 'low' else high + 1.0
    meets = Bound.AT_LEAST if edge == 'low' else Bound.AT_MOST
    clashes = Bound.AT_MOST if edge == 'low' else Bound.AT_LEAST
    assert not _certificates(build(parameter, parameter(value, unit, bound=meets)), limits)
    assert _certificates(build(parameter, parameter(value, unit, bound=clashes)), limits)


def test_only_what_the_prompt_states_is_refused(limits: Limits, parameter: Make) -> None:
    chosen = parameter(500.0, explicit=False)
    assert not _certificates(_mission(parameter, altitude_m=chosen), limits)


@pytest.mark.parametrize(
    ('loss', 'refused'), [(0.0, False), (0.999, False), (1.0, True), (1.5, True), (-0.1, True)]
)
def test_a_link_that_loses_all_is_refused(
    loss: float, refused: bool, limits: Limits, parameter: Make
) -> None:
    found = _certificates(_link(parameter, parameter(loss, '1')), limits)
    assert len(found) == int(refused)
    if refused:
        assert found[0].reason == 'comm_range'
        assert ('below 1' if loss >= 1.0 else 'at least 0') in found[0].sentence


def test_a_link_that_is_to_lose_all_may_do_so(limits: Limits, parameter: Make) -> None:
    """`The loss is 100 percent, so nothing arrives`: an outcome that was asked for."""
    lossy = _link(parameter, parameter(1.0, '1'))
    refused = _certificates(lossy, limits)[0]
    for of, value, left in (
        (('uav1', 'a1'), 0.0, 0),
        (('a1', 'uav1'), 0.0, 1),
        (('uav1', 'a1'), 1.0, 1),
    ):
        asked = StatedCondition(
            id='c1', quantity='delivered', of=of, op='==', value=parameter(value, '1')
        )
        spec = lossy.model_copy(update={'conditions': (asked,)})
        assert len(_certificates(spec, limits)) == left
        assert recheck(refused, spec.model_dump(mode='json')).valid is bool(left)


def test_a_type_that_cannot_go_so_fast(
    limits: Limits, parameter: Make, agent_types: Mapping[str, AgentTypeRecord]
) -> None:
    top = agent_types['bus'].max_speed_mps
    assert top < limits.vehicle_speed_max_mps
    slow = _agent(AgentType.BUS, parameter(top, 'm/s'))
    fast = _agent(AgentType.BUS, parameter(top + 0.1, 'm/s'))
    assert check_limits(slow, limits, agent_types).result is Feasibility.FEASIBLE
    [found] = check_limits(fast, limits, agent_types).certificates
    assert found.limit_name == 'agent_types/bus/max_speed_mps'
    assert found.limit == top
    # The contract's limit is named where it is the tighter one.
    car = _agent(AgentType.CAR, parameter(51.0, 'm/s'))
    [found] = check_limits(car, limits, agent_types).certificates
    assert found.limit_name == 'vehicle_speed_max_mps'


def test_nobody_brakes_harder_than_its_type_can(
    limits: Limits, parameter: Make, agent_types: Mapping[str, AgentTypeRecord]
) -> None:
    most = agent_types['bus'].emergency_decel_mps2

    def asked(value: float, bound: Bound = Bound.EXACTLY) -> tuple[ScenarioSpec, ...]:
        hard = parameter(value, 'm/s^2', bound=bound)
        agents = (GroundAgent(id='b1', type=AgentType.BUS),)
        action = AgentAction(do='brake', agent='b1', deceleration_mps2=hard)
        stated = StatedCondition(id='c1', quantity='deceleration', of=('b1',), op='>=', value=hard)
        return (
            ScenarioSpec(prompt='x', agents=agents, events=(Event(id='e1', action=action),)),
            ScenarioSpec(prompt='x', agents=agents, conditions=(stated,)),
        )

    for spec in (*asked(most), *asked(most + 1.0, Bound.AT_MOST)):
        assert check_limits(spec, limits, agent_types).result is Feasibility.FEASIBLE
    for spec in (*asked(most + 0.1), *asked(most + 0.1, Bound.AT_LEAST)):
        [found] = check_limits(spec, limits, agent_types).certificates
        assert found.reason == 'speed_limit'
        assert found.limit_name == 'agent_types/bus/emergency_decel_mps2'
        assert found.sentence.startswith('A deceleration of')
        assert recheck(found, spec.model_dump(mode='json')).valid


@pytest.mark.parametrize('extra', [0, 1])
def test_counts(extra: int, limits: Limits) -> None:
    agents = tuple(
        GroundAgent(id=f'a{k}', type=AgentType.CAR) for k in range(limits.agents_max + extra)
    )
    uavs = tuple(Uav(id=f'u{k}') for k in range(limits.uavs_max + extra))
    found = _certificates(ScenarioSpec(prompt='x', agents=agents, uavs=uavs), limits)
    assert [(c.path, c.requested, c.limit) for c in found] == (
        [('uavs', 11.0, 10.0), ('agents', 201.0, 200.0)] if extra else []
    )


def test_every_broken_limit_is_named(limits: Limits, parameter: Make) -> None:
    spec = _mission(parameter, altitude_m=parameter(152.4), standoff_m=parameter(151.0))
    assert [c.reason for c in _certificates(spec, limits)] == ['altitude_limit', 'standoff']


@pytest.mark.parametrize('name', ['survey', 'motorcycle', 'convoy', 'tailgate'])
def test_the_prompts_of_the_paper_are_feasible(
    name: str, limits: Limits, read_prompt: Callable[..., ScenarioSpec]
) -> None:
    assert check_limits(read_prompt(name), limits).result is Feasibility.FEASIBLE
