# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Client and simulator process over real sockets, and a proxy that spoils the link."""

from __future__ import annotations

import random
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_bridge.errors import SimulatorSilentError
from aurora_uav_bridge.mavlink_client import MavlinkClient
from aurora_uav_bridge.testing.bad_link import LinkFaults
from aurora_uav_bridge.testing.flight import commands_at, fly, load_of, simulator_process
from aurora_uav_bridge.testing.udp_proxy import UdpProxy
from aurora_uav_bridge.transports import LoopbackTransport, UdpTransport
from aurora_uav_sim import wire
from aurora_uav_sim.mavlink_server import SimServer

TICKS = 70
# Against a hang; 0.6 s on an idle machine.
BOUND_S = 60.0
BAD = LinkFaults(
    loss=0.2, duplication=0.2, reordering=0.2, truncation=0.1, corruption=0.1, delay_s=0.005
)


@pytest.fixture(scope='module')
def simulator() -> Iterator[int]:
    with simulator_process() as port:
        yield port


@pytest.fixture(scope='module')
def clean() -> bytes:
    """The flight as it is in memory."""
    return fly(MavlinkClient(LoopbackTransport(SimServer())), load_of(2), TICKS)


@pytest.mark.parametrize('seed', [1, 2, 3])
def test_a_bad_link_changes_no_bit(simulator: int, clean: bytes, seed: int) -> None:
    begin = time.monotonic()
    with UdpProxy(simulator, BAD, seed=seed) as proxy:
        client = MavlinkClient(UdpTransport(proxy.port))
        states = fly(client, load_of(2), TICKS)
        client.close()
        for link in (proxy.to_simulator, proxy.to_client):
            assert set(link.counts) == {
                'sent', 'loss', 'duplication', 'reordering', 'truncation', 'corruption'
            }  # fmt: skip
    assert states == clean
    assert time.monotonic() - begin < BOUND_S


def test_nothing_arrives_and_the_simulator_is_named_within_the_limit(
    simulator: int, clean: bytes
) -> None:
    load = load_of(2)
    with UdpProxy(simulator, LinkFaults()) as proxy:
        client = MavlinkClient(UdpTransport(proxy.port), timeout_s=0.5)
        fly(client, load, 5)
        proxy.set_faults(LinkFaults(loss=1.0))
        begin = time.monotonic()
        with pytest.raises(SimulatorSilentError, match=r'within 0.5 s \(step to tick 6\)') as e:
            client.advance(6, commands_at(load, 6))
        assert 0.5 <= time.monotonic() - begin < BOUND_S
        assert e.value.component == 'uav_sim'
        with pytest.raises(SimulatorSilentError, match='enter lockstep'):
            client.load(load)
        # Healed, the same client goes on with a new run.
        proxy.set_faults(LinkFaults())
        assert fly(client, load, TICKS) == clean
        client.close()


def test_only_one_way_is_dead(simulator: int) -> None:
    """The simulator moves on and the client never hears of it: an error, no wrong state."""
    load = load_of(1)
    with UdpProxy(simulator, LinkFaults()) as proxy:
        client = MavlinkClient(UdpTransport(proxy.port), timeout_s=0.3)
        fly(client, load, 5)
        before = client.state().tobytes()
        proxy.to_client.faults = LinkFaults(loss=1.0)
        with pytest.raises(SimulatorSilentError):
            client.advance(6, commands_at(load, 6))
        assert client.state().tobytes() == before
        client.close()


def test_clients_do_not_meet_in_the_proxy() -> None:
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server,
        UdpProxy(_bound(server), LinkFaults()) as proxy,
    ):
        clients = [UdpTransport(proxy.port) for _ in range(20)]
        sources = []
        for i, client in enumerate(clients):
            client.send(b'question %d' % i)
            data, source = server.recvfrom(100)
            assert data == b'question %d' % i
            sources.append(source)
        assert len(set(sources)) == len(clients)
        server.sendto(b'answer 19', sources[19])
        server.sendto(b'answer 18', sources[18])
        assert clients[18].receive(5.0) == b'answer 18'
        assert clients[19].receive(5.0) == b'answer 19'
        # The first ones are forgotten: they are no longer answered, and nothing breaks.
        server.sendto(b'answer 0', sources[0])
        assert clients[0].receive(0.05) is None
        for client in clients:
            client.close()
        server.sendto(b'nobody', sources[19])
        proxy.close()


def _bound(server: socket.socket) -> int:
    server.bind(('127.0.0.1', 0))
    server.settimeout(5.0)
    return int(server.getsockname()[1])


def junk(rng: random.Random) -> bytes:
    """Rubbish, or intact frames of any message with random numbers (NaN among them)."""
    if rng.random() < 0.3:
        return rng.randbytes(rng.randrange(1, 300))
    kind = rng.choice(list(mavlink.mavlink_map))
    payload = rng.choice((rng.randbytes(255), b'\xff' * 255, b'\x00\x00\xc0\x7f' * 60))
    return wire.pack(rng.randrange(256), rng.randrange(256), rng.randrange(256), kind, payload)


class Flooded(UdpTransport):
    """A link to a simulator that a stranger floods before every datagram of ours."""

    def __init__(self, port: int) -> None:
        super().__init__(port)
        self.port = port
        self.rng = random.Random(5)
        self.stranger = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.flooded = 0

    def send(self, datagram: bytes) -> None:
        for _ in range(20):
            self.stranger.sendto(junk(self.rng), ('127.0.0.1', self.port))
        self.flooded += 20
        super().send(datagram)

    def close(self) -> None:
        self.stranger.close()
        super().close()


def test_a_flood_of_junk_changes_no_bit(simulator: int, clean: bytes) -> None:
    link = Flooded(simulator)
    client = MavlinkClient(link)
    states = fly(client, load_of(2), TICKS)
    client.close()
    assert states == clean
    assert link.flooded >= 20 * TICKS


def test_junk_among_the_answers_changes_no_bit(clean: bytes) -> None:
    class Chatty:
        """A simulator whose answers come among intact frames of strangers."""

        def __init__(self) -> None:
            self.server = SimServer()
            self.rng = random.Random(6)

        def handle(self, datagram: bytes, source: object) -> list[bytes]:
            out = []
            for answer in self.server.handle(datagram, source):
                out += [*(self.stranger() for _ in range(3)), answer]
            return out

        def stranger(self) -> bytes:
            while True:
                noise = junk(self.rng)
                # Vehicles 1 and 3 and their autopilot are ours: only strangers here.
                if not any(
                    f.system_id in (1, 3) and f.component_id == 1 for f in wire.split(noise)
                ):
                    return noise

    client = MavlinkClient(LoopbackTransport(Chatty()))
    assert fly(client, load_of(2), TICKS) == clean


def test_the_program_serves_and_tells_what_it_did(simulator: int) -> None:
    process = subprocess.Popen(
        [sys.executable, '-m', 'aurora_uav_bridge.testing.udp_proxy', '--to', str(simulator),
         '--duplication', '1'],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    client = MavlinkClient(UdpTransport(int(process.stdout.readline())))
    fly(client, load_of(1), 3)
    client.close()
    process.send_signal(signal.SIGTERM)
    _, told = process.communicate(timeout=10.0)
    assert process.returncode == 0
    assert "'duplication'" in told
    assert 'Traceback' not in told
