# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nobody is put where another one stands of whom nothing says where it is."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import pytest

from aurora_core.grounding.convoy import split_scene
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.planning.complete import complete
from aurora_core.spec.events import AgentAction, AgentDo, DistanceTrigger, Event, TimeTrigger
from aurora_core.spec.parameter import Parameter, Provenance, Span, Unit
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    Behavior,
    GroundAgent,
    Placement,
    ScenarioSpec,
    StatedCondition,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Relation

LIMITS = load_limits(config_path('limits.json'))


def _agent(
    name: str, kind: AgentType, *does: Behavior, ahead_of: str | None = None
) -> GroundAgent:
    places = () if ahead_of is None else (Placement(relation=Relation.AHEAD, of=ahead_of),)
    return GroundAgent(id=name, type=kind, behaviors=does, placements=places)


def _overtaken() -> ScenarioSpec:
    """A bus overtakes two bicycles and comes near the first one on the way."""
    near = Parameter(
        value=20.0, unit=Unit.METRE, low=20.0, high=20.0, provenance=Provenance.INFERRED
    )
    passes = (Behavior(kind=BehaviorKind.OVERTAKE, target=b) for b in ('bike1', 'bike2'))
    event = Event(
        id='e1',
        trigger=DistanceTrigger(on='distance_below', a='bus1', b='bike1', value_m=near),
        action=AgentAction(do='slow', agent='bike1'),
    )
    agents = (
        _agent('bus1', AgentType.BUS, *passes),
        _agent('bike1', AgentType.BICYCLE),
        _agent('bike2', AgentType.BICYCLE),
    )
    return ScenarioSpec(prompt='x', agents=agents, events=(event,))


def _yielded_to() -> ScenarioSpec:
    """A car ahead of the first of two ambulances yields to both."""
    yields = (Behavior(kind=BehaviorKind.YIELD, target=a) for a in ('ambulance1', 'ambulance2'))
    run = Behavior(kind=BehaviorKind.EMERGENCY_RUN)
    agents = (
        _agent('ambulance1', AgentType.AMBULANCE, run),
        _agent('ambulance2', AgentType.AMBULANCE, run),
        _agent('car1', AgentType.CAR, *yields, ahead_of='ambulance1'),
    )
    return ScenarioSpec(prompt='x', agents=agents)


@pytest.mark.parametrize('spec', [_overtaken(), _yielded_to()], ids=['overtaken', 'yielded to'])
def test_two_of_a_kind_get_room_of_their_own(spec: ScenarioSpec) -> None:
    split = split_scene(complete(spec, LIMITS))
    assert split.unsupported == ()
    assert len(split.convoy) == len(spec.agents)
    for one, other in itertools.combinations(split.convoy, 2):
        apart_m = abs(one.offset_m - other.offset_m)
        assert apart_m >= 14.0 or one.lane_shift != other.lane_shift


def _metres(value: float) -> Parameter:
    return Parameter(
        value=value, unit=Unit.METRE, low=value, high=value, provenance=Provenance.EXPLICIT,
        span=Span(start=0, end=1),
    )  # fmt: skip


def _placed(name: str, kind: AgentType, *placements: Placement) -> GroundAgent:
    return GroundAgent(id=name, type=kind, placements=placements)


def _offsets(
    agents: tuple[GroundAgent, ...], types: Mapping[str, AgentTypeRecord], **more: Any
) -> dict[str, tuple[float, int]]:
    split = split_scene(
        complete(ScenarioSpec(prompt='x', agents=agents, **more), LIMITS), types=types
    )
    assert split.unsupported == ()
    return {m.agent.id: (m.offset_m, m.lane_shift) for m in split.convoy}


def test_who_only_shares_a_lane_stands_where_nobody_else_does(
    agent_types: Mapping[str, AgentTypeRecord],
) -> None:
    behind = Placement(relation=Relation.BEHIND, of='car1', distance_m=_metres(15.0))
    found = _offsets(
        (
            _agent('car1', AgentType.CAR),
            _placed('fire1', AgentType.FIRETRUCK, behind),
            _placed('truck1', AgentType.TRUCK, Placement(relation=Relation.SAME_LANE, of='fire1')),
        ),
        agent_types,
    )
    kinds = {'car1': 'car', 'fire1': 'firetruck', 'truck1': 'truck'}
    for one, other in itertools.combinations(found, 2):
        lengths_m = [agent_types[kinds[name]].length_m for name in (one, other)]
        needed_m = sum(lengths_m) / 2.0
        assert abs(found[one][0] - found[other][0]) > needed_m, (one, other)


@pytest.mark.parametrize('does', ['change_lane', 'brake'])
def test_who_changes_lane_has_that_lane_free(
    agent_types: Mapping[str, AgentTypeRecord], does: AgentDo
) -> None:
    at_s = Parameter(
        value=9.0, unit=Unit.SECOND, low=9.0, high=9.0, provenance=Provenance.INFERRED
    )
    event = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=at_s),
        action=AgentAction(do=does, agent='bus1'),
    )
    found = _offsets(
        (
            _agent('car1', AgentType.CAR),
            _placed('bus1', AgentType.BUS, Placement(relation=Relation.ADJACENT_LANE, of='car1')),
        ),
        agent_types,
        events=(event,),
    )
    along_m = abs(found['bus1'][0] - found['car1'][0])
    assert found['bus1'][1] != found['car1'][1]
    assert (along_m > 20.0) is (does == 'change_lane')


def test_two_who_stay_far_apart_start_so(agent_types: Mapping[str, AgentTypeRecord]) -> None:
    apart = StatedCondition(
        id='c1', quantity=QuantityName.DISTANCE, of=('car1', 'car2'), op='>', value=_metres(200.0)
    )
    drive = Behavior(kind=BehaviorKind.DRIVE)
    cars = tuple(_agent(name, AgentType.CAR, drive) for name in ('car1', 'car2'))
    found = _offsets(cars, agent_types, conditions=(apart,))
    assert found['car2'][0] - found['car1'][0] > 200.0
    assert {'car1', 'car2'} == found.keys()
