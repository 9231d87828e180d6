# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who begins near whom, and persons and vehicles that are placed by each other."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot

import pytest

from aurora_core.grounding.nearby import begins_near, in_order
from aurora_core.outcomes.grounded import GroundedScenario, ReleaseOn
from aurora_core.spec.scenario import Placement, ScenarioSpec
from aurora_core.spec.vocabulary import Relation

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]


def _placed(spec: ScenarioSpec, name: str, relation: str, of: str) -> ScenarioSpec:
    """Return a request in which an agent has one placement."""
    placement = Placement(relation=Relation(relation), of=of)
    agents = tuple(
        a.model_copy(update={'placements': (placement,)}) if a.id == name else a
        for a in spec.agents
    )
    return spec.model_copy(update={'agents': agents})


def test_who_tells_another_one_something_begins_near_it(read_prompt: Read, ground: Ground) -> None:
    spec = read_prompt('At 20 s the van sends a message to the truck.')
    assert set(begins_near(spec)) | set(begins_near(spec).values()) == {'van1', 'truck1'}
    van, truck = ground(spec).agents
    assert hypot(van.x_m - truck.x_m, van.y_m - truck.y_m) < 50.0


def test_who_is_seen_on_the_way_is_on_it(read_prompt: Read, ground: Ground) -> None:
    spec = read_prompt(
        'A UAV tracks the ego car. As soon as it sees a motorcycle, it alerts the ego car.'
    )
    assert begins_near(spec) == {'ego': 'motorcycle1'}
    first, second = ground(spec).agents
    assert hypot(first.x_m - second.x_m, first.y_m - second.y_m) < 50.0


@pytest.mark.parametrize('tracked', ['ego car', 'truck'])
def test_of_two_that_part_who_is_watched_stays_behind(tracked: str, read_prompt: Read) -> None:
    spec = read_prompt(
        f'A UAV tracks the {tracked}. When the truck is more than 80 m away from the ego car, '
        'the UAV lands.'
    )
    behind = {'ego car': 'ego', 'truck': 'truck1'}[tracked]
    assert list(begins_near(spec).values()) == [behind]


@pytest.mark.parametrize(('relation', 'sign'), [('ahead', 1.0), ('behind', -1.0)])
def test_a_vehicle_is_placed_by_a_person(
    relation: str, sign: float, read_prompt: Read, ground: Ground
) -> None:
    spec = read_prompt('A van drives. A pedestrian walks.')
    found = ground(_placed(spec, 'van1', relation, 'pedestrian1'))
    agents = {a.id: a for a in found.agents}
    van, person = agents['van1'], agents['pedestrian1']
    along_m = (van.x_m - person.x_m) * van.heading_x + (van.y_m - person.y_m) * van.heading_y
    assert 10.0 < sign * along_m < 30.0


def test_two_persons_walk_side_by_side(read_prompt: Read, ground: Ground) -> None:
    spec = read_prompt('Two pedestrians walk.')
    first, second = (a.id for a in spec.agents)
    asked = _placed(spec, first, 'beside', second)
    assert [a.id for a in in_order(asked.agents)] == [second, first]
    one, other = ground(asked).agents
    assert 0.5 < hypot(one.x_m - other.x_m, one.y_m - other.y_m) < 1.0
    assert {one.lateral_m, other.lateral_m} == {0.0, 0.65}


def test_who_is_told_something_at_a_stated_time_does_not_wait_for_a_uav(
    read_prompt: Read, ground: Ground
) -> None:
    found = ground(
        read_prompt(
            'A drone hovers over the intersection at 30 m. A pedestrian walks. At 20 s the '
            'pedestrian stops.'
        )
    )
    assert found.agents[0].release is ReleaseOn.START
