# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The client against the simulator: in memory, over UDP, and over a link that loses everything."""

from __future__ import annotations

import itertools
import math
import os
import random
import subprocess
import sys
from collections.abc import Hashable, Iterator

import numpy as np
import pytest

from aurora_core.errors import AirSimulatorError, AuroraError
from aurora_core.ports.simulators import AirLoad, AirSimulator, FloatArray, UavHome
from aurora_core.trace.layout import (
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
)
from aurora_uav_bridge.errors import (
    CommandRangeError,
    CommandRefusedError,
    SessionLostError,
    SimulatorHeldError,
    SimulatorSilentError,
)
from aurora_uav_bridge.mavlink_client import MavlinkClient, random_nonce
from aurora_uav_bridge.testing.lossy_transport import LossyTransport
from aurora_uav_bridge.transports import (
    LoopbackTransport,
    SignedTransport,
    Transport,
    UdpTransport,
)
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.protocol import OWNER_SILENCE_S
from aurora_uav_sim.signed_server import SignedServer
from aurora_uav_sim.signing import Signer

DT_S = 0.05
NEVER = 10**9
# Tick after which the way north begins; the climb is over by then.
CLIMB = 160


def load_of(count: int = 1, seed: int = 1, gust_mps: float = 0.0, **changes: float) -> AirLoad:
    homes = tuple(
        UavHome(
            uav_id=f'uav_{i}', system_id=3 * i + 2, x_m=100.25 + 12.0 * i, y_m=-7.5,
            yaw_enu_rad=0.7 * i - 2.0,
        )
        for i in range(count)
    )  # fmt: skip
    return AirLoad(
        dt_s=DT_S, seed=seed, homes=homes, origin_lat_deg=48.1, origin_lon_deg=11.5,
        origin_alt_m=520.0, wind_gust_mps=gust_mps, **changes,
    )  # fmt: skip


def commands_of(load: AirLoad, tick: int, land_at: int = NEVER) -> FloatArray:
    """Take off to 10 m, fly north at 4 m/s, land."""
    commands = np.zeros((len(load.homes), UAV_COMMAND_WIDTH))
    for row, home in zip(commands, load.homes, strict=True):
        row[UavCommandColumn.X], row[UavCommandColumn.Y] = home.x_m, home.y_m
        row[UavCommandColumn.Z] = row[UavCommandColumn.TAKEOFF_ALTITUDE] = 10.0
        row[UavCommandColumn.YAW] = home.yaw_enu_rad
        row[UavCommandColumn.MODE] = UavMode.TAKEOFF
        if tick > CLIMB:
            row[UavCommandColumn.MODE] = UavMode.OFFBOARD
            row[UavCommandColumn.Y] += 4.0 * (tick - CLIMB) * DT_S
            row[UavCommandColumn.VY] = 4.0
        if tick > land_at:
            row[UavCommandColumn.MODE] = UavMode.LAND
    return commands


def fly(client: AirSimulator, load: AirLoad, ticks: int, land_at: int = NEVER) -> FloatArray:
    """Return the states (ticks + 1, M, UAV_WIDTH)."""
    client.load(load)
    states = [client.state()]
    states += [client.advance(k, commands_of(load, k, land_at)) for k in range(1, ticks + 1)]
    return np.array(states)


def loopback(server: SimServer | None = None) -> MavlinkClient:
    return MavlinkClient(LoopbackTransport(server or SimServer()))


@pytest.fixture(scope='module')
def udp_port() -> Iterator[int]:
    process = subprocess.Popen(
        [sys.executable, '-m', 'aurora_uav_sim.udp_main', '--port', '0'],
        stdout=subprocess.PIPE,
        text=True,
        env=dict(os.environ),
    )
    assert process.stdout is not None
    yield int(process.stdout.readline().rsplit(':', 1)[1])
    process.terminate()
    process.communicate(timeout=10.0)
    assert process.returncode == 0


