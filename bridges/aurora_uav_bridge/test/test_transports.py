# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Transports: what they lose, and that they never block or raise for it."""

from __future__ import annotations

import socket
from collections.abc import Hashable

import numpy as np
import pytest

from aurora_uav_bridge.testing.lossy_transport import LossyTransport
from aurora_uav_bridge.transports import LoopbackTransport, UdpTransport


class Echo:
    """Answers with the same datagram, twice when asked to."""

    def __init__(self) -> None:
        self.seen: list[tuple[bytes, Hashable]] = []

    def handle(self, datagram: bytes, source: Hashable) -> list[bytes]:
        self.seen.append((datagram, source))
        return [datagram]


def test_loopback_answers_at_once_and_counts_empty_waits() -> None:
    echo = Echo()
    one, two = LoopbackTransport(echo), LoopbackTransport(echo)
    one.send(b'a')
    assert one.receive(1.0) == b'a'
    assert one.steady_time_s() == 0.0
    assert one.receive(1.0) is None
    assert one.steady_time_s() == 1.0
    two.send(b'b')
    # Each transport is a sender of its own.
    assert echo.seen[0][1] != echo.seen[1][1]
    two.close()
    assert two.receive(0.1) is None


def test_lossy_link_does_all_it_promises_and_is_seeded() -> None:
    def run(seed: int) -> list[bytes]:
        link = LossyTransport(
            LoopbackTransport(Echo()), np.random.Generator(np.random.PCG64(seed))
        )
        arrived = []
        for i in range(500):
            link.send(b'%05d' % i)
            while (datagram := link.receive(0.01)) is not None:
                arrived.append(datagram)
        return arrived

    arrived = run(1)
    assert arrived == run(1) != run(2)
    whole = [int(d) for d in arrived if len(d) == 5]
    assert len(set(whole)) < 500
    assert len(set(whole)) < len(whole)
    assert whole != sorted(whole)
    assert any(len(d) < 5 for d in arrived)


def test_lossy_link_without_faults_is_transparent() -> None:
    link = LossyTransport(
        LoopbackTransport(Echo()),
        np.random.Generator(np.random.PCG64(1)),
        loss=0.0,
        duplication=0.0,
        reordering=0.0,
        truncation=0.0,
    )
    link.send(b'x')
    assert link.receive(0.1) == b'x'
    assert link.receive(0.1) is None
    assert link.peer == 'uav_sim in this process'


def test_udp_round_trip_and_foreign_datagrams() -> None:
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger,
    ):
        server.bind(('127.0.0.1', 0))
        server.settimeout(5.0)
        link = UdpTransport(server.getsockname()[1])
        link.send(b'question')
        data, source = server.recvfrom(100)
        assert data == b'question'
        stranger.sendto(b'noise', source)
        server.sendto(b'answer', source)
        assert link.receive(5.0) == b'answer'
        assert link.receive(0.001) is None
        link.close()
        link.close()


def test_udp_without_a_server_waits_and_does_not_raise() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as unused:
        unused.bind(('127.0.0.1', 0))
        port = unused.getsockname()[1]
    link = UdpTransport(port)
    start_s = link.steady_time_s()
    for _ in range(3):
        link.send(b'anyone?')
        assert link.receive(0.01) is None
    # A refused datagram must not turn waiting into a tight loop.
    assert link.steady_time_s() - start_s >= 0.028
    assert link.peer == f'uav_sim at 127.0.0.1:{port}'
    link.close()


@pytest.mark.parametrize('wait_s', [0.0, -1.0])
def test_udp_with_no_time_left_returns_at_once(wait_s: float) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as server:
        server.bind(('127.0.0.1', 0))
        link = UdpTransport(server.getsockname()[1])
        assert link.receive(wait_s) is None
        link.close()
