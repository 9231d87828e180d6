# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How vehicles drive that are to keep a distance on the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import sqrt

import pytest

from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]


@pytest.mark.parametrize(
    ('prompt', 'follower', 'leader'),
    [
        ('A car always stays 20 m behind a bus; a drone tracks the bus.', 'car1', 'bus1'),
        ('A car drives never more than 20 m ahead of a bus; a drone tracks it.', 'bus1', 'car1'),
        ('A truck drives 20 m behind a bus; a drone tracks the bus.', 'truck1', 'bus1'),
        ('A truck follows a motorcycle at 20 m; a drone tracks it.', 'truck1', 'motorcycle1'),
    ],
)
def test_who_keeps_a_distance_neither_falls_back_nor_closes_up(
    prompt: str,
    follower: str,
    leader: str,
    read_prompt: Read,
    ground: Ground,
    agent_types: Mapping[str, AgentTypeRecord],
) -> None:
    agents = {a.id: a for a in ground(read_prompt(prompt)).agents}
    own, other = agents[follower], agents[leader]
    apart = sqrt((own.x_m - other.x_m) ** 2 + (own.y_m - other.y_m) ** 2)
    gap = apart - (own.length_m + other.length_m) / 2.0
    # What the simulator adds at speed is left out of it.
    longer = (
        1.0 / agent_types[follower[:-1]].decel_mps2 - 1.0 / agent_types[leader[:-1]].decel_mps2
    )
    assert own.min_gap_m == pytest.approx(gap, abs=0.7 + 32.0 * max(0.0, longer))
    assert own.min_gap_m is not None
    assert own.min_gap_m <= gap + 0.1
    assert own.time_gap_s == pytest.approx(0.05)
    assert other.gentle_mps2 == agent_types[own.type_name].accel_mps2


def test_who_is_followed_at_a_distance_leaves_the_other_one_some_speed(
    read_prompt: Read, ground: Ground
) -> None:
    found = {a.id: a for a in ground(read_prompt('A car drives 20 m behind a bus.')).agents}
    assert found['bus1'].speed_factor < 0.8 * found['car1'].speed_factor
    found = {
        a.id: a for a in ground(read_prompt('A car drives at 9 m/s 20 m behind a bus.')).agents
    }
    assert found['bus1'].drive_speed_mps == pytest.approx(8.55)


def test_who_only_starts_at_a_distance_drives_as_its_type_does(
    read_prompt: Read, ground: Ground
) -> None:
    agents = ground(read_prompt('A car starts 20 m behind a bus; a drone tracks the bus.')).agents
    assert all(a.min_gap_m is None and a.gentle_mps2 is None for a in agents)