@pytest.fixture(params=['memory', 'udp'])
def transport(request: pytest.FixtureRequest, udp_port: int) -> Transport:
    if request.param == 'udp':
        return UdpTransport(udp_port)
    return LoopbackTransport(SimServer())


def test_flies_a_whole_mission(transport: Transport) -> None:
    client = MavlinkClient(transport)
    load = load_of(2)
    states = fly(client, load, 900, land_at=300)
    client.close()
    assert states.shape == (901, 2, UAV_WIDTH)
    for i, home in enumerate(load.homes):
        start, cruise, end = states[0, i], states[300, i], states[-1, i]
        assert tuple(start[:3]) == (home.x_m, home.y_m, 0.0)
        yaw = 2.0 * math.atan2(start[UavColumn.QZ], start[UavColumn.QW])
        assert math.cos(yaw - home.yaw_enu_rad) == pytest.approx(1.0, abs=1e-9)
        assert cruise[UavColumn.MODE] == UavMode.OFFBOARD
        assert tuple(cruise[:3]) == pytest.approx(
            (home.x_m, home.y_m + 4.0 * (300 - CLIMB) * DT_S, 10.0), abs=0.5
        )
        assert tuple(cruise[3:6]) == pytest.approx((0.0, 4.0, 0.0), abs=0.1)
        assert end[UavColumn.Z] == 0.0
        assert (end[UavColumn.ARMED], end[UavColumn.LANDED]) == (0.0, 1.0)
    reported = [int(m) for m, _ in itertools.groupby(states[:, 0, UavColumn.MODE])]
    # Hold between the end of the climb and the first offboard command.
    assert reported == [
        UavMode.IDLE, UavMode.TAKEOFF, UavMode.HOLD, UavMode.OFFBOARD, UavMode.LAND, UavMode.IDLE,
    ]  # fmt: skip


def test_signatures_change_no_bit_of_a_flight() -> None:
    key = bytes(range(32))
    inner = LoopbackTransport(SignedServer(SimServer(), Signer(key)))
    signed = fly(MavlinkClient(SignedTransport(inner, Signer(key))), load_of(2, 3, 2.0), 200)
    assert np.array_equal(signed, fly(loopback(), load_of(2, 3, 2.0), 200))


@pytest.mark.parametrize('keys', [(bytes(32), None), (None, bytes(32)), (b'1' * 32, bytes(32))])
def test_ends_with_different_keys_do_not_fly(keys: tuple[bytes | None, bytes | None]) -> None:
    ours, theirs = keys
    server = SimServer()
    inner = LoopbackTransport(SignedServer(server, Signer(theirs)) if theirs else server)
    client = MavlinkClient(SignedTransport(inner, Signer(ours)) if ours else inner, timeout_s=0.5)
    with pytest.raises((SimulatorSilentError, CommandRefusedError)):
        client.load(load_of())


def test_memory_and_udp_give_the_same_bits(udp_port: int) -> None:
    load = load_of(2, gust_mps=3.0, wind_mean_east_mps=2.0)
    over_udp = MavlinkClient(UdpTransport(udp_port))
    states = fly(over_udp, load, 200)
    over_udp.close()
    assert fly(loopback(), load, 200).tobytes() == states.tobytes()


@pytest.mark.parametrize('seed', range(6))
def test_a_bad_link_gives_the_same_bits(seed: int) -> None:
    """20 % loss, duplication and reordering and 5 % truncation, each way."""
    load = load_of(2, gust_mps=3.0)
    clean = fly(loopback(), load, 260, land_at=200)
    rng = np.random.Generator(np.random.PCG64(seed))
    bad = MavlinkClient(LossyTransport(LoopbackTransport(SimServer()), rng))
    assert fly(bad, load, 260, land_at=200).tobytes() == clean.tobytes()


