# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every command does what it says, or is refused by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import FloatArray, GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundColumn, GroundCommandKind
from aurora_sumo_bridge.sumo_client import SumoClient

Scene = Callable[..., GroundLoad]
Build = Callable[..., GroundAgentLoad]
Order = Callable[..., GroundCommand]
RunOn = Callable[..., list[FloatArray]]

X, Y = GroundColumn.X, GroundColumn.Y
SPEED, ACCELERATION = GroundColumn.SPEED, GroundColumn.ACCELERATION
PRESENT = GroundColumn.PRESENT

EDGES = ('long_street_1_eb', 'long_street_2_eb')
LANE = 'long_street_1_eb_1'
START_X_M = -150.0


@pytest.fixture
def ego(vehicle: Build) -> Callable[..., GroundAgentLoad]:
    def build(**fields: Any) -> GroundAgentLoad:
        settings: dict[str, Any] = {
            'edges': EDGES,
            'lane_id': LANE,
            'lane_position_m': 20.0,
            'speed_mps': 10.0,
            'lane_change_mode': 512,
        }
        return vehicle('ego', **(settings | fields))

    return build


@pytest.fixture
def driving(client: SumoClient, scene: Scene, ego: Build) -> SumoClient:
    """A car at 10 m/s in the junction map."""
    client.load(scene(ego(), map_name='junction'))
    return client


def test_a_speed_is_reached_within_the_limits_and_released_again(
    driving: SumoClient, command: Order, run_on: RunOn
) -> None:
    state = driving.advance(1, (command(0, 'SET_SPEED', 5.0),))
    assert state[0, ACCELERATION] == pytest.approx(-4.5)
    assert run_on(driving, 40)[-1][0, SPEED] == pytest.approx(5.0)
    state = driving.advance(driving.tick + 1, (command(0, 'RELEASE_SPEED'),))
    assert state[0, ACCELERATION] == pytest.approx(2.6)


@pytest.mark.parametrize(
    ('kind', 'value'),
    [('SET_TIME_GAP', 0.8), ('SET_MIN_GAP', 1.5), ('SET_DECELERATION', 5.0), ('RESUME', 0.0)],
)
def test_the_speed_factor_moves_the_limit_and_survives_other_settings(
    driving: SumoClient, command: Order, run_on: RunOn, kind: str, value: float
) -> None:
    # SUMO forgets the factor when a setting of the vehicle's type changes after it.
    driving.advance(1, (command(0, 'SET_SPEED_FACTOR', 0.5), command(0, kind, value)))
    assert run_on(driving, 60)[-1][0, SPEED] == pytest.approx(0.5 * 13.89, abs=1e-6)


def test_the_asked_deceleration_is_reached(driving: SumoClient, command: Order) -> None:
    state = driving.advance(
        1, (command(0, 'SET_DECELERATION', 12.0), command(0, 'SET_SPEED', 0.0))
    )
    assert state[0, ACCELERATION] == pytest.approx(-12.0)


def test_a_lane_change_is_smooth_and_takes_its_time(
    driving: SumoClient, command: Order, run_on: RunOn
) -> None:
    first = driving.advance(1, (command(0, 'CHANGE_LANE', 2, value2=5.0),))
    states = [first, *run_on(driving, 79)]
    ys = np.array([state[0, Y] for state in states])
    assert ys[0] == pytest.approx(-4.95, abs=0.1)
    assert ys[-1] == pytest.approx(-1.65, abs=0.01)
    assert np.abs(np.diff(ys)).max() < 0.15


def test_a_stop_holds_the_centre_at_the_place_for_its_time(
    driving: SumoClient, command: Order, run_on: RunOn
) -> None:
    driving.advance(1, (command(0, 'STOP_AT', 100.0, value2=3.0, text=LANE),))
    states = run_on(driving, 500)
    stood = [state for state in states if state[0, SPEED] == 0.0]
    assert stood
    assert stood[0][0, X] == pytest.approx(START_X_M + 100.0, abs=0.2)
    assert len(stood) * 0.05 == pytest.approx(3.0, abs=0.3)


@pytest.mark.parametrize('ticks', [10, 260])
def test_resume_leaves_a_stop_before_and_after_it_is_reached(
    driving: SumoClient, command: Order, run_on: RunOn, ticks: int
) -> None:
    driving.advance(1, (command(0, 'STOP_AT', 80.0, value2=1000.0, text=LANE),))
    run_on(driving, ticks)
    driving.advance(driving.tick + 1, (command(0, 'RESUME'),))
    state = run_on(driving, 100)[-1]
    assert state[0, X] > START_X_M + 80.0 or state[0, PRESENT] == 0.0
    assert state[0, SPEED] > 1.0


def test_resume_without_a_stop_changes_nothing(driving: SumoClient, command: Order) -> None:
    assert driving.advance(1, (command(0, 'RESUME'),))[0, SPEED] > 10.0


def test_a_new_route_is_driven(driving: SumoClient, command: Order, run_on: RunOn) -> None:
    driving.advance(1, (command(0, 'SET_ROUTE', text='long_street_1_eb cross_street_1_sb'),))
    state = run_on(driving, 1200)[-1]
    assert state[0, PRESENT] == 0.0
    # Its last values are kept: it left at the southern end.
    assert state[0, Y] < -140.0
    assert abs(state[0, X]) < 3.0


