# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What streets of real cities are like: slow, and with sidewalks shorter than a step."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.grounding.walk_ends import walk_end_m
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.walk_path import kerb_to_kerb
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]


@pytest.mark.parametrize('goal_m', [0.05, 0.15, 0.3, 1.0, 40.0])
@pytest.mark.parametrize('group', [1, 2, 5])
def test_a_walk_ends_on_its_sidewalk_however_short(goal_m: float, group: int) -> None:
    ends = [walk_end_m(goal_m, ahead, group) for ahead in range(group)]
    assert ends == sorted(ends, reverse=True)
    assert len(set(ends)) == group
    assert all(0.0 < end < goal_m for end in ends)


def test_nobody_crosses_from_a_stub_of_a_sidewalk(map_of: Callable[[str], MapModel]) -> None:
    """Who arrived on one of 20 cm was gone, and the run ended with an error."""
    network = map_of('helsinki').network
    walks = [kerb_to_kerb(network, crossing) for crossing in network.crossings]
    ends = [network.lane(i) for w in walks if w is not None for i in (w.lane_id, w.goal_lane_id)]
    assert min(lane.arc_length_m for lane in ends) >= 1.0
    assert min(lane.arc_length_m for lane in network.sidewalks) < 1.0
    assert len(ends) > 300


@pytest.mark.parametrize(
    ('name', 'mps', 'beyond'),
    [
        ('helsinki', 11.2, True),  # most streets allow 11.1 m/s, two short ones 13.9 m/s
        ('helsinki', 16.0, True),
        ('helsinki', 11.0, False),
        ('downtown', 16.0, False),
        ('downtown', 25.0, True),
    ],
)
def test_a_speed_that_no_street_allows_is_driven_beyond_the_limit(
    name: str,
    mps: float,
    beyond: bool,
    read_prompt: Read,
    ground: Ground,
    map_of: Callable[[str], MapModel],
) -> None:
    prompt = f'A car drives at {mps} m/s while a drone tracks it at 40 m for 20 seconds.'
    (car,) = ground(read_prompt(prompt, name), name).agents
    limits = [
        map_of(name).network.lane(map_of(name).network.edge(edge).lane_ids[-1]).speed_limit_mps
        for edge in car.edges
    ]
    if beyond:
        assert car.speed_factor * min(limits[:3]) >= mps - 0.05
    else:
        assert max(limits[:3]) >= mps - 0.05
        # Where it comes to a slower street it keeps its speed.
        assert car.speed_factor < mps / min(limits) + 0.2
