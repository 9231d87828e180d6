# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who comes in at a stated speed, and who sets out for whom."""

from __future__ import annotations

from collections.abc import Callable

from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn
from aurora_core.spec.own_events import YIELDS_WITHIN_M

Agents = Callable[[str], dict[str, GroundedAgent]]


def test_a_stated_speed_is_driven_before_something_else_is_asked(agents: Agents) -> None:
    found = agents('My car drives at 10 m/s. After 5 s my car slows down to 5 m/s.')
    assert found['ego'].speed_mps == 10.0


def test_where_nothing_else_is_asked_one_starts_from_rest(agents: Agents) -> None:
    assert agents('My car drives at 10 m/s.')['ego'].speed_mps == 0.0


def test_who_waits_for_a_drone_starts_from_rest(agents: Agents) -> None:
    watched = 'A drone tracks my car at 40 m. '
    found = agents(watched + 'My car drives at 10 m/s. After my car stops, the drone lands.')
    assert found['ego'].speed_mps == 0.0


def test_who_follows_comes_in_as_fast(agents: Agents) -> None:
    found = agents('My car drives at 10 m/s. A van follows my car. After 8 s my car stops.')
    assert found['van1'].speed_mps == found['ego'].speed_mps == 10.0


def test_nobody_comes_in_faster_than_its_style_of_driving_allows(
    agents: Agents, map_of: Callable[[str], MapModel]
) -> None:
    """Who leads others slows them down; the simulator refuses a greater speed at t = 0."""
    turns = 'My car changes lane, slows down to 5 m/s and turns right at the intersection. '
    found = agents(f'My car drives at 11 m/s. {turns}A motorcycle follows my car.')
    assert found['ego'].speed_mps > 0.0
    for agent in found.values():
        limit_mps = map_of('downtown').network.lane(agent.lane_id).speed_limit_mps
        assert agent.speed_mps <= agent.speed_factor * limit_mps


def test_nobody_comes_in_too_fast_for_who_stands_ahead(agents: Agents) -> None:
    stands = 'A van waits 15 m ahead of my car. '
    found = agents(stands + 'My car drives at 10 m/s. After 5 s my car slows down to 5 m/s.')
    assert found['ego'].speed_mps == 0.0


def test_who_is_let_cross_sets_out_when_the_vehicle_is_near(agents: Agents) -> None:
    found = agents('A pedestrian crosses at the crosswalk. My car yields to the pedestrian.')
    person = found['pedestrian1']
    assert (person.release, person.release_agent) == (ReleaseOn.NEARED, 'ego')
    assert person.release_within_m == YIELDS_WITHIN_M
    assert found['ego'].release is ReleaseOn.START


def test_who_crosses_in_a_group_stops_before_nobody(agents: Agents) -> None:
    """The first one at the kerb goes farthest."""
    people = agents('Three pedestrians cross at the crosswalk.').values()
    first_at_kerb = sorted(people, key=lambda one: -one.lane_position_m)
    ways = [one.arrival_position_m for one in first_at_kerb]
    assert ways == sorted(ways, reverse=True)  # type: ignore[type-var]
    assert len(set(ways)) == 3
