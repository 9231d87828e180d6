# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What bodies are to each other is completed: to whom one yields, until when one is ahead."""

from __future__ import annotations

import pytest

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits
from aurora_core.parsing.parser import ParseContext, parse_offline
from aurora_core.planning.bodies import approaching, meeting, passed, standing, yielding
from aurora_core.planning.bounds import bent
from aurora_core.spec.own_events import let_pass
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.vocabulary import BehaviorKind, Relation

CONTEXT = ParseContext(landmark_names=())
LIMITS = load_limits(config_path('limits.json'))


@pytest.mark.parametrize(
    ('prompt', 'whom'),
    [
        ('A pedestrian crosses at the crosswalk. The ego car yields.', 'pedestrian1'),
        ('A pedestrian crosses when the ego is 40 m away. The ego yields.', 'pedestrian1'),
        ('An ambulance approaches the ego car from behind. The ego car yields.', 'ambulance1'),
        ('A van approaches the ego car from behind. The ego car yields.', 'van1'),
        # A person goes before a siren, and of two vehicles neither is chosen.
        ('An ambulance waits. A pedestrian crosses. The ego car yields.', 'pedestrian1'),
        ('A van tailgates the ego car. A bus follows the ego car. The ego car yields.', None),
        ('A bus drives. The ego car yields.', None),
    ],
)
def test_who_yields_yields_to_somebody(prompt: str, whom: str | None) -> None:
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    done = yielding(read)
    ego = next(agent for agent in done.agents if agent.id == 'ego')
    (behavior,) = ego.behaviors
    assert (behavior.target, behavior.target_inferred) == (whom, whom is not None)


@pytest.mark.parametrize(
    'relation', [Relation.ONCOMING, Relation.ADJACENT_LANE, Relation.SAME_LANE]
)
@pytest.mark.parametrize(
    ('prompt', 'whom'),
    [
        ('A van drives. A truck drives. The ego car drives.', 'ego'),
        ('A bus drives. A truck drives. A drone tracks the truck.', 'truck1'),
    ],
)
def test_a_relation_of_two_that_names_nobody_is_one_to_somebody(
    prompt: str, whom: str, relation: Relation
) -> None:
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    first, *others = read.agents
    placed = first.model_copy(update={'placements': (Placement(relation=relation, of=None),)})
    done = meeting(read.model_copy(update={'agents': (placed, *others)}))
    assert [p.of for p in done.agents[0].placements] == [whom]
    assert done.agents[1:] == tuple(others)


def test_of_several_persons_who_cross_one_yields_to_all() -> None:
    read = parse_offline('Two pedestrians cross the street. The ego car yields.', CONTEXT).spec
    assert read is not None
    ego = next(agent for agent in yielding(read).agents if agent.id == 'ego')
    persons = [a.id for a in read.agents if a.id != 'ego']
    assert [b.target for b in ego.behaviors] == persons
    assert len(persons) == 2


def test_who_is_told_to_whom_keeps_it() -> None:
    prompt = 'A pedestrian crosses. An ambulance drives. The ego car yields to the ambulance.'
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    assert yielding(read) == read


@pytest.mark.parametrize(
    ('prompt', 'kept'),
    [
        ('A truck drives in front of the ego car. The ego car overtakes it.', False),
        ('A truck drives in front of the ego car. The ego car overtakes a bus.', True),
        ('The ego car drives behind a truck and then overtakes it.', False),
    ],
)
def test_who_is_overtaken_is_ahead_at_first_only(prompt: str, kept: bool) -> None:
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    done = passed(read)
    placed = [p for agent in done.agents for p in agent.placements if 'truck1' in (agent.id, p.of)]
    assert [p.kept_in_motion for p in placed] == [kept]


@pytest.mark.parametrize(
    ('words', 'low_m', 'high_m'),
    [
        ('stays within 12 m of it', 5.0, 11.0),
        ('stays at least 40 m away from it', 41.0, 60.0),
        ('stays within 60 m of it', 20.0, 20.0),
    ],
)
def test_who_stays_near_starts_near(words: str, low_m: float, high_m: float) -> None:
    read = parse_offline(f'A van follows a car and {words}.', CONTEXT).spec
    assert read is not None
    (van,) = (a for a in bent(read, LIMITS).agents if a.id == 'van1')
    (placed,) = van.placements
    assert placed.distance_m is not None
    assert low_m <= placed.distance_m.value <= high_m
    assert placed.distance_m.provenance is Provenance.DEFAULT


