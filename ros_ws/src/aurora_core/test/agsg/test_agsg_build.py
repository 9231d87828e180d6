# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The graph is derived from its documents: every element a node, every relation an edge."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from aurora_core.agsg.build import build_agsg
from aurora_core.agsg.families import family_of_quantity
from aurora_core.outcomes.agsg import Agsg, EdgeType, NodeType
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.scenario import (
    AgentAction,
    DistanceTrigger,
    Event,
    EventDoneTrigger,
    GroundAgent,
    ScenarioSpec,
    StatedCondition,
    Uav,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import AgentType

NAMES = ['survey', 'motorcycle', 'convoy', 'tailgate']


@pytest.mark.parametrize('name', NAMES)
def test_every_element_is_a_node_and_no_edge_hangs(name: str, full: Callable[[str], Agsg]) -> None:
    agsg = full(name)
    ids = [node.id for node in agsg.nodes]
    assert len(ids) == len(set(ids))
    spec = agsg.spec
    for group in (spec.agents, spec.uavs, spec.links, spec.events):
        for element in group:
            assert element.id in ids
    for edge in agsg.edges:
        assert edge.source in ids, edge
        assert edge.target in ids, edge
    assert all(len(i) <= 64 for i in ids)  # string<=64 of AgsgNode.msg


@pytest.mark.parametrize('name', NAMES)
def test_every_parameter_has_one_path_and_an_owner_that_is_a_node(
    name: str, full: Callable[[str], Agsg]
) -> None:
    agsg = full(name)
    paths = [p.path for p in agsg.parameters]
    assert len(paths) == len(set(paths)) == str(agsg.spec.model_dump()).count("'provenance'")
    assert {p.owner for p in agsg.parameters} <= {node.id for node in agsg.nodes}
    assert all(not p.path.startswith('/') and '//' not in p.path for p in agsg.parameters)


def test_paths_name_elements_by_id_and_owners_by_node(full: Callable[[str], Agsg]) -> None:
    owners = {p.path: p.owner for p in full('tailgate').parameters}
    mission = full('tailgate').spec.missions[0]
    assert owners[f'missions/{mission.id}/altitude_m'] == 'uav1'
    event = full('tailgate').spec.events[0]
    assert owners[f'events/{event.id}/trigger/value_m'] == event.id
    link = full('tailgate').spec.links[0]
    assert owners[f'links/{link.id}/loss'] == link.id
    van = next(a for a in full('tailgate').spec.agents if a.type is AgentType.VAN)
    assert any(p.startswith(f'agents/{van.id}/') and o == van.id for p, o in owners.items())


def test_world_parameters_belong_to_the_environment(parameter: Callable[..., Parameter]) -> None:
    spec = ScenarioSpec.model_validate(
        {'prompt': 'x', 'world': {'duration_s': parameter(60.0, 's').model_dump()}}
    )
    [found] = build_agsg(spec).parameters
    assert (found.path, found.owner) == ('world/duration_s', ENVIRONMENT_ID)
    assert found.realised is None


def test_realised_stands_beside_requested(full: Callable[[str], Agsg]) -> None:
    agsg = full('convoy')
    grounded = agsg.grounding
    assert grounded is not None
    rows = {r.path: r for r in grounded.realised}
    assert rows
    parameters = {p.path: p for p in agsg.parameters}
    for path, row in rows.items():
        assert parameters[path].realised == row.realised
        assert parameters[path].requested == row.requested
    assert any(p.realised is None for p in agsg.parameters)


def test_edges_say_what_depends_on_what(full: Callable[[str], Agsg]) -> None:
    edges = {(e.source, e.target, e.type) for e in full('tailgate').edges}
    event = full('tailgate').spec.events[0]
    link = full('tailgate').spec.links[0]
    van = next(a.id for a in full('tailgate').spec.agents if a.type is AgentType.VAN)
    assert ('ego', van, EdgeType.BEHAVIORAL) in edges
    assert (van, 'uav1', EdgeType.PERCEPTUAL) in edges
    assert (van, event.id, EdgeType.TEMPORAL) in edges
    assert ('ego', event.id, EdgeType.TEMPORAL) in edges
    assert (event.id, link.id, EdgeType.COMMUNICATION) in edges
    assert ('uav1', link.id, EdgeType.COMMUNICATION) in edges
    assert (link.id, 'ego', EdgeType.COMMUNICATION) in edges
    edges = {(e.source, e.target, e.type) for e in full('survey').edges}
    assert ('ego', 'uav1', EdgeType.SPATIAL) in edges
    convoy = full('convoy')
    edges = {(e.source, e.target, e.type) for e in convoy.edges}
    bus = next(a.id for a in convoy.spec.agents if a.type is AgentType.BUS)
    assert ('ego', bus, EdgeType.SPATIAL) in edges
    judged = [n.id for n in convoy.nodes if n.type is NodeType.CONDITION]
    assert judged
    assert {e.target for e in convoy.edges if e.label == 'is judged by'} <= set(judged)


def test_the_chain_of_the_paper(full: Callable[[str], Agsg]) -> None:
    """Placement affects sensing, sensing triggers communication; conditions hang on all of it."""
    edges = {(e.source, e.target, e.type) for e in full('tailgate').edges}
    assert {
        (ENVIRONMENT_ID, 'ego', EdgeType.SPATIAL),
        (ENVIRONMENT_ID, 'uav1', EdgeType.SPATIAL),
        ('ego', 'van1', EdgeType.SPATIAL),
        ('van1', 'uav1', EdgeType.PERCEPTUAL),
        ('uav1', 'e1', EdgeType.PERCEPTUAL),
        ('e1', 'link1', EdgeType.COMMUNICATION),
        (ENVIRONMENT_ID, 'link1', EdgeType.COMMUNICATION),
        ('link1', 'e1.delivered', EdgeType.COMMUNICATION),
        ('e1', 'e1.delivered', EdgeType.COMMUNICATION),
        ('uav1', 'e1.actor_visible', EdgeType.PERCEPTUAL),
        ('van1', 'm1.tracked', EdgeType.PERCEPTUAL),
        ('e1', 'e1.within', EdgeType.TEMPORAL),
        ('van1', 'van1.placed', EdgeType.SPATIAL),
        ('uav1', 'uav1.landed', EdgeType.BEHAVIORAL),
    } <= edges


def test_every_condition_hangs_on_something(full: Callable[[str], Agsg]) -> None:
    for name in NAMES:
        agsg = full(name)
        judged = {n.id for n in agsg.nodes if n.type is NodeType.CONDITION}
        assert judged == {e.target for e in agsg.edges if e.target in judged}
        for condition in judged:
            assert len({e.type for e in agsg.edges if e.target == condition}) == 1


def test_a_message_lets_a_vehicle_act(parameter: Callable[..., Parameter]) -> None:
    numbers = {
        'loss': parameter(0.0, '1'),
        'latency_s': parameter(0.1, 's'),
        'retransmissions': parameter(3.0, '1'),
        'retransmission_interval_s': parameter(0.2, 's'),
    }
    spec = ScenarioSpec.model_validate(
        {
            'prompt': 'x',
            'agents': [{'id': 'a', 'type': 'car', 'group': 'cars'}, {'id': 'b', 'type': 'rsu'}],
            'uavs': [{'id': 'uav1'}],
            'missions': [
                {
                    'id': 'm1',
                    'uav': 'uav1',
                    'mode': 'hover',
                    'altitude_m': parameter(30.0),
                    'duration_s': parameter(30.0, 's'),
                }
            ],
            'links': [{'id': 'l1', 'sender': 'b', 'receiver': 'a', **numbers}],
            'events': [
                {
                    'id': 'e1',
                    'trigger': {'on': 'time', 'at_s': parameter(5.0, 's')},
                    'action': {'do': 'send_message', 'sender': 'b', 'receiver': 'a'},
                },
                {
                    'id': 'e2',
                    'trigger': {'on': 'message_received', 'by': 'a'},
                    'action': {'do': 'brake', 'agent': 'a'},
                },
                {'id': 'e3', 'action': {'do': 'send_message', 'sender': 'a', 'receiver': 'b'}},
            ],
            'conditions': [
                {
                    'id': 'c1',
                    'quantity': 'speed',
                    'of': ['cars'],
                    'op': '<',
                    'value': parameter(9.0, 'm/s'),
                },
            ],
            'orders': [
                {'id': 'o1', 'first': 'e1', 'then': 'm1', 'within_s': parameter(9.0, 's')},
            ],
            'prohibitions': [
                {'id': 'p1', 'forbids': 'world', 'weather': 'rain'},
                {'id': 'p2', 'forbids': 'event', 'action': {'do': 'land', 'uav': 'uav1'}},
                {'id': 'p3', 'forbids': 'behavior', 'agent': 'a', 'kind': 'overtake'},
            ],
        }
    )
    agsg = build_agsg(spec)
    edges = {(e.source, e.target, e.type) for e in agsg.edges}
    assert {
        (ENVIRONMENT_ID, 'e1', EdgeType.TEMPORAL),
        ('e1', 'l1', EdgeType.COMMUNICATION),
        ('l1', 'e2', EdgeType.COMMUNICATION),
        ('e2', 'a', EdgeType.BEHAVIORAL),
        ('e3', 'b', EdgeType.COMMUNICATION),  # no link: to the receiver itself
        ('a', 'c1', EdgeType.BEHAVIORAL),  # by its group
        ('e1', 'o1', EdgeType.TEMPORAL),
        ('uav1', 'o1', EdgeType.TEMPORAL),  # a mission is its UAV's
        (ENVIRONMENT_ID, 'p1', EdgeType.SPATIAL),
        ('uav1', 'p2', EdgeType.TEMPORAL),
        ('a', 'p3', EdgeType.BEHAVIORAL),
    } <= edges
    labels = {n.id: n.label for n in agsg.nodes if n.type is NodeType.CONDITION}
    assert labels == {
        'c1': 'speed of cars < 9',
        'o1': 'e1 before m1',
        'p1': 'no rain',
        'p2': 'no land',
        'p3': 'no a overtake',
    }
    owners = {p.path: p.owner for p in agsg.parameters}
    assert owners['orders/o1/within_s'] == 'o1'
    assert owners['missions/m1/altitude_m'] == 'uav1'


def test_every_quantity_has_a_family() -> None:
    assert {family_of_quantity(name.value) for name in QuantityName} == set(EdgeType)


def test_events_of_sight_sequence_and_action(parameter: Callable[..., Parameter]) -> None:
    spec = ScenarioSpec(
        prompt='x',
        agents=(GroundAgent(id='a', type=AgentType.CAR), GroundAgent(id='b', type=AgentType.CAR)),
        uavs=(Uav(id='uav1'),),
        events=(
            Event(id='e1', trigger=VisibilityTrigger(on='visible', observer='uav1', target='a')),
            Event(
                id='e2',
                trigger=EventDoneTrigger(on='event_done', event='e1'),
                action=AgentAction(do='brake', agent='b'),
            ),
            Event(
                id='e3',
                trigger=DistanceTrigger(
                    on='distance_below', a='a', b='intersection', value_m=parameter(20.0)
                ),
            ),
        ),
        conditions=(
            StatedCondition(
                id='c1', quantity='distance', of=('a', 'b'), op='<=', value=parameter(20.0)
            ),
        ),
    )
    agsg = build_agsg(spec)
    edges = {(e.source, e.target, e.type) for e in agsg.edges}
    assert ('uav1', 'e1', EdgeType.PERCEPTUAL) in edges
    assert ('a', 'e1', EdgeType.PERCEPTUAL) in edges
    assert ('e1', 'e2', EdgeType.TEMPORAL) in edges
    assert ('e2', 'b', EdgeType.BEHAVIORAL) in edges
    # A place is no node: it belongs to the environment.
    assert {e[0] for e in edges if e[1] == 'e3'} == {'a', ENVIRONMENT_ID}
    assert ('a', 'c1', EdgeType.SPATIAL) in edges
    nodes = {n.id: n for n in agsg.nodes}
    assert nodes['c1'].type is NodeType.CONDITION
    assert nodes['e2'].label == 'event_done then brake'
    assert nodes['uav1'].label == 'idle'
    assert {p.path: p.owner for p in agsg.parameters} == {
        'events/e3/trigger/value_m': 'e3',
        'conditions/c1/value': 'c1',
    }
    assert agsg.parameters[0].provenance is Provenance.EXPLICIT


@pytest.mark.parametrize('name', NAMES)
def test_deriving_again_gives_the_same_graph(name: str, full: Callable[[str], Agsg]) -> None:
    agsg = full(name)
    again = build_agsg(
        agsg.spec,
        map_digest=agsg.map_digest,
        stage=agsg.stage,
        grounding=agsg.grounding,
        schedule=agsg.schedule,
        conditions=agsg.conditions,
    )
    assert again == agsg
    assert again.sha256 == agsg.sha256


def test_digest_covers_each_document(full: Callable[[str], Agsg]) -> None:
    texts = full('survey').texts
    seen = {texts.sha256}
    for name in ('spec', 'grounding', 'schedule', 'conditions'):
        seen.add(replace(texts, **{name: getattr(texts, name) + ' '}).sha256)
    # Text that moves from one document to the next is a change too.
    moved = {'grounding': texts.grounding[:-1], 'schedule': '}' + texts.schedule}
    seen.add(replace(texts, **moved).sha256)
    assert len(seen) == 6
