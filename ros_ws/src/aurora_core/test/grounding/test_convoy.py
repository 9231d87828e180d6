# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Relations become offsets along one route; what cannot be placed is named."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.grounding.convoy import SceneSplit, split_scene
from aurora_core.grounding.distances import DETACHED_M
from aurora_core.grounding.ties import BeforePlace, Tie, agreed
from aurora_core.knowledge.limits import Tolerances
from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    AgentAction,
    Behavior,
    DistanceTrigger,
    Event,
    GroundAgent,
    Placement,
    ScenarioSpec,
    SendMessage,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, MissionMode, Place, Relation, Role

Make = Callable[..., Parameter]


def _agent(
    name: str,
    *places: tuple[Relation, str | None, float | None],
    make: Make | None = None,
    does: tuple[BehaviorKind, str] | None = None,
    kind: AgentType = AgentType.CAR,
    role: Role = Role.OTHER,
) -> GroundAgent:
    placements = tuple(
        Placement(
            relation=relation,
            of=of,
            distance_m=None if distance is None or make is None else make(distance),
        )
        for relation, of, distance in places
    )
    behaviors = () if does is None else (Behavior(kind=does[0], target=does[1]),)
    role = Role.EGO if name == 'ego' else role
    return GroundAgent(id=name, type=kind, role=role, placements=placements, behaviors=behaviors)


def _spec(*agents: GroundAgent, **fields: Any) -> ScenarioSpec:
    return ScenarioSpec(prompt='x', agents=agents, **fields)


def _places(split: SceneSplit) -> dict[str, tuple[float, int]]:
    return {m.agent.id: (m.offset_m, m.lane_shift) for m in split.convoy}


EGO = _agent('ego')


@pytest.mark.parametrize(
    ('relation', 'expected'),
    [
        (Relation.AHEAD, (35.0, 0)),
        (Relation.SAME_LANE, (35.0, 0)),
        (Relation.BEHIND, (-35.0, 0)),
        (Relation.BEFORE, (-35.0, 0)),
        (Relation.LEFT, (0.0, 1)),
        (Relation.ADJACENT_LANE, (0.0, 1)),
        (Relation.BESIDE, (0.0, 1)),
        (Relation.RIGHT, (0.0, -1)),
    ],
)
def test_each_relation(relation: Relation, expected: tuple[float, int], parameter: Make) -> None:
    split = split_scene(_spec(_agent('a', (relation, 'ego', 35.0), make=parameter), EGO))
    assert _places(split) == {'ego': (0.0, 0), 'a': expected}
    assert split.unsupported == ()
    assert split.convoy[0].agent.id == 'ego'


@pytest.mark.parametrize(
    ('bound', 'kept', 'expected'),
    [
        (Bound.EXACTLY, False, 30.0),
        (Bound.AT_LEAST, False, 31.0),  # by the tolerance: rounding would decide on 30 m
        (Bound.AT_MOST, False, 29.0),
        (Bound.AT_LEAST, True, 37.5),  # and with room for corners and stops on the way
        (Bound.AT_MOST, True, 22.5),
        (Bound.EXACTLY, True, 30.0),
    ],
)
def test_a_bound_is_met_with_something_to_spare(
    bound: Bound, kept: bool, expected: float, tolerances: Tolerances, parameter: Make
) -> None:
    stated = parameter(30.0, explicit=True, bound=bound)
    place = Placement(
        relation=Relation.AHEAD, of='ego', distance_m=stated, kept_in_motion=kept, throughout=kept
    )
    car = GroundAgent(id='a', type=AgentType.CAR, placements=(place,))
    split = split_scene(_spec(car, EGO), tolerances.placement_vehicle_m)
    assert _places(split)['a'] == (expected, 0)


def test_chains_in_both_directions(parameter: Make) -> None:
    split = split_scene(
        _spec(
            _agent('c', (Relation.AHEAD, 'b', 10.0), make=parameter),
            _agent('b', (Relation.AHEAD, 'ego', 30.0), make=parameter),
            _agent('ego', (Relation.BEHIND, 'd', 15.0), make=parameter),
            _agent('d'),
            _agent('e', (Relation.RIGHT, 'd', None), (Relation.BEHIND, 'd', 5.0), make=parameter),
        )
    )
    assert _places(split) == {
        'ego': (0.0, 0),
        'b': (30.0, 0),
        'c': (40.0, 0),
        'd': (15.0, 0),
        'e': (10.0, -1),
    }
    assert split.free == ()