def test_a_bad_udp_link_gives_the_same_bits(udp_port: int) -> None:
    load = load_of(1)
    rng = np.random.Generator(np.random.PCG64(9))
    bad = MavlinkClient(LossyTransport(UdpTransport(udp_port), rng))
    states = fly(bad, load, 25)
    bad.close()
    assert fly(loopback(), load, 25).tobytes() == states.tobytes()


def test_a_warm_reset_is_a_fresh_start(transport: Transport) -> None:
    """Two runs in one client, the first broken off in the air, over a bad link."""
    rng = np.random.Generator(np.random.PCG64(4))
    client = MavlinkClient(LossyTransport(transport, rng, loss=0.05, duplication=0.05))
    load = load_of(2, gust_mps=3.0)
    fly(client, load_of(3, seed=5), 30)
    states = fly(client, load, 80)
    client.close()
    assert fly(loopback(), load, 80).tobytes() == states.tobytes()


def test_the_seed_moves_the_gusts_and_nothing_else_does() -> None:
    one = fly(loopback(), load_of(1, seed=1, gust_mps=3.0), 100)
    assert one.tobytes() == fly(loopback(), load_of(1, seed=1, gust_mps=3.0), 100).tobytes()
    assert one.tobytes() != fly(loopback(), load_of(1, seed=2, gust_mps=3.0), 100).tobytes()
    high = fly(loopback(), load_of(1, seed=1 + 2**63, gust_mps=3.0), 100)
    assert one.tobytes() != high.tobytes()
    # One vehicle's stream does not depend on how many fly.
    assert one[:, 0].tobytes() == fly(loopback(), load_of(3, gust_mps=3.0), 100)[:, 0].tobytes()


def test_states_are_copies() -> None:
    client = loopback()
    client.load(load_of())
    client.state()[:] = 99.0
    assert client.state()[0, UavColumn.Z] == 0.0


def test_no_uav_needs_no_simulator() -> None:
    client = MavlinkClient(LoopbackTransport(Deaf()))
    client.load(load_of(0))
    assert client.state().shape == (0, UAV_WIDTH)
    assert client.advance(1, np.zeros((0, UAV_COMMAND_WIDTH))).shape == (0, UAV_WIDTH)
    client.close()


class Deaf:
    """A simulator that hears until it does not."""

    def __init__(self, server: SimServer | None = None) -> None:
        self.server = server

    def handle(self, datagram: bytes, source: Hashable) -> list[bytes]:
        return self.server.handle(datagram, source) if self.server is not None else []


def test_a_silent_simulator_is_named_on_load() -> None:
    client = MavlinkClient(LoopbackTransport(Deaf()))
    with pytest.raises(SimulatorSilentError, match=r'uav_sim .* did not answer within 5 s') as e:
        client.load(load_of())
    assert (e.value.component, e.value.code) == ('uav_sim', 421)
    assert 'ros2 run' in e.value.hint
    with pytest.raises(AirSimulatorError, match='no load'):
        client.state()
    client.close()


def test_a_simulator_that_falls_silent_is_named() -> None:
    deaf = Deaf(SimServer())
    client = MavlinkClient(LoopbackTransport(deaf), timeout_s=2.0)
    load = load_of()
    fly(client, load, 5)
    deaf.server = None
    with pytest.raises(SimulatorSilentError, match=r'within 2 s \(step to tick 6\)'):
        client.advance(6, commands_of(load, 6))
    client.close()
    client.close()


def test_a_restarted_simulator_is_noticed() -> None:
    deaf = Deaf(SimServer())
    client = MavlinkClient(LoopbackTransport(deaf))
    load = load_of()
    fly(client, load, 5)
    deaf.server = SimServer()
    with pytest.raises(SessionLostError, match='no longer knows this run at tick 6'):
        client.advance(6, commands_of(load, 6))
    # And the next run works, though the new simulator counts its frames from 0.
    assert fly(client, load, 5).tobytes() == fly(loopback(), load, 5).tobytes()


