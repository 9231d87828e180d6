# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is to see something for a time has it before its eyes, and leaves when it has."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario, ReleaseOn
from aurora_core.spec.parameter import Parameter, Provenance, Unit
from aurora_core.spec.requirements import StatedCondition
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]

FIVE_S = Parameter(value=5.0, unit=Unit.SECOND, low=0.0, high=60.0, provenance=Provenance.INFERRED)
PERSON = 'A pedestrian stands 25 m ahead of a car.'


@pytest.fixture
def looking(read_prompt: Read, ground: Ground) -> Callable[..., list[GroundedAgent]]:
    def agents(prompt: str, observer: str, target: str, op: str = '>=') -> list[GroundedAgent]:
        sees = StatedCondition.model_validate(
            {
                'id': 'c1', 'quantity': 'visible_time', 'of': (observer, target), 'op': op,
                'value': FIVE_S,
            }
        )  # fmt: skip
        spec = read_prompt(prompt, 'downtown')
        spec = spec.model_copy(update={'conditions': (*spec.conditions, sees)})
        found = {agent.id: agent for agent in ground(spec, 'downtown').agents}
        return [found[name] for name in (observer, target) if name in found]

    return agents


def test_a_driver_looks_at_a_person_before_it_leaves(
    looking: Callable[..., list[GroundedAgent]],
) -> None:
    car, person = looking(PERSON, 'car1', 'pedestrian1')
    assert (car.release, car.release_after_s) == (ReleaseOn.WAITED, 6.0)
    assert (person.x_m - car.x_m) * car.heading_x + (person.y_m - car.y_m) * car.heading_y > 0.0


def test_a_driver_looks_at_a_place_that_is_ahead(
    looking: Callable[..., list[GroundedAgent]], map_of: Callable[[str], MapModel]
) -> None:
    place = 'landmark:City Hall'
    (car,) = looking('A car is near City Hall.', 'car1', place)
    x, y = MapPlaces(map_of('downtown')).itself(place, (0.0, 0.0))
    assert (car.release, car.release_after_s) == (ReleaseOn.WAITED, 6.0)
    assert (x - car.x_m) * car.heading_x + (y - car.y_m) * car.heading_y > 0.0


@pytest.mark.parametrize(
    ('prompt', 'observer', 'target', 'op'),
    [
        (PERSON, 'car1', 'pedestrian1', '<='),
        ('A car drives past City Hall.', 'car1', 'landmark:City Hall', '>='),
        ('A van is 25 m behind a bus.', 'van1', 'bus1', '>='),
    ],
    ids=['at most', 'told to drive', 'at what drives'],
)
def test_nobody_else_waits(
    looking: Callable[..., list[GroundedAgent]], prompt: str, observer: str, target: str, op: str
) -> None:
    assert looking(prompt, observer, target, op)[0].release is ReleaseOn.START
