# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Walkers walk at the asked speed, never vanish and never jump."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import FloatArray, GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundColumn
from aurora_sumo_bridge.sumo_client import SumoClient

Scene = Callable[..., GroundLoad]
Build = Callable[..., GroundAgentLoad]
Order = Callable[..., GroundCommand]
RunOn = Callable[..., list[FloatArray]]

X, Y, SPEED, PRESENT = (
    GroundColumn.X,
    GroundColumn.Y,
    GroundColumn.SPEED,
    GroundColumn.PRESENT,
)
EDGE = 'long_street_1_eb'
START_X_M = -150.0
TYPE_SPEED_MPS = 1.4


@pytest.fixture
def walking(client: SumoClient, scene: Scene, walker: Build) -> SumoClient:
    """One walker from 40 m to 60 m of the sidewalk."""
    ann = walker('ann', edges=(EDGE,), lane_position_m=40.0, arrival_position_m=60.0)
    client.load(scene(ann, map_name='junction'))
    return client


def test_a_walker_keeps_its_pace_and_stands_at_its_goal(
    walking: SumoClient, run_on: RunOn
) -> None:
    states = run_on(walking, 600)
    assert {round(float(s[0, SPEED]), 6) for s in states[:250]} == {TYPE_SPEED_MPS}
    assert states[-1][0, SPEED] == 0.0
    assert states[-1][0, PRESENT] == 1.0
    assert states[-1][0, X] == pytest.approx(START_X_M + 60.0, abs=0.6)
    assert states[-1].tolist() == states[-100].tolist()


def test_a_walker_without_a_goal_stands_exactly(
    client: SumoClient, scene: Scene, walker: Build, run_on: RunOn
) -> None:
    client.load(
        scene(
            walker('ann', edges=(EDGE,), lane_position_m=40.0),
            walker('bob', edges=(EDGE,), lane_position_m=100.0, parked=True),
            map_name='junction',
        )
    )
    start = client.state()
    assert run_on(client, 200)[-1].tolist() == start.tolist()


def test_speed_commands(walking: SumoClient, command: Order, run_on: RunOn) -> None:
    assert walking.advance(1, (command(0, 'SET_SPEED', 0.0),))[0, SPEED] == 0.0
    assert run_on(walking, 20)[-1][0, X] == START_X_M + 40.0
    walking.advance(22, (command(0, 'SET_SPEED', 2.5),))
    assert run_on(walking, 5)[-1][0, SPEED] == pytest.approx(2.5)
    walking.advance(28, (command(0, 'SET_SPEED_FACTOR', 0.5),))
    assert run_on(walking, 5)[-1][0, SPEED] == pytest.approx(0.5 * TYPE_SPEED_MPS)
    walking.advance(34, (command(0, 'SET_SPEED', 2.0), command(0, 'RELEASE_SPEED')))
    assert run_on(walking, 5)[-1][0, SPEED] == pytest.approx(0.5 * TYPE_SPEED_MPS)


def test_the_asked_speed_and_factor_hold_from_the_start(
    client: SumoClient, scene: Scene, walker: Build
) -> None:
    edges = (EDGE,)
    client.load(
        scene(
            walker(
                'ann', edges=edges, lane_position_m=20.0, arrival_position_m=90.0, speed_mps=2.0
            ),
            walker(
                'bob', edges=edges, lane_position_m=40.0, arrival_position_m=90.0, speed_factor=1.5
            ),
            map_name='junction',
        )
    )
    assert client.state()[0, SPEED] == 2.0
    state = client.advance(1, ())
    assert state[:, SPEED].tolist() == pytest.approx([2.0, 1.5 * TYPE_SPEED_MPS])


@pytest.mark.parametrize('arrival_m', [5.0, 130.0])
def test_a_new_walk_begins_on_the_spot(
    walking: SumoClient, command: Order, run_on: RunOn, arrival_m: float
) -> None:
    before = run_on(walking, 100)[-1]
    states = [walking.advance(101, (command(0, 'WALK', arrival_m, text=EDGE),))]
    states += run_on(walking, 1500)
    previous = before
    for state in states:
        assert state[0, PRESENT] == 1.0
        assert math.dist(previous[0, :2], state[0, :2]) <= TYPE_SPEED_MPS * 0.05 + 0.05
        previous = state
    assert states[-1][0, X] == pytest.approx(START_X_M + arrival_m, abs=0.6)


