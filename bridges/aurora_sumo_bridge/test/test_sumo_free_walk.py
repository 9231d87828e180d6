# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Persons who cross where no crosswalk is: exactly on their way, and drivers let them pass."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import FloatArray, GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundColumn
from aurora_sumo_bridge.sumo_client import SumoClient

Scene = Callable[..., GroundLoad]
Build = Callable[..., GroundAgentLoad]
Order = Callable[..., GroundCommand]
Run = Callable[..., list[FloatArray]]

EDGE = 'long_street_1_eb'
ACROSS_M = 14.0
# Where the person stands on the sidewalk (m).
AT_M = 90.0
X, Y, SPEED, HX, HY, PRESENT = (
    GroundColumn.X,
    GroundColumn.Y,
    GroundColumn.SPEED,
    GroundColumn.HEADING_X,
    GroundColumn.HEADING_Y,
    GroundColumn.PRESENT,
)


@pytest.fixture
def start(client: SumoClient, scene: Scene, walker: Build) -> tuple[float, float]:
    """Where the sidewalk is AT_M."""
    client.load(scene(walker('ann', edges=(EDGE,), lane_position_m=AT_M), map_name='junction'))
    x, y = client.state()[0, [X, Y]].tolist()
    return x, y


@pytest.fixture
def crossing(
    start: tuple[float, float], client: SumoClient, scene: Scene, walker: Build, vehicle: Build
) -> Callable[[float], SumoClient]:
    """Ann is to cross to the north; a car comes at 8 m/s, so far before her."""

    def build(away_m: float) -> SumoClient:
        x, y = start
        way = ((x, y), (x, y + ACROSS_M))
        ann = walker('ann', edges=(EDGE,), lane_position_m=AT_M, way_xy_m=way)
        car = vehicle(
            'car', edges=(EDGE,), lane_id=f'{EDGE}_1', lane_position_m=AT_M - away_m, speed_mps=8.0
        )
        client.load(scene(ann, car, map_name='junction'))
        return client

    return build


def test_a_person_walks_its_way_and_stands_at_its_end(
    crossing: Callable[[float], SumoClient],
    command: Order,
    run_on: Run,
    start: tuple[float, float],
) -> None:
    client = crossing(80.0)
    assert client.state()[0, [X, Y, HX, HY]].tolist() == pytest.approx([*start, 0.0, 1.0])
    held = [client.advance(1, (command(0, 'SET_SPEED', 0.0),)), *run_on(client, 20)]
    assert all(s[0, [X, Y, SPEED]].tolist() == [*start, 0.0] for s in held)
    walked = [client.advance(22, (command(0, 'SET_SPEED', 2.0),)), *run_on(client, 200)]
    steps = np.diff([s[0, Y] for s in walked[:130]])
    assert steps.tolist() == pytest.approx([0.1] * 129)
    assert {round(float(s[0, SPEED]), 6) for s in walked[:130]} == {2.0}
    assert walked[-1][0, [X, Y, SPEED, PRESENT]].tolist() == pytest.approx(
        [start[0], start[1] + ACROSS_M, 0.0, 1.0]
    )


def test_a_driver_stops_for_who_steps_out_and_drives_on(
    crossing: Callable[[float], SumoClient], command: Order, run_on: Run
) -> None:
    client = crossing(25.0)
    drive = (command(0, 'SET_SPEED', 1.4), command(1, 'SET_SPEED', 8.0))
    states = [client.advance(1, drive), *run_on(client, 400)]
    car = np.array([s[1, [X, SPEED]] for s in states])
    ann = np.array([s[0, [X, Y]] for s in states])
    lane_y = float(states[0][1, Y])
    on_lane = np.abs(ann[:, 1] - lane_y) < 1.0
    # The front of the car is half its length before its middle: it never gets to her.
    gaps = ann[on_lane, 0] - car[on_lane, 0] - 2.25
    assert gaps.min() > 1.0
    assert car[:, 1].min() < 2.0
    assert car[-1, 1] == pytest.approx(8.0, abs=0.1)
    assert np.diff(car[:, 1]).min() > -0.05 * 5.0


def test_a_driver_waits_for_nobody_who_stands_at_the_kerb(
    crossing: Callable[[float], SumoClient], command: Order, run_on: Run
) -> None:
    client = crossing(25.0)
    hold = (command(0, 'SET_SPEED', 0.0), command(1, 'SET_SPEED', 8.0))
    states = [client.advance(1, hold), *run_on(client, 100)]
    assert {round(float(s[1, SPEED]), 3) for s in states} == {8.0}


def test_a_driver_who_is_past_before_drives_on(
    crossing: Callable[[float], SumoClient], command: Order, run_on: Run
) -> None:
    client = crossing(4.0)
    slow = (command(0, 'SET_SPEED', 0.5), command(1, 'SET_SPEED', 8.0))
    states = [client.advance(1, slow), *run_on(client, 100)]
    assert {round(float(s[1, SPEED]), 3) for s in states} == {8.0}


@pytest.mark.parametrize('way', [((1.0, 1.0), (1.0, 1.0)), ((0.0, 0.0), (float('nan'), 1.0))])
def test_a_way_that_is_none_is_refused(
    client: SumoClient, scene: Scene, walker: Build, way: tuple[tuple[float, float], ...]
) -> None:
    ann = walker('ann', edges=(EDGE,), lane_position_m=AT_M, way_xy_m=way)
    with pytest.raises(GroundSimulatorError, match='way_xy_m'):
        client.load(scene(ann, map_name='junction'))