def test_same_lane_and_behind_say_one_place(parameter: Make) -> None:
    split = split_scene(
        _spec(
            EGO,
            _agent(
                'a',
                (Relation.SAME_LANE, 'ego', None),
                (Relation.BEHIND, 'ego', 30.0),
                make=parameter,
            ),
        )
    )
    assert _places(split)['a'] == (-30.0, 0)
    assert split.unsupported == ()


def test_two_placements_that_agree(parameter: Make) -> None:
    split = split_scene(
        _spec(
            EGO,
            _agent('t', (Relation.AHEAD, 'ego', 50.0), make=parameter),
            _agent(
                'b', (Relation.AHEAD, 'ego', 20.0), (Relation.BEHIND, 't', 30.0), make=parameter
            ),
        )
    )
    assert _places(split) == {'ego': (0.0, 0), 't': (50.0, 0), 'b': (20.0, 0)}
    assert split.unsupported == ()


def test_who_is_behind_one_in_a_row_is_behind_those_ahead_of_it() -> None:
    split = split_scene(
        _spec(
            _agent('c1', (Relation.BEHIND, 'ego', None)),
            _agent('c2', (Relation.BEHIND, 'c1', None), (Relation.BEHIND, 'ego', None)),
            _agent('c3', (Relation.BEHIND, 'c2', None), (Relation.BEHIND, 'ego', None)),
            EGO,
        )
    )
    assert _places(split) == {
        'ego': (0.0, 0),
        'c1': (-20.0, 0),
        'c2': (-40.0, 0),
        'c3': (-60.0, 0),
    }
    assert split.unsupported == ()


def test_free_distances_of_a_row_bend_to_a_stated_one(parameter: Make) -> None:
    split = split_scene(
        _spec(
            _agent('c1', (Relation.BEHIND, 'ego', None)),
            _agent(
                'c2', (Relation.BEHIND, 'c1', None), (Relation.BEHIND, 'ego', 70.0), make=parameter
            ),
            EGO,
        )
    )
    assert _places(split) == {'ego': (0.0, 0), 'c2': (-70.0, 0), 'c1': (-20.0, 0)}
    assert split.unsupported == ()


def test_placements_that_contradict_each_other_are_named(parameter: Make) -> None:
    split = split_scene(
        _spec(
            _agent('ego', (Relation.BEHIND, 'a', 30.0), make=parameter),
            _agent('a', (Relation.AHEAD, 'ego', 20.0), make=parameter),
        )
    )
    assert split.unsupported == ('ego: places that contradict each other',)


@pytest.mark.parametrize(
    ('kind', 'gap_m'),
    [
        (BehaviorKind.FOLLOW, 20.0),
        (BehaviorKind.TAILGATE, 20.0),
        # It has to come nearer by 10 m at least.
        (BehaviorKind.APPROACH, 40.0),
    ],
)
def test_who_chases_starts_behind(kind: BehaviorKind, gap_m: float) -> None:
    split = split_scene(_spec(_agent('a', does=(kind, 'ego')), EGO))
    assert _places(split)['a'] == (-gap_m, 0)


def test_a_stated_closing_distance_is_kept(parameter: Make) -> None:
    behavior = Behavior(kind=BehaviorKind.TAILGATE, target='ego', closing_from_m=parameter(45.0))
    van = GroundAgent(id='van1', type=AgentType.VAN, behaviors=(behavior,))
    assert _places(split_scene(_spec(van, EGO)))['van1'] == (-45.0, 0)


def test_who_is_to_come_close_starts_farther_away(parameter: Make) -> None:
    event = Event(
        id='e1',
        trigger=DistanceTrigger(on='distance_below', a='a', b='ego', value_m=parameter(25.0)),
    )
    split = split_scene(_spec(_agent('a'), EGO, events=(event,)))
    assert _places(split)['a'][0] < -25.0


