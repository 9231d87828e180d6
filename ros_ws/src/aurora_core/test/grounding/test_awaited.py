# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whom an event waits for comes to where that can happen, and not before somebody looks."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import pytest

from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario, ReleaseOn
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Maps = Callable[[str], MapModel]

SCHOOL, STATION = 'landmark:Ridge School', 'landmark:Union Station'


def _agent(found: GroundedScenario, agent_type: str) -> GroundedAgent:
    return next(a for a in found.agents if a.type_name == agent_type)


@pytest.mark.parametrize(
    ('prompt', 'place', 'within_m'),
    [
        (
            'A drone hovers over Ridge School at 60 m. When it sees a police car, it lands.',
            SCHOOL,
            60.0,
        ),
        (
            'A drone hovers over City Hall at 40 m. When a bus comes within 80 m of '
            'Union Station, the drone lands.',
            STATION,
            80.0,
        ),
    ],
)
def test_the_way_leads_there_from_farther_off(
    prompt: str, place: str, within_m: float, read_prompt: Read, ground: Ground, map_of: Maps
) -> None:
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    assert isinstance(found, GroundedScenario), found
    agent = next(a for a in found.agents if not a.is_person)
    point = MapPlaces(map_of('downtown')).itself(place, (0.0, 0.0))
    line = Polyline(agent.route_xy_m)
    arc_m, _ = line.project(*point)
    assert dist(line.at(arc_m)[:2], point) <= within_m
    assert dist((agent.x_m, agent.y_m), point) > within_m


def test_who_is_to_be_seen_waits_until_the_uav_is_where_it_looks_from(
    read_prompt: Read, ground: Ground
) -> None:
    prompt = 'A drone hovers over Ridge School at 60 m. When it sees a police car, it lands.'
    police = _agent(ground(read_prompt(prompt, 'downtown'), 'downtown'), 'police')
    assert police.release is ReleaseOn.CAPTURED
    assert police.release_uav == 'uav1'


def test_a_person_who_is_to_be_seen_is_there(
    read_prompt: Read, ground: Ground, map_of: Maps
) -> None:
    prompt = 'A drone hovers over Ridge School at 60 m. When it sees a pedestrian, it lands.'
    person = _agent(ground(read_prompt(prompt, 'downtown'), 'downtown'), 'pedestrian')
    point = MapPlaces(map_of('downtown')).point(SCHOOL, (0.0, 0.0))
    assert dist((person.x_m, person.y_m), point) <= 50.0


def test_who_is_to_get_far_from_a_place_is_near_it_until_the_uav_hovers(
    read_prompt: Read, ground: Ground, map_of: Maps
) -> None:
    prompt = (
        'A drone hovers over Harbor Market at 50 m. When the van is more than 100 m away from '
        'Harbor Market, the drone lands.'
    )
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    van = _agent(found, 'van')
    market = MapPlaces(map_of('downtown')).itself('landmark:Harbor Market', (0.0, 0.0))
    assert dist((van.x_m, van.y_m), market) < 100.0
    assert dist(van.route_xy_m[-1], market) > 100.0
    assert van.release is ReleaseOn.CAPTURED


@pytest.mark.parametrize(
    'prompt',
    [
        'A truck drives at 40 km/h. When it passes City Hall, a drone starts tracking it at 35 m.',
        'When the bus stops at the crosswalk, a drone starts tracking it at 30 m height.',
        'When the cyclist reaches Meadow Park, a drone hovers over Meadow Park for 20 seconds.',
    ],
)
def test_nobody_waits_for_a_uav_that_waits_for_him_on_the_ground(
    prompt: str, read_prompt: Read, ground: Ground
) -> None:
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    assert isinstance(found, GroundedScenario), found
    (agent,) = found.agents
    assert agent.release is ReleaseOn.START