def test_a_removed_agent_is_gone_at_once_and_orders_to_it_are_ignored(
    driving: SumoClient, command: Order
) -> None:
    before = driving.state()
    state = driving.advance(1, (command(0, 'REMOVE'),))
    assert state[0, PRESENT] == 0.0
    assert state[0, :PRESENT].tolist() == before[0, :PRESENT].tolist()
    for tick, kind in enumerate(GroundCommandKind, start=2):
        order = GroundCommand(agent=0, kind=kind, value=1.0, text='long_street_1_eb')
        assert driving.advance(tick, (order,)).tolist() == state.tolist()


def test_orders_in_the_tick_of_the_removal_are_ignored(
    driving: SumoClient, command: Order
) -> None:
    state = driving.advance(1, (command(0, 'REMOVE'), command(0, 'SET_SPEED', 3.0)))
    assert state[0, PRESENT] == 0.0


def test_a_vehicle_at_the_end_of_its_route_is_not_present(
    client: SumoClient, scene: Scene, ego: Build, run_on: RunOn
) -> None:
    client.load(scene(ego(edges=EDGES[:1], lane_position_m=120.0), map_name='junction'))
    states = run_on(client, 60)
    assert states[0][0, PRESENT] == 1.0
    assert states[-1][0, PRESENT] == 0.0
    assert states[-1][0, X] > START_X_M + 130.0
    assert np.isfinite(states[-1]).all()


@pytest.mark.parametrize(
    ('order', 'why'),
    [
        ({'kind': 'SET_ROUTE', 'text': 'cross_street_1_nb long_street_2_eb'}, 'current edge'),
        ({'kind': 'SET_ROUTE', 'text': 'long_street_1_eb nowhere'}, "no edge 'nowhere'"),
        ({'kind': 'SET_ROUTE', 'text': 'long_street_1_eb long_street_1_wb'}, 'not connected'),
        ({'kind': 'CHANGE_LANE', 'value': 3.0}, 'has lanes 0 to 2'),
        ({'kind': 'CHANGE_LANE', 'value': 0.0}, 'does not allow passenger'),
        ({'kind': 'STOP_AT', 'value': 50.0, 'text': 'nowhere_1'}, "no lane 'nowhere_1'"),
        ({'kind': 'STOP_AT', 'value': 138.0, 'text': LANE}, 'front bumper would stand at 140.30'),
        ({'kind': 'STOP_AT', 'value': 22.0, 'text': LANE}, 'SUMO refuses.*too close'),
        ({'kind': 'STOP_AT', 'value': 50.0, 'text': 'long_street_1_wb_1'}, 'SUMO refuses'),
        ({'kind': 'WALK', 'value': 50.0, 'text': 'long_street_1_eb'}, 'no command for this kind'),
    ],
)
def test_orders_that_do_not_fit_are_refused_by_name(
    driving: SumoClient, command: Order, order: dict[str, Any], why: str
) -> None:
    with pytest.raises(GroundSimulatorError, match=f"'ego', {order['kind']}: .*{why}"):
        driving.advance(1, (command(0, **order),))
    # Refused, not broken: the tick can be asked again.
    assert driving.tick == 0
    assert driving.advance(1, ())[0, SPEED] > 10.0


def test_one_bad_order_stops_all_of_its_tick(
    client: SumoClient, scene: Scene, ego: Build, command: Order
) -> None:
    client.load(scene(ego(), map_name='junction'))
    expected = client.advance(1, ())
    client.load(scene(ego(), map_name='junction'))
    orders = (command(0, 'SET_SPEED', 0.0), command(0, 'SET_SPEED', float('nan')))
    with pytest.raises(GroundSimulatorError, match='value nan'):
        client.advance(1, orders)
    assert client.advance(1, ()).tolist() == expected.tolist()


def test_a_parked_vehicle_can_be_held_and_removed_only(
    client: SumoClient, scene: Scene, ego: Build, command: Order
) -> None:
    client.load(scene(ego(parked=True, speed_mps=0.0), map_name='junction'))
    assert client.advance(1, (command(0, 'SET_SPEED', 0.0),))[0, PRESENT] == 1.0
    for kind in ('SET_SPEED', 'RELEASE_SPEED', 'SET_ROUTE', 'RESUME'):
        with pytest.raises(GroundSimulatorError, match=f"'ego', {kind}.*parked vehicle stands"):
            client.advance(2, (command(0, kind, 1.0, text='long_street_1_eb'),))
    assert client.advance(2, (command(0, 'REMOVE'),))[0, PRESENT] == 0.0
    assert client.advance(3, ())[0, PRESENT] == 0.0


def test_a_repeated_tick_does_not_step_and_a_gap_is_an_error(driving: SumoClient) -> None:
    start = driving.state()
    assert driving.advance(0, ()).tolist() == start.tolist()
    one = driving.advance(1, ())
    assert driving.advance(1, ()).tolist() == one.tolist()
    assert driving.tick == 1
    for tick in (3, 0, -1):
        with pytest.raises(GroundSimulatorError, match=f'asked for tick {tick} after tick 1'):
            driving.advance(tick, ())
    assert driving.advance(2, ())[0, X] > one[0, X]


def test_the_caller_cannot_reach_into_the_state(driving: SumoClient) -> None:
    driving.state()[:] = np.nan
    driving.advance(1, ())[:] = np.nan
    assert np.isfinite(driving.state()).all()
