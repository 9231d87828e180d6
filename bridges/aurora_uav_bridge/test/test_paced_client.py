# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Autopilots that keep their own time: in counted time, and a real process in real time."""

from __future__ import annotations

import subprocess
import sys
import time

import numpy as np
import pytest

from aurora_core.errors import AirSimulatorError, ConfigError
from aurora_core.ports.simulators import AirLoad, FloatArray, UavHome
from aurora_core.trace.layout import UAV_COMMAND_WIDTH, UavColumn, UavCommandColumn, UavMode
from aurora_uav_bridge.errors import CommandRefusedError, SessionLostError, SimulatorSilentError
from aurora_uav_bridge.paced_client import PacedClient
from aurora_uav_bridge.testing.virtual_time import VirtualTimeTransport
from aurora_uav_bridge.transports import LoopbackTransport, UdpTransport, autopilot_transport
from aurora_uav_sim.mavlink_server import SimServer

DT_S = 0.05
DRIFT_PPM, JITTER_S = 200.0, 0.03
HOMES = tuple(
    UavHome(uav_id=f'uav_{i}', system_id=i, x_m=100.0 * i, y_m=-50.0, yaw_enu_rad=0.0)
    for i in (1, 2)
)


def load_of(count: int = 1, **changes: float) -> AirLoad:
    return AirLoad(
        dt_s=DT_S, seed=1, homes=HOMES[:count], origin_lat_deg=48.0, origin_lon_deg=11.0, **changes
    )


def commands_of(count: int, tick: int, *, climb: int = 160, land_at: int = 10**9) -> FloatArray:
    """Take off to 10 m, fly north at 4 m/s, land."""
    commands = np.zeros((count, UAV_COMMAND_WIDTH))
    for row, home in zip(commands, HOMES, strict=False):
        row[UavCommandColumn.X], row[UavCommandColumn.Y] = home.x_m, home.y_m
        row[UavCommandColumn.Z] = row[UavCommandColumn.TAKEOFF_ALTITUDE] = 10.0
        row[UavCommandColumn.YAW] = np.pi / 2.0
        row[UavCommandColumn.MODE] = UavMode.TAKEOFF
        if tick > climb:
            row[UavCommandColumn.MODE] = UavMode.OFFBOARD
            row[UavCommandColumn.Y] += 4.0 * (tick - climb) * DT_S
            row[UavCommandColumn.VY] = 4.0
        if tick > land_at:
            row[UavCommandColumn.MODE] = UavMode.LAND
    return commands


def late(count: int = 1, seed: int = 1) -> VirtualTimeTransport:
    return VirtualTimeTransport(
        SimServer(range(1, count + 1)), drift_ppm=DRIFT_PPM, jitter_s=JITTER_S, seed=seed
    )


def fly(client: PacedClient, count: int, ticks: int, land_at: int = 10**9) -> FloatArray:
    states = [client.state()]
    for tick in range(1, ticks + 1):
        states.append(client.advance(tick, commands_of(count, tick, land_at=land_at)))
    return np.array(states)


def test_a_minute_beside_a_clock_that_drifts_behind_a_late_link() -> None:
    """Offset and drift are near the truth, and it says how near."""
    transport = late(2)
    client = PacedClient(transport)
    client.load(load_of(2))
    fly(client, 2, 1200)
    for clock in client.clocks():
        now_s = transport.steady_time_s()
        off_s = clock.offset_s - (transport.link.clock_s(now_s) - now_s)
        assert abs(off_s) < 1.5e-3
        assert abs(off_s) < clock.uncertainty_s < 0.012
        assert abs(clock.drift_ppm - DRIFT_PPM) < 2.5 * clock.drift_sigma_ppm < 50.0
        assert clock.steps == 0
        assert clock.latest_s < 0.15
    client.close()


def test_states_are_those_of_their_ticks() -> None:
    """By the clock's own time: stamped by their arrival they would be off by metres per second."""
    transport = late()
    client = PacedClient(transport)
    client.load(load_of())
    states = fly(client, 1, 400)[:, 0]
    client.close()
    # Steadily northwards: a state d seconds off its tick lies 4 d metres off the straight line.
    flown = states[280:]
    north_m = flown[:, UavColumn.Y] - 4.0 * DT_S * np.arange(len(flown))
    assert np.ptp(north_m) < 0.1
    steps = np.diff(states[:, UavColumn.X : UavColumn.Z + 1], axis=0)
    told = states[:, UavColumn.VX : UavColumn.VZ + 1]
    told = 0.5 * (told[1:] + told[:-1]) * DT_S
    assert np.abs(steps - told).max() < 0.02