def test_another_client_is_refused_while_the_owner_flies() -> None:
    server = SimServer()
    first, second = loopback(server), loopback(server)
    load = load_of()
    fly(first, load, 3)
    with pytest.raises(SimulatorHeldError, match='Held by loopback:') as caught:
        second.load(load)
    assert caught.value.hint
    first.advance(4, commands_of(load, 4))
    first.close()
    fly(second, load, 3)


def test_the_owner_may_load_again_without_leaving() -> None:
    client = loopback()
    load = load_of()
    first = fly(client, load, 10)
    assert fly(client, load, 10).tobytes() == first.tobytes()


class RunningTransport(LoopbackTransport):
    """Lets the simulator's time pass with that of the waits."""

    def __init__(self, server: SimServer) -> None:
        super().__init__(server)
        self._running = server

    def receive(self, timeout_s: float) -> bytes | None:
        answer = super().receive(timeout_s)
        self._running.poll(self.steady_time_s())
        return answer


def test_the_session_of_a_dead_owner_is_waited_for_and_taken() -> None:
    server = SimServer()
    server.poll(0.0)
    load = load_of()
    dead = loopback(server)
    fly(dead, load, 3)
    transport = RunningTransport(server)
    fly(MavlinkClient(transport), load, 3)
    assert OWNER_SILENCE_S < transport.steady_time_s() < OWNER_SILENCE_S + 1.0
    with pytest.raises(SessionLostError):
        dead.advance(4, commands_of(load, 4))


def test_an_owner_that_stands_by_keeps_its_session() -> None:
    server = SimServer()
    server.poll(0.0)
    load = load_of()
    owner = loopback(server)
    fly(owner, load, 3)
    for tenth in range(1, 200):
        if tenth % 5 == 0:
            owner.stand_by()
        server.poll(0.1 * tenth)
    with pytest.raises(SimulatorHeldError):
        loopback(server).load(load)
    owner.advance(4, commands_of(load, 4))


@pytest.mark.parametrize('bad', [math.nan, math.inf, 1e30])
def test_bad_numbers_are_refused_before_anything_is_sent(bad: float) -> None:
    client = loopback()
    load = load_of(2)
    states = fly(client, load, 3)
    commands = commands_of(load, 4)
    commands[1, UavCommandColumn.VZ] = bad
    with pytest.raises(CommandRangeError, match='command for uav_1 at tick 4, VZ: '):
        client.advance(4, commands)
    assert client.state().tobytes() == states[-1].tobytes()
    # The run can go on with good numbers, and nothing has moved meanwhile.
    after = client.advance(4, commands_of(load, 4))
    assert after.tobytes() == fly(loopback(), load, 4)[-1].tobytes()


def test_a_bad_load_is_refused() -> None:
    with pytest.raises(CommandRangeError, match='wind_gust_mps'):
        loopback().load(load_of(1, gust_mps=math.nan))


@pytest.mark.parametrize('tick', [0, 1, 2, 4])
def test_ticks_must_follow_each_other(tick: int) -> None:
    client = loopback()
    load = load_of()
    fly(client, load, 2)
    with pytest.raises(AirSimulatorError, match='expected tick 3 next'):
        client.advance(tick, commands_of(load, 3))


def test_advance_before_load_and_wrong_shapes_are_refused() -> None:
    client = loopback()
    with pytest.raises(AirSimulatorError, match='call load'):
        client.advance(1, np.zeros((1, UAV_COMMAND_WIDTH)))
    client.load(load_of())
    with pytest.raises(AirSimulatorError, match='expected shape'):
        client.advance(1, np.zeros((2, UAV_COMMAND_WIDTH)))
    client.close()
    with pytest.raises(AirSimulatorError, match='closed'):
        client.load(load_of())


def in_mode(load: AirLoad, tick: int, mode: UavMode) -> FloatArray:
    commands = commands_of(load, tick)
    commands[:, UavCommandColumn.MODE] = mode
    return commands