@pytest.mark.parametrize(
    ('agent', 'named'),
    [
        (_agent('a', (Relation.AT, 'sidewalk', None)), 'a: placement at sidewalk'),
        (_agent('a', (Relation.PARKED_AT, 'sidewalk', None)), 'a: placement parked_at sidewalk'),
    ],
)
def test_what_cannot_be_placed_is_named(agent: GroundAgent, named: str) -> None:
    assert split_scene(_spec(agent, EGO)).unsupported == (named,)


def test_a_second_placement_that_cannot_be_realised_is_named_too(parameter: Make) -> None:
    agent = _agent(
        'a', (Relation.AHEAD, 'ego', 20.0), (Relation.AT, 'sidewalk', None), make=parameter
    )
    split = split_scene(_spec(agent, EGO))
    assert _places(split)['a'] == (20.0, 0)
    assert split.unsupported == ('a: placement at sidewalk',)


def test_of_those_who_meet_each_other_the_first_is_met() -> None:
    split = split_scene(
        _spec(
            _agent('a', (Relation.ONCOMING, 'b', None)),
            _agent('b', (Relation.ONCOMING, 'a', None)),
        )
    )
    assert ([m.agent.id for m in split.convoy], [a.id for a in split.oncoming]) == (['a'], ['b'])
    assert split.unsupported == ()


def test_on_the_road_needs_nothing() -> None:
    assert split_scene(_spec(_agent('a', (Relation.ON, 'main_road', None)))).unsupported == ()


def test_one_member_stands_before_the_intersection(parameter: Make) -> None:
    bus = _agent('bus', (Relation.BEFORE, 'intersection', 50.0), make=parameter)
    truck = _agent('truck', (Relation.BESIDE, 'bus', None))
    split = split_scene(_spec(truck, bus))
    assert split.unsupported == ()
    assert split.before == BeforePlace(place=Place.INTERSECTION, agent='bus', distance_m=50.0)
    second = _agent('van', (Relation.BEFORE, 'intersection', None))
    split = split_scene(_spec(truck, bus, second))
    assert split.unsupported == ()
    assert _places(split)['van'] == (30.0, 0)
    third = _agent('car', (Relation.BEFORE, 'intersection', None))
    split = split_scene(_spec(truck, bus, second, third))
    assert (_places(split)['car'], split.unsupported) == ((15.0, 0), ())
    other = _agent('van', (Relation.BEFORE, 'crosswalk', None))
    split = split_scene(_spec(truck, bus, other))
    assert split.unsupported == ('van: placement before a place',)
    assert split_scene(_spec(second)).before == BeforePlace(
        place=Place.INTERSECTION, agent='van', distance_m=20.0
    )


def test_persons_and_unrelated_vehicles_are_apart() -> None:
    split = split_scene(
        _spec(
            EGO,
            _agent('p', kind=AgentType.PEDESTRIAN),
            _agent('bg', role=Role.BACKGROUND, does=(BehaviorKind.CIRCULATE, 'main_road')),
        )
    )
    assert [a.id for a in split.persons] == ['p']
    assert [a.id for a in split.free] == ['bg']
    assert list(_places(split)) == ['ego']


def _tracking(make: Make, target: str) -> dict[str, Any]:
    mission = UavMission(
        id='m1',
        uav='uav1',
        mode=MissionMode.TRACK,
        target=target,
        altitude_m=make(30.0),
        standoff_m=make(0.0),
        duration_s=make(30.0, 's'),
    )
    return {'uavs': (Uav(id='uav1'),), 'missions': (mission,)}


def test_a_watched_vehicle_is_on_the_road_with_the_ego(parameter: Make) -> None:
    split = split_scene(_spec(EGO, _agent('m'), _agent('x'), **_tracking(parameter, 'm')))
    assert _places(split) == {'ego': (0.0, 0), 'm': (-DETACHED_M, 0)}
    assert [a.id for a in split.free] == ['x']