def test_it_stands_where_the_scenario_wants_it_and_lands_disarmed() -> None:
    transport = late(2)
    client = PacedClient(transport)
    client.load(load_of(2))
    states = fly(client, 2, 700, land_at=350)
    client.close()
    for i, home in enumerate(HOMES):
        first, last = states[0, i], states[-1, i]
        assert first[UavColumn.X : UavColumn.Z + 1] == pytest.approx([home.x_m, home.y_m, 0.0])
        assert first[UavColumn.LANDED] == last[UavColumn.LANDED] == 1.0
        assert states[:, i, UavColumn.Z].max() == pytest.approx(10.0, abs=0.5)
        assert last[UavColumn.Z] == pytest.approx(0.0, abs=0.1)
        assert last[UavColumn.ARMED] == 0.0
        assert {UavMode.TAKEOFF, UavMode.OFFBOARD, UavMode.LAND} <= set(
            states[:, i, UavColumn.MODE]
        )


def test_who_is_left_in_the_air_lands() -> None:
    server = SimServer((1,))
    transport = VirtualTimeTransport(server)
    client = PacedClient(transport)
    client.load(load_of())
    fly(client, 1, 250)
    client.close()
    for _ in range(4000):
        transport.receive(0.01)
    assert server.vehicles[1].autopilot.landed
    assert not server.vehicles[1].autopilot.armed


def test_who_flies_already_is_not_taken() -> None:
    transport = late()
    client = PacedClient(transport)
    client.load(load_of())
    fly(client, 1, 200)
    with pytest.raises(CommandRefusedError, match='on the ground and disarmed'):
        PacedClient(transport).load(load_of())


def test_a_stated_wind_is_refused() -> None:
    """The world of an autopilot has its own: what the request states would not happen."""
    with pytest.raises(AirSimulatorError, match='wind'):
        PacedClient(late()).load(load_of(wind_mean_east_mps=3.0))


def test_nobody_there_is_said() -> None:
    client = PacedClient(UdpTransport(9), timeout_s=0.2)
    with pytest.raises(SimulatorSilentError, match='did not answer'):
        client.load(load_of())
    client.close()
    two = PacedClient(VirtualTimeTransport(SimServer((1,))))
    with pytest.raises(SimulatorSilentError, match='system ids'):
        two.load(load_of(2))


def test_an_autopilot_that_starts_again_ends_the_run() -> None:
    server = SimServer((1,))
    client = PacedClient(VirtualTimeTransport(server))
    client.load(load_of())
    fly(client, 1, 200)
    server.vehicles[1].restart()
    with pytest.raises(SessionLostError, match='went back'):
        fly_on(client, 200)


def fly_on(client: PacedClient, tick: int) -> None:
    for k in range(1, 200):
        client.advance(tick + k, commands_of(1, tick + k))


def test_a_link_in_the_process_is_enough_to_be_refused_wrong_commands() -> None:
    client = PacedClient(LoopbackTransport(SimServer((1,))))
    with pytest.raises(AirSimulatorError, match='load'):
        client.state()
    with pytest.raises(AirSimulatorError, match='expected tick 0'):
        client.advance(5, commands_of(1, 5))


@pytest.mark.parametrize('url', ['127.0.0.1:14540', 'udp://127.0.0.1', 'tcp://a:1', 'udp://:1'])
def test_what_is_no_address_is_refused(url: str) -> None:
    with pytest.raises(ConfigError, match='udp://'):
        autopilot_transport(url)


def test_a_real_process_in_real_time() -> None:
    """200 ppm and 30 ms, three seconds: the machine's steady clock is the same for both.

    A simulator that gets no processor for a quarter of a second lets its clock stand still: then
    what is true is not known here, and it is tried again.
    """
    tried = []
    for _ in range(3):
        off_s, uncertainty_s = _real_process()
        tried.append((off_s, uncertainty_s))
        if abs(off_s) < uncertainty_s < 0.05:
            return
    raise AssertionError(f'offset off by, and stated (s): {tried}')


def _real_process() -> tuple[float, float]:
    """Return what the estimated offset is wrong by, and what it says that it may be."""
    with subprocess.Popen(
        [
            sys.executable, '-m', 'aurora_uav_sim.udp_main', '--port', '0',
            '--clock-drift', '200', '--jitter', '30', '--jitter-seed', '4',
        ],
        stdout=subprocess.PIPE,
        text=True,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        try:
            said = process.stdout.readline()
            start_s = float(said.split('CLOCK_MONOTONIC ')[1].split(',')[0])
            port = int(process.stdout.readline().rpartition(':')[2])
            client = PacedClient(UdpTransport(port))
            client.load(load_of())
            for tick in range(1, 60):
                state = client.advance(tick, commands_of(1, tick))
            (clock,) = client.clocks()
            now_s = time.monotonic()
            client.close()
        finally:
            process.terminate()
    assert state[0, UavColumn.Z] > 1.0
    assert clock.round_trips > 100
    true_s = (1.0 + 200e-6) * (now_s - start_s) - now_s
    return clock.offset_s - true_s, clock.uncertainty_s