def test_a_refused_command_names_uav_command_and_reason() -> None:
    client = loopback()
    load = load_of()
    client.load(load)
    with pytest.raises(
        CommandRefusedError,
        match=r'set mode offboard of uav_0: .* TEMPORARILY_REJECTED: Offboard denied',
    ):
        client.advance(1, in_mode(load, 1, UavMode.OFFBOARD))


def test_idle_in_the_air_is_refused_and_on_the_ground_disarms() -> None:
    client = loopback()
    load = load_of()
    client.load(load)
    client.advance(1, in_mode(load, 1, UavMode.IDLE))
    client.advance(2, in_mode(load, 2, UavMode.TAKEOFF))
    state = client.advance(3, in_mode(load, 3, UavMode.TAKEOFF))
    assert state[0, UavColumn.ARMED] == 1.0
    state = client.advance(4, in_mode(load, 4, UavMode.LAND))
    k = 4
    while not state[0, UavColumn.LANDED]:
        k += 1
        state = client.advance(k, in_mode(load, k, UavMode.LAND))
    assert state[0, UavColumn.ARMED] == 1.0
    state = client.advance(k + 1, in_mode(load, k + 1, UavMode.IDLE))
    assert state[0, UavColumn.ARMED] == 0.0
    fly(client, load, 100)
    with pytest.raises(CommandRefusedError, match='uav_0: expected LAND before IDLE'):
        client.advance(101, in_mode(load, 101, UavMode.IDLE))


def test_offboard_from_the_ground_arms() -> None:
    client = loopback()
    load = load_of()
    client.load(load)
    client.advance(1, in_mode(load, 1, UavMode.IDLE))
    for k in range(2, 100):
        state = client.advance(k, in_mode(load, k, UavMode.OFFBOARD))
    assert state[0, UavColumn.Z] == pytest.approx(10.0, abs=0.5)


def test_closing_leaves_lockstep() -> None:
    server = SimServer((1, 2))
    client = loopback(server)
    fly(client, load_of(), 3)
    assert server.in_lockstep
    client.close()
    assert not server.in_lockstep


class Noisy:
    """A simulator whose every answer comes among rubbish."""

    def __init__(self) -> None:
        self.server = SimServer()
        self.rng = random.Random(3)

    def handle(self, datagram: bytes, source: Hashable) -> list[bytes]:
        rng = self.rng
        out = []
        for answer in self.server.handle(datagram, source):
            changed = bytearray(answer)
            changed[rng.randrange(len(changed))] ^= rng.randrange(1, 256)
            out += [rng.randbytes(50), bytes(changed), b'', answer]
        return out


def test_rubbish_from_the_simulator_side_is_harmless() -> None:
    load = load_of(2)
    states = fly(MavlinkClient(LoopbackTransport(Noisy())), load, 50)
    assert states.tobytes() == fly(loopback(), load, 50).tobytes()


def test_stray_datagrams_to_the_simulator_are_harmless() -> None:
    server = SimServer()
    rng = random.Random(8)
    client = loopback(server)
    load = load_of()
    client.load(load)
    states = [client.state()]
    for k in range(1, 51):
        server.handle(rng.randbytes(80), 'stranger')
        server.poll(0.01 * k)
        states.append(client.advance(k, commands_of(load, k)))
    assert np.array(states).tobytes() == fly(loopback(), load, 50).tobytes()


def test_nonces_differ_and_fit() -> None:
    nonces = {random_nonce() for _ in range(100)}
    assert len(nonces) > 90
    assert all(1 <= n < 2**24 for n in nonces)


def test_errors_are_one_family() -> None:
    for kind in (CommandRangeError, CommandRefusedError, SessionLostError, SimulatorSilentError):
        assert issubclass(kind, AuroraError)
        assert 420 < kind.default_code < 430
