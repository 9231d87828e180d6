# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What waits for another part of the scenario does so in the run, not in the plan alone."""

from __future__ import annotations

from pathlib import Path

import pytest

import aurora


@pytest.mark.parametrize(
    ('prompt', 'condition'),
    [
        # The bus that ends the flight waits until there was a whole orbit to see.
        (
            'A drone orbits Harbor Market with a 60 m radius at 70 m; when a bus arrives at Union '
            'Station the drone lands.',
            'm1.turn',
        ),
        # The car waits until the person has left the street, not until it has stepped onto it.
        (
            'A pedestrian crosses the road after 8 s. The car only starts when the pedestrian has '
            'finished crossing.',
            'e2.not_before',
        ),
        # A message at the end of the missions is sent when they are over, not a tick before.
        (
            'A drone tracks the van for 10 s. When the drone has finished, it sends a message to '
            'the police car.',
            'e1.not_before',
        ),
        # The ambulance drives before it is told something upon which it slows down.
        (
            'The truck sends a message to the ambulance. Then the ambulance slows down.',
            'e2.within',
        ),
    ],
)
def test_a_wait_is_carried_out(here: Path, prompt: str, condition: str) -> None:
    with aurora.Session(out='runs') as session:
        done = session.run(prompt)
    assert done.status == 'verified', done.conditions
    assert condition in {c.id for c in done.conditions}


@pytest.mark.parametrize(
    ('prompt', 'condition'),
    [
        # A bus is slow: it comes nearer to who drives slower, from where there is room for it.
        ('A bus approaches the ego car.', 'bus1.approach'),
        # It brakes by itself, and not only where a red light or a corner makes it.
        ('A truck brakes hard while a drone tracks the truck.', 'truck1.brake'),
        # No faster than the drone can fly, where nobody says how fast.
        ('A drone tracks a police car on an emergency run for 20 s.', 'police1.emergency_run'),
        ('Two motorcycles come from the opposite side of the ego car.', 'motorcycle2.placed'),
        # Of two that drive beside one another, who is told no speed keeps level.
        (
            'A cyclist rides on the right of a car at 4 m/s. A drone tracks the car.',
            'bicycle1.placed.kept',
        ),
        ('A motorcycle drives beside the ego car at 8 m/s.', 'motorcycle1.placed.kept'),
    ],
)
def test_what_is_said_of_somebody_is_done(here: Path, prompt: str, condition: str) -> None:
    with aurora.Session(out='runs') as session:
        done = session.run(prompt)
    assert done.status == 'verified', done.conditions
    assert condition in {c.id for c in done.conditions}