def test_a_walker_at_its_goal_walks_again_only_when_told_where(
    walking: SumoClient, command: Order, run_on: RunOn
) -> None:
    run_on(walking, 400)
    walking.advance(401, (command(0, 'SET_SPEED', 2.0),))
    at_goal = run_on(walking, 50)[-1]
    assert at_goal[0, SPEED] == 0.0
    walking.advance(452, (command(0, 'WALK', 80.0, text=EDGE),))
    assert run_on(walking, 20)[-1][0, SPEED] == pytest.approx(2.0)


def test_a_walk_to_where_it_is_just_stops(
    walking: SumoClient, command: Order, run_on: RunOn
) -> None:
    here = run_on(walking, 40)[-1][0, X] - START_X_M
    walking.advance(41, (command(0, 'WALK', here, text=EDGE),))
    state = run_on(walking, 100)[-1]
    assert state[0, PRESENT] == 1.0
    assert state[0, X] == pytest.approx(START_X_M + here, abs=0.2)


def test_a_walker_crosses_the_street_by_the_crossing(
    client: SumoClient, scene: Scene, walker: Build, run_on: RunOn
) -> None:
    # From the south side of Long Street to its north side, over the western arm.
    ann = walker(
        'ann',
        edges=(EDGE, 'long_street_1_wb'),
        lane_position_m=125.0,
        arrival_position_m=30.0,
    )
    client.load(scene(ann, map_name='junction'))
    states = run_on(client, 2400)
    assert states[0][0, Y] < -7.0
    assert states[-1][0, Y] > 7.0
    assert all(state[0, PRESENT] == 1.0 for state in states)


@pytest.mark.parametrize(
    ('value', 'text', 'why'),
    [
        (10.0, 'long_street_2_eb', f"must begin on the walker's edge '{EDGE}'"),
        (500.0, EDGE, 'ends before 500 m'),
        (10.0, f'{EDGE} nowhere', "no edge 'nowhere'"),
    ],
)
def test_walks_that_cannot_be(
    walking: SumoClient, command: Order, value: float, text: str, why: str
) -> None:
    with pytest.raises(GroundSimulatorError, match=f"'ann', WALK: .*{why}"):
        walking.advance(1, (command(0, 'WALK', value, text=text),))
    assert walking.advance(1, ())[0, SPEED] == pytest.approx(TYPE_SPEED_MPS)


@pytest.mark.parametrize('kind', ['CHANGE_LANE', 'SET_ROUTE', 'STOP_AT', 'SET_TIME_GAP', 'RESUME'])
def test_orders_for_drivers_are_refused(walking: SumoClient, command: Order, kind: str) -> None:
    with pytest.raises(GroundSimulatorError, match=f"'ann', {kind}: no command for this kind"):
        walking.advance(1, (command(0, kind, 1.0, text=EDGE),))


def test_a_walker_can_be_removed(walking: SumoClient, command: Order, run_on: RunOn) -> None:
    run_on(walking, 10)
    state = walking.advance(11, (command(0, 'REMOVE'),))
    assert state[0, PRESENT] == 0.0
    assert run_on(walking, 5)[-1].tolist() == state.tolist()


@pytest.mark.parametrize('place_m', [5.0, 13.6, 60.0, 100.0])
def test_who_stands_where_a_sidewalk_bends_stays(
    place_m: float, client: SumoClient, scene: Scene, walker: Build, run_on: RunOn
) -> None:
    # SUMO once took the jump to the spot for a walk back, and the person away.
    ann = walker('ann', edges=('ridge_road_1_eb',), lane_position_m=place_m)
    client.load(scene(ann, map_name='downtown'))
    start = client.state()
    states = run_on(client, 40)
    assert {float(s[0, PRESENT]) for s in states} == {1.0}
    assert states[-1][0, :2].tolist() == start[0, :2].tolist()


def test_two_stand_side_by_side(client: SumoClient, scene: Scene, walker: Build) -> None:
    client.load(
        scene(
            walker('ann', edges=(EDGE,), lane_position_m=40.0),
            walker('bob', edges=(EDGE,), lane_position_m=40.0, lateral_m=0.65),
            map_name='junction',
        )
    )
    ann, bob = client.state()
    assert bob[X] == pytest.approx(ann[X], abs=0.01)  # the street leads east
    assert bob[Y] - ann[Y] == pytest.approx(0.65, abs=0.01)
