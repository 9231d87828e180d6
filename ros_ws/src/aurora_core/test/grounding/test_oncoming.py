# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Oncoming vehicles stand in the other direction of the street, as far away as is asked."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import pytest

from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

TOWARDS = 'comes towards my car in the oncoming lane'


@pytest.mark.parametrize(
    ('map_name', 'prompt', 'away_m'),
    [
        ('downtown', 'An oncoming van is 80 m away from the ego car.', None),
        ('downtown', f'A motorcycle {TOWARDS}, 80 metres away.', 80.0),
        ('downtown', 'A drone tracks an oncoming truck; the ego car drives.', None),
        # There its way leaves the lane on which it would stand at the first places tried.
        ('junction', f'A motorcycle {TOWARDS}, 80 metres away.', 80.0),
    ],
)
def test_it_faces_the_other_one(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_name: str,
    prompt: str,
    away_m: float | None,
) -> None:
    found = ground(read_prompt(prompt, map_name), map_name)
    assert isinstance(found, GroundedScenario), found
    assert found.unsupported == ()
    ego = next(a for a in found.agents if a.role == 'ego')
    other = next(a for a in found.agents if a.role != 'ego')
    assert ego.heading_x * other.heading_x + ego.heading_y * other.heading_y < -0.9
    dx, dy = other.x_m - ego.x_m, other.y_m - ego.y_m
    assert dx * ego.heading_x + dy * ego.heading_y > 30.0
    aside = dy * ego.heading_x - dx * ego.heading_y
    assert 2.0 < aside < 20.0  # left of it: traffic keeps to the right
    if away_m is not None:
        assert dist((ego.x_m, ego.y_m), (other.x_m, other.y_m)) == pytest.approx(away_m, abs=1.0)


def test_a_roadside_unit_stands_at_the_intersection(
    read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> None:
    prompt = 'A roadside unit at the intersection warns the ego car when a van brakes.'
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    assert isinstance(found, GroundedScenario), found
    assert [(a.type_name, a.is_person) for a in found.agents if a.id == 'rsu1'] == [('rsu', True)]
    assert found.unsupported == ()
