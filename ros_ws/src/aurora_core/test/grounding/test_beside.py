# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flights on a side of a target are planned in the frame of its course."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, degrees, hypot, pi, sin

import numpy as np
import pytest

from aurora_core.grounding.beside import side_first, side_offsets, turned_along, with_turns
from aurora_core.knowledge.limits import Limits
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.planning.complete import complete
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import Side

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
DIRECTIONS = {
    Side.AHEAD: (1.0, 0.0),
    Side.LEFT: (0.0, 1.0),
    Side.BEHIND: (-1.0, 0.0),
    Side.RIGHT: (0.0, -1.0),
}


@pytest.mark.parametrize('side', list(Side))
def test_the_middle_of_a_side_comes_first_and_all_are_well_inside(side: Side) -> None:
    found = list(side_offsets(side, 20.0, (0, 1)))
    ahead, left = DIRECTIONS[side]
    assert found[0] == pytest.approx((20.0 * ahead, 20.0 * left), abs=1e-9)
    for x, y in found:
        assert hypot(x, y) == pytest.approx(20.0)
        assert x * ahead + y * left >= 20.0 * cos(30.0 * pi / 180.0)


@pytest.mark.parametrize('count', [2, 3])
def test_several_on_one_side_are_apart(count: int) -> None:
    spots = [next(iter(side_offsets(Side.BEHIND, 20.0, (own, count)))) for own in range(count)]
    assert len(spots) == count
    for k, a in enumerate(spots):
        for b in spots[k + 1 :]:
            assert hypot(a[0] - b[0], a[1] - b[1]) >= 10.0


def test_a_place_on_the_left_is_on_the_left_of_every_heading() -> None:
    samples = np.array([[0.0, 0.0, 1.0, 0.0], [10.0, 5.0, 0.0, 1.0], [0.0, 0.0, -1.0, 0.0]])
    found = turned_along((0.0, 20.0), samples)
    assert found.tolist() == [[0.0, 20.0], [-10.0, 5.0], [0.0, -20.0]]


def test_bends_are_looked_at_in_between() -> None:
    straight = np.array([[0.0, 0.0, 1.0, 0.0], [5.0, 0.0, 1.0, 0.0]])
    assert with_turns(straight).tolist() == straight.tolist()
    bent = np.array([[0.0, 0.0, -1.0, 0.1], [5.0, 0.0, -1.0, -0.9]])
    bent[:, 2:] /= np.hypot(bent[:, 2], bent[:, 3])[:, None]
    found = with_turns(bent)
    assert len(found) > 8
    assert (found[0].tolist(), found[-1].tolist()) == (bent[0].tolist(), bent[1].tolist())
    steps = np.sum(found[1:, 2:] * found[:-1, 2:], axis=1)
    assert np.min(steps) >= cos(10.0 * pi / 180.0)
    assert np.hypot(found[:, 2], found[:, 3]) == pytest.approx(1.0)


def test_spots_on_the_side_come_first_in_their_order() -> None:
    spots = ((0.0, -5.0), (1.0, 30.0), (-40.0, 0.0), (5.0, 25.0))
    found = side_first(spots, (0.0, 0.0), (0.0, 20.0))
    assert found == ((1.0, 30.0), (5.0, 25.0), (0.0, -5.0), (-40.0, 0.0))


@pytest.mark.parametrize('side', list(Side))
def test_a_side_is_grounded_from_20_m_and_away_from_there(
    side: Side, read_prompt: Read, ground: Ground, limits: Limits
) -> None:
    spec = read_prompt('A drone tracks a van.', 'downtown')
    mission = spec.missions[0].model_copy(update={'side': side})
    asked = complete(spec.model_copy(update={'missions': (mission,)}), limits)
    standoff = asked.missions[0].standoff_m
    assert standoff is not None
    assert (standoff.value, standoff.low) == (20.0, 10.0)
    found = ground(asked, 'downtown')
    assert isinstance(found, GroundedScenario)
    (uav,), (van,) = found.uavs, found.agents
    plan = uav.missions[0]
    assert plan.offset_turns
    assert plan.standoff_m == 20.0
    x, y = plan.offset_from((van.heading_x, van.heading_y))
    off = degrees(atan2(y, x) - atan2(van.heading_y, van.heading_x)) - _angle(side)
    assert abs((off + 180.0) % 360.0 - 180.0) <= 30.0


def _angle(side: Side) -> float:
    ahead, left = DIRECTIONS[side]
    return degrees(atan2(left, ahead))


def test_an_offset_that_does_not_turn_stays_as_it_is(read_prompt: Read, ground: Ground) -> None:
    found = ground(read_prompt('A drone tracks a van from 35 m.', 'downtown'), 'downtown')
    plan = found.uavs[0].missions[0]
    assert not plan.offset_turns
    assert plan.offset_from((cos(1.0), sin(1.0))) == plan.offset_m
