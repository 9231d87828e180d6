# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whom a person at a landmark waits for drives by there."""

from __future__ import annotations

from collections.abc import Callable

import shapely

from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.events import DistanceTrigger, Event, SendMessage
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec


def test_who_is_to_come_near_a_person_drives_by_there(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    parameter: Callable[..., Parameter],
) -> None:
    spec = read_prompt('A pedestrian stands at Harbor Market. A truck drives. A van drives.')
    told = Event(
        id='e1',
        trigger=DistanceTrigger(
            on='distance_below', a='truck1', b='pedestrian1', value_m=parameter(40.0)
        ),
        action=SendMessage(do='send_message', sender='pedestrian1', receiver='van1'),
    )
    asked = ScenarioSpec.model_validate({**dict(spec), 'events': (told,)})
    agents = {a.id: a for a in ground(asked, 'downtown').agents}
    person, truck = agents['pedestrian1'], agents['truck1']
    there = shapely.Point(person.x_m, person.y_m)
    assert there.distance(shapely.LineString(truck.route_xy_m)) <= 40.0
    assert there.distance(shapely.Point(truck.x_m, truck.y_m)) > 40.0
