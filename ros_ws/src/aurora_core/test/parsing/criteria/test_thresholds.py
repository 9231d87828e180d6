# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes that compare, in words that stand in any order."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.spec.scenario import (
    AltitudeTrigger,
    DistanceTrigger,
    ScenarioSpec,
    SpeedTrigger,
)

DISTANCES = [
    ('Whenever the room between the bus and the pedestrian is less than 12 m', True, 12.0),
    ('In case the bus and the pedestrian have fewer than 9 m between them', True, 9.0),
    ('Once the interval from the bus to the pedestrian is in excess of 40 m', False, 40.0),
]
SPEEDS = [
    ('In case the car is doing in excess of 15 m/s', 'speed_above', 15.0),
    ('If ever its pace is not below 14 m/s', 'speed_above', 14.0),
    ('Whenever its velocity amounts to less than 4 m/s', 'speed_below', 4.0),
]


@pytest.mark.parametrize(('cause', 'below', 'value_m'), DISTANCES)
def test_a_distance(
    cause: str, below: bool, value_m: float, read_prompt: Callable[..., ScenarioSpec]
) -> None:
    spec = read_prompt(f'A pedestrian walks. A bus drives at 8 m/s. {cause}, the bus brakes.')
    (event,) = spec.events
    assert isinstance(event.trigger, DistanceTrigger)
    assert {event.trigger.a, event.trigger.b} == {'bus1', 'pedestrian1'}
    assert (event.trigger.on == 'distance_below') is below
    assert event.trigger.value_m.value == value_m


@pytest.mark.parametrize(('cause', 'on', 'value_mps'), SPEEDS)
def test_a_speed(
    cause: str, on: str, value_mps: float, read_prompt: Callable[..., ScenarioSpec]
) -> None:
    spec = read_prompt(f'A drone tracks a bus. A car drives. {cause}, the drone alerts the bus.')
    (event,) = spec.events
    assert isinstance(event.trigger, SpeedTrigger)
    assert (event.trigger.on, event.trigger.who) == (on, 'car1')
    assert event.trigger.value_mps.value == value_mps


def test_a_height(read_prompt: Callable[..., ScenarioSpec]) -> None:
    spec = read_prompt(
        'A drone tracks a van at 50 m altitude. Whenever the height of the drone is in excess of '
        '45 m, the van brakes.'
    )
    (event,) = spec.events
    assert isinstance(event.trigger, AltitudeTrigger)
    assert (event.trigger.uav, event.trigger.value_m.value) == ('uav1', 45.0)
