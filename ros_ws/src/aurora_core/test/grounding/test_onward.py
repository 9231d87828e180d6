# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A route without a place begins where the mission before has led its UAV."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot

import pytest

from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.report.said_back import said_back
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]

PATTERNS = (
    'flies a rectangle of 80 by 50 m at 60 m',
    'flies a line of 100 m at 60 m',
    'flies a lawnmower pattern of 80 by 60 m at 60 m',
    'flies an orbit with a radius of 40 m at 60 m',
    'visits 5 waypoints at 60 m',
)


@pytest.mark.parametrize('pattern', PATTERNS)
def test_after_a_hover_it_begins_at_its_point(
    read_prompt: Read, ground: Ground, pattern: str
) -> None:
    spec = read_prompt(
        f'A drone hovers over Harbor Market at 60 m for 10 s, then {pattern}.', 'downtown'
    )
    said = next(one.text for one in said_back(spec) if one.id == spec.missions[-1].id)
    assert 'from where it is' in said
    hover, route = ground(spec, 'downtown').uavs[0].missions
    assert hover.hover_point is not None
    assert route.waypoints[0] == pytest.approx(hover.hover_point)


def test_after_a_way_it_begins_at_its_end_and_after_a_halt_there_too(
    read_prompt: Read, ground: Ground
) -> None:
    spec = read_prompt(
        'A drone flies from City Hall to Harbor Market at 60 m, then hovers for 10 s, then flies '
        'a line of 100 m at 60 m.',
        'downtown',
    )
    way, _, line = ground(spec, 'downtown').uavs[0].missions
    assert line.waypoints[0] == pytest.approx(way.waypoints[-1])


def test_after_a_tracking_it_begins_where_the_target_is_by_then(
    read_prompt: Read, ground: Ground
) -> None:
    """In 30 s at 6 m/s the van drives 180 m."""
    spec = read_prompt(
        'A drone tracks a van that drives at 6 m/s for 30 s at 60 m, then flies a line of 100 m '
        'at 60 m.',
        'downtown',
    )
    grounded = ground(spec, 'downtown')
    (van,) = grounded.agents
    _, line = grounded.uavs[0].missions
    x, y, _ = line.waypoints[0]
    assert 100.0 < hypot(x - van.x_m, y - van.y_m) < 200.0


def test_it_is_flown_as_high_as_its_uav_is_where_no_altitude_is_stated(
    read_prompt: Read, ground: Ground
) -> None:
    """Else it would sink by 70 m first, and be captured late."""
    spec = read_prompt(
        'A drone hovers over Harbor Market at 100 m for 10 s, then flies a line of 300 m.',
        'downtown',
    )
    hover, line = ground(spec, 'downtown').uavs[0].missions
    assert hover.hover_point is not None
    assert line.waypoints[0] == pytest.approx(hover.hover_point)
    assert {z for _, _, z in line.waypoints} == {100.0}
