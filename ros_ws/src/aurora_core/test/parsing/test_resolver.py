# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is meant: pronouns, second mentions, groups, and when to ask."""

from __future__ import annotations

import pytest

from aurora_core.outcomes.parse import ParseContext
from aurora_core.parsing.parser import parse_offline
from aurora_core.spec.scenario import ScenarioSpec

CONTEXT = ParseContext(landmark_names=('clock_tower',))


def _spec(prompt: str) -> ScenarioSpec:
    outcome = parse_offline(prompt, CONTEXT)
    assert outcome.spec is not None, outcome.question
    return outcome.spec


@pytest.mark.parametrize(
    ('prompt', 'target'),
    [
        ('A bus stops. A drone tracks it.', 'bus1'),
        ('A bus drives ahead of the ego car. A drone tracks the bus.', 'bus1'),
        ('A van stops. A bus drives. A drone tracks the vehicle.', 'bus1'),
        ('A drone tracks my truck.', 'ego'),
        ('A drone tracks our vehicle.', 'ego'),
        ('A drone tracks me.', 'ego'),
        ('The test car stops and a drone tracks it.', 'ego'),
        ('A red car and a blue car drive. A drone tracks the blue car.', 'car2'),
        ('A first van stops. A second van drives. A drone tracks the second van.', 'van2'),
        ('A pedestrian walks. A drone tracks her.', 'pedestrian1'),
    ],
)
def test_target_is_whom_the_words_mean(prompt: str, target: str) -> None:
    assert [m.target for m in _spec(prompt).missions] == [target]


def test_no_one_is_added_twice() -> None:
    spec = _spec('A bus stops. The bus waits. A drone tracks the bus while the bus drives.')
    assert [a.id for a in spec.agents] == ['bus1']


def test_another_one_is_new() -> None:
    spec = _spec('A bus stops and another bus follows the bus.')
    assert [a.id for a in spec.agents] == ['bus1', 'bus2']
    assert spec.agents[1].behaviors[0].target == 'bus1'


def test_members_of_a_group_are_told_apart() -> None:
    spec = _spec('Two drones: one tracks a bus, the other hovers over the clock tower.')
    assert [(m.uav, m.target) for m in spec.missions] == [
        ('uav1', 'bus1'),
        ('uav2', 'landmark:clock_tower'),
    ]


def test_background_cars_are_a_group_with_a_role() -> None:
    spec = _spec('Three background cars circulate.')
    assert {a.group for a in spec.agents} == {'car_group1'}
    assert [a.role.value for a in spec.agents] == ['background'] * 3


@pytest.mark.parametrize(
    ('prompt', 'asks'),
    [
        ('A bus follows a van. A drone tracks the vehicle.', 'the vehicle'),
        ('Two vans drive. A drone tracks the van.', 'the van'),
        ('The ego car follows another ego car.', 'another ego car'),
        ('A drone tracks it.', 'it'),
        ('An emergency vehicle stops.', 'police, ambulance, firetruck'),
        ('A van follows a truck. When the leader brakes, the van brakes.', 'leader'),
        ('It is sunny and it is snowing. A bus stops.', 'clear or snow'),
        ('A drone tracks something while two cars circulate.', 'tracked'),
        ('No drone. A drone tracks a bus.', 'UAV or not'),
        ('Follow the bus.', 'a UAV, or which vehicle'),
    ],
)
def test_questions(prompt: str, asks: str) -> None:
    outcome = parse_offline(prompt, CONTEXT)
    assert outcome.spec is None
    assert asks in (outcome.question or '')


def test_too_many_agents_stay_too_many() -> None:
    assert len(_spec('500 cars circulate.').agents) > 200