def test_who_stands_all_along_is_in_nobody_s_way(parameter: Make) -> None:
    waiting = _agent('ego', does=(BehaviorKind.WAIT, 'ego'))
    split = split_scene(_spec(waiting, _agent('m'), **_tracking(parameter, 'm')))
    assert _places(split) == {'ego': (0.0, 0), 'm': (DETACHED_M, 0)}
    police = _agent(
        'police', (Relation.AT, 'landmark:City Hall', None), does=(BehaviorKind.WAIT, 'police')
    )
    split = split_scene(_spec(_agent('m'), police, **_tracking(parameter, 'm')))
    assert _places(split) == {'m': (0.0, 0), 'police': (-DETACHED_M, 0)}


def test_a_second_group_lines_up_behind_the_first(parameter: Make) -> None:
    split = split_scene(
        _spec(
            EGO,
            _agent('a', (Relation.BEHIND, 'ego', 30.0), make=parameter),
            _agent('b', (Relation.AHEAD, 'c', 10.0), make=parameter),
            _agent('c'),
        )
    )
    places = _places(split)
    assert places['a'] == (-30.0, 0)
    assert places['b'] == (-30.0 - DETACHED_M, 0)
    assert places['c'] == (-40.0 - DETACHED_M, 0)
    assert split.unsupported == ()


def test_without_an_ego_the_one_that_others_refer_to_is_the_origin(parameter: Make) -> None:
    split = split_scene(
        _spec(_agent('b', (Relation.AHEAD, 'a', 10.0), make=parameter), _agent('a'))
    )
    assert split.convoy[0].agent.id == 'a'
    assert _places(split) == {'a': (0.0, 0), 'b': (10.0, 0)}
    assert split_scene(_spec(_agent('x'), _agent('y'))).convoy[0].agent.id == 'x'


def test_background_alone_has_no_convoy() -> None:
    split = split_scene(_spec(_agent('x', role=Role.BACKGROUND)))
    assert split.convoy == ()
    assert [a.id for a in split.free] == ['x']


def test_a_scene_without_vehicles() -> None:
    split = split_scene(_spec(_agent('p', kind=AgentType.PEDESTRIAN)))
    assert (split.convoy, split.free) == ((), ())


def test_several_ahead_of_one_do_not_stand_in_one_place() -> None:
    cars = [_agent(name, (Relation.AHEAD, 'ego', None)) for name in ('a', 'b', 'c')]
    places = _places(split_scene(_spec(EGO, *cars)))
    assert [places[name][0] for name in ('a', 'b', 'c')] == [20.0, 35.0, 50.0]


def test_several_who_are_overtaken_drive_one_ahead_of_the_other() -> None:
    passes = tuple(Behavior(kind=BehaviorKind.OVERTAKE, target=name) for name in ('a', 'b'))
    ego = _agent('ego').model_copy(update={'behaviors': passes})
    places = _places(split_scene(_spec(ego, _agent('a'), _agent('b'))))
    assert (places['a'], places['b']) == ((20.0, 0), (35.0, 0))


def test_what_is_said_of_two_stands_before_what_is_guessed(parameter: Make) -> None:
    """Who overtakes comes from behind: how far is said by where the other one is."""
    ahead = _agent('a', (Relation.AHEAD, 'ego', 70.0), make=parameter)
    ego = _agent('ego', does=(BehaviorKind.OVERTAKE, 'a'))
    split = split_scene(_spec(ego, ahead))
    assert _places(split)['a'] == (70.0, 0)
    assert split.unsupported == ()


def test_a_vehicle_beside_which_a_person_is_met_is_on_the_way_there(parameter: Make) -> None:
    person = _agent('ped', (Relation.BEHIND, 'van', None), kind=AgentType.PEDESTRIAN)
    near = DistanceTrigger(on='distance_below', a='ego', b='ped', value_m=parameter(25.0))
    split = split_scene(_spec(EGO, _agent('van'), person, events=(Event(id='e1', trigger=near),)))
    assert _places(split)['van'][0] == 25.0 + 15.0