@pytest.mark.parametrize(
    ('cause', 'whom'),
    [
        ('When an ambulance comes within 60 m of the ego car, the drone messages the ego.', True),
        ('At 20 s the ambulance accelerates, and then the drone messages the ego.', True),
        ('At 20 s the drone messages the ego. An ambulance drives.', False),
    ],
)
def test_who_yields_on_a_message_yields_to_whom_it_is_about(cause: str, whom: bool) -> None:
    said = f'A drone tracks the ego car. {cause} When it gets the message the ego yields.'
    read = parse_offline(said, CONTEXT).spec
    assert read is not None
    (event,) = (e for e in read.events if getattr(e.action, 'do', '') == 'yield')
    assert let_pass(read, event) == ('ambulance1' if whom else None)


def test_who_approaches_nobody_named_comes_nearer_to_whom_it_is_placed_to() -> None:
    read = parse_offline('A van drives. The ego car drives 60 m behind a bus.', CONTEXT).spec
    assert read is not None
    comes = (Behavior(kind=BehaviorKind.APPROACH),)
    agents = tuple(a.model_copy(update={'behaviors': comes}) for a in read.agents)
    done = {a.id: a for a in approaching(read.model_copy(update={'agents': agents})).agents}
    targets = {
        name: (a.behaviors[0].target, a.behaviors[0].target_inferred) for name, a in done.items()
    }
    assert targets == {'van1': ('ego', True), 'ego': ('bus1', True), 'bus1': ('ego', True)}


@pytest.mark.parametrize(
    ('prompt', 'place'),
    [
        ('A van stops at the intersection and waits there for at least 5 s.', 'intersection'),
        ('A person walks to the crosswalk and waits there for at least 5 s.', 'crosswalk'),
        ('A car drives at 10 m/s, waits for at least 5 s and drives on.', None),
    ],
)
def test_who_waits_after_a_motion_comes_to_rest_for_it(prompt: str, place: str | None) -> None:
    """A wait of its own would be kept by whoever stands before it has set off."""
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    (agent,) = standing(read).agents
    *_, stop = agent.behaviors
    assert (stop.kind, stop.target) == (BehaviorKind.STOP, place)
    assert stop.duration_s is not None
    assert stop.duration_s.value == 5.0


def test_every_wait_after_a_motion_is_a_rest() -> None:
    told = 'A person walks to the crosswalk and waits there for at least 5 s.'
    read = parse_offline(told, CONTEXT).spec
    assert read is not None
    (person,) = read.agents
    twice = person.model_copy(update={'behaviors': person.behaviors * 2})
    (agent,) = standing(read.model_copy(update={'agents': (twice,)})).agents
    kinds = [b.kind for b in agent.behaviors]
    assert kinds == [BehaviorKind.WALK, BehaviorKind.STOP] * 2


@pytest.mark.parametrize(
    ('prompt', 'rests'),
    [
        ('A person walks to the crosswalk and waits there.', True),
        ('A person walks along the sidewalk and waits at the crosswalk.', True),
        ('A person walks to the crosswalk and waits there. After 40 s he crosses.', False),
        ('A person walks to the crosswalk, waits there and then crosses.', False),
        ('A person waits at the crosswalk.', False),
    ],
)
def test_who_walks_and_waits_stays_there_if_nothing_lets_it_go(prompt: str, rests: bool) -> None:
    read = parse_offline(prompt, CONTEXT).spec
    assert read is not None
    (agent,) = standing(read).agents
    stops = [b for b in agent.behaviors if b.kind is BehaviorKind.STOP]
    assert [(b.target, b.duration_s) for b in stops] == [('crosswalk', None)] * rests
    assert any(b.kind is BehaviorKind.WAIT for b in agent.behaviors) is not rests
