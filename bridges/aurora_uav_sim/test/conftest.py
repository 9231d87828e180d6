# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A small ground station on pymavlink alone, so that our own packing is not its own judge."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.mavlink_server import SimServer


class Station:
    """Talks to a server and keeps what comes back."""

    def __init__(self, server: SimServer, source: Hashable = 'station') -> None:
        self.server = server
        self.source = source
        self.mav = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self.reader = mavlink.MAVLink(None)
        self.reader.robust_parsing = True

    def parse(self, datagrams: list[bytes]) -> list[Any]:
        """Return the messages of some datagrams."""
        return [m for d in datagrams for m in self.reader.parse_buffer(bytearray(d)) or []]

    def pack(self, message: Any) -> bytes:
        """Return a frame with the next sequence number."""
        raw = bytes(message.pack(self.mav))
        self.mav.seq = (self.mav.seq + 1) % 256
        return raw

    def send(self, message: Any) -> list[Any]:
        """Send a message and return the answers."""
        return self.parse(self.server.handle(self.pack(message), self.source))

    def command(self, command: int, *parameters: float, system: int = 1) -> list[Any]:
        """Send a COMMAND_LONG and return all answers."""
        filled = [*parameters, *([0.0] * (7 - len(parameters)))]
        return self.send(mavlink.MAVLink_command_long_message(system, 1, command, 0, *filled))

    def result(self, command: int, *parameters: float, system: int = 1) -> int:
        """Send a COMMAND_LONG and return the result of its one acknowledgement."""
        answers = self.command(command, *parameters, system=system)
        (ack,) = [m for m in answers if m.get_type() == 'COMMAND_ACK']
        assert ack.command == command
        assert (ack.target_system, ack.target_component) == (255, 190)
        return int(ack.result)

    def poll(self, start_s: float, duration_s: float) -> list[Any]:
        """Let the server run and return what it streams to this station."""
        out: list[Any] = []
        for i in range(round(duration_s / 0.01) + 1):
            sent = self.server.poll(start_s + 0.01 * i)
            out.extend(self.parse([d for where, d in sent if where == self.source]))
        return out


@pytest.fixture
def server() -> SimServer:
    return SimServer((1, 2))


@pytest.fixture
def station(server: SimServer) -> Station:
    return Station(server)


@pytest.fixture
def other(server: SimServer) -> Station:
    return Station(server, 'other')