def test_who_only_waits_for_word_stands_behind_who_is_awaited() -> None:
    prompt = (
        'A drone hovers over City Hall at 60 m and alerts the ego car when a police car comes '
        'within 80 m of City Hall.'
    )
    spec = parse_offline(prompt, ParseContext(landmark_names=('City Hall',))).spec
    assert spec is not None
    along_m = {member.agent.id: member.offset_m for member in split_scene(spec).convoy}
    assert along_m['police1'] > along_m['ego']


def test_two_that_are_as_far_from_a_third_one_drive_abreast(parameter: Make) -> None:
    def explicit(value: float) -> Parameter:
        return parameter(value, explicit=True)

    ahead = (Relation.AHEAD, 'ego', 10.0)
    spec = _spec(
        _agent('ego'),
        *(_agent(f'b{k}', ahead, make=explicit, kind=AgentType.BICYCLE) for k in (1, 2, 3)),
    )
    assert _places(split_scene(spec)) == {
        'ego': (0.0, 0),
        'b1': (10.0, 0),
        'b2': (10.0, 1),
        'b3': (10.0, -1),
    }


@pytest.mark.parametrize(
    ('kind', 'relation', 'expected'),
    [
        (AgentType.BICYCLE, Relation.LEFT, {(1.6, 1), (-1.6, 1)}),
        (AgentType.CAR, Relation.RIGHT, {(3.5, -1), (-3.5, -1)}),
        (AgentType.CAR, Relation.BESIDE, {(0.0, 1), (0.0, -1)}),
    ],
)
def test_two_beside_one_spread_along_it_or_are_on_both_sides(
    kind: AgentType, relation: Relation, expected: set[tuple[float, int]]
) -> None:
    two = (_agent(f'c{k}', (relation, 'ego', None), kind=kind) for k in (1, 2))
    places = _places(split_scene(_spec(_agent('ego'), *two)))
    assert {places['c1'], places['c2']} == expected


@pytest.mark.parametrize(
    ('relation', 'parked', 'lanes'),
    [
        (Relation.BESIDE, 'van', 0),
        (Relation.RIGHT, 'van', 0),
        (Relation.LEFT, 'van', 1),
        (Relation.LEFT, 'ego', 0),
        (Relation.RIGHT, 'ego', -1),
    ],
)
def test_at_the_kerb_one_is_beside_who_is_in_the_lane(
    relation: Relation, parked: str, lanes: int
) -> None:
    spec = _spec(_agent('ego'), _agent('van', (relation, 'ego', None)))
    parks = (Behavior(kind=BehaviorKind.PARK),)
    agents = tuple(
        a.model_copy(update={'behaviors': parks}) if a.id == parked else a for a in spec.agents
    )
    split = split_scene(spec.model_copy(update={'agents': agents}))
    assert {m.agent.id: m.parked for m in split.convoy} == {
        'ego': parked == 'ego',
        'van': parked == 'van',
    }
    places = _places(split)
    assert places['van'][1] - places['ego'][1] == lanes


def test_who_follows_is_behind_whatever_else_brings_both_near_each_other() -> None:
    # The truck is told to be near the van, which hears it; the van follows the truck.
    near = Tie('truck1', 'van1', -20.0, 0, guess=True)
    follows = Tie('van1', 'truck1', -20.0, 0, free=True, guess=True)
    assert agreed([near, follows]) == [follows]
    assert agreed([follows, near]) == [follows]
    said = Tie('van1', 'truck1', 30.0, 0)
    assert agreed([near, follows, said]) == [said]


def test_who_is_only_told_something_by_a_uav_does_not_stand_before_who_sets_off() -> None:
    # The police car stays until the UAV has landed, the truck starts before.
    truck = _agent('truck1', (Relation.AT, 'intersection', None), kind=AgentType.TRUCK)
    police = _agent('police1', kind=AgentType.POLICE)
    starts = Event(id='e1', action=AgentAction(do='start', agent='truck1'))
    message = SendMessage(do='send_message', sender='uav1', receiver='police1')
    told = Event(id='e2', action=message)
    uav = Uav(id='uav1')
    places = _places(split_scene(_spec(truck, police, uavs=(uav,), events=(starts, told))))
    assert places['police1'][0] < places['truck1'][0]
