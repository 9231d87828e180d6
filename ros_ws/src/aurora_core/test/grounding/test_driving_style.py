# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How vehicles drive behind others, and ahead of others that are to pass them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest

from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]


@pytest.fixture
def agents(read_prompt: Read, ground: Ground) -> Callable[[str], dict[str, GroundedAgent]]:
    def grounded(prompt: str) -> dict[str, GroundedAgent]:
        return {a.id: a for a in ground(read_prompt(prompt, 'downtown'), 'downtown').agents}

    return grounded


@pytest.mark.parametrize('kind', ['car', 'truck'])
def test_who_follows_somebody_slow_is_far_enough_behind(
    kind: str,
    agents: Callable[[str], dict[str, GroundedAgent]],
    agent_types: Mapping[str, AgentTypeRecord],
    tolerances: Tolerances,
) -> None:
    """The gap is judged from 2 m/s on, where the simulator's own is 4.5 m."""
    found = agents(f'A {kind} follows a bus.')[f'{kind}1']
    assert found.min_gap_m is not None
    gap_m = found.min_gap_m + agent_types[kind].headway_s * tolerances.follow_slow_mps
    assert gap_m > tolerances.follow_gap_moving_m[0]


def test_who_is_to_let_somebody_pass_is_slower_than_its_stated_speed(
    agents: Callable[[str], dict[str, GroundedAgent]],
    map_of: Callable[[str], MapModel],
) -> None:
    """Else it would draw away for good, and never yield."""
    found = agents(
        'A firetruck on an emergency run to Ridge School drives at 12 m/s. A car '
        'yields to the firetruck.'
    )
    network = map_of('downtown').network
    limits = [
        network.lane(lane.id).speed_limit_mps
        for lane in network.lanes.values()
        if lane.edge_id == found['car1'].edges[0]
    ]
    assert found['car1'].drive_speed_mps is None
    assert found['car1'].speed_factor * max(limits) < 0.8 * 12.0


def test_who_changes_lane_for_one_that_stops_then_is_not_at_a_junction(
    agents: Callable[[str], dict[str, GroundedAgent]],
    map_of: Callable[[str], MapModel],
) -> None:
    """At the pace of a convoy they are 220 to 290 m on by then, and well inside a street."""
    van = agents(
        'A van is 25 m behind a car. At 20 s the car stops. When the car is slower than 2 m/s, '
        'the van changes lane.'
    )['van1']
    network = map_of('downtown').network
    ends_m, reached_m = [], -van.lane_position_m
    for edge in van.edges:
        lanes = (lane for lane in network.lanes.values() if lane.edge_id == edge)
        reached_m += max(lane.arc_length_m for lane in lanes)
        ends_m.append(reached_m)
    assert not any(220.0 < end_m < 280.0 for end_m in ends_m), ends_m
