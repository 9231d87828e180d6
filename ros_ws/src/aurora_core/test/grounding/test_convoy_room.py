# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nobody is put where another one stands of whom nothing says where it is."""

from __future__ import annotations

import itertools

import pytest

from aurora_core.grounding.convoy import split_scene
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.planning.complete import complete
from aurora_core.spec.events import AgentAction, DistanceTrigger, Event
from aurora_core.spec.parameter import Parameter, Provenance, Unit
from aurora_core.spec.scenario import Behavior, GroundAgent, Placement, ScenarioSpec
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
