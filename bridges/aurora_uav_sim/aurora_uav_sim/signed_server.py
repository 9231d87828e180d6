# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A `SimServer` that trusts nobody without the key, and signs what it says."""

from __future__ import annotations

from collections.abc import Hashable

from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.signing import Signer


class SignedServer:
    """The same datagrams in and out as of a `SimServer`.

    Args:
        server: The simulator.
        signer: Has the key.
    """

    def __init__(self, server: SimServer, signer: Signer) -> None:
        self._server = server
        self._signer = signer

    @property
    def in_lockstep(self) -> bool:
        """Whether a session is open."""
        return self._server.in_lockstep

    def handle(self, datagram: bytes, source: Hashable) -> list[bytes]:
        """Act on a datagram: on signed frames as ever, on unsigned ones as far as one may look."""
        signed, plain = self._signer.parts(datagram)
        out = self._server.handle(signed, source) if signed else []
        if plain:
            out = out + self._server.handle(plain, source, trusted=False)
        return [self._signer.sign(one) for one in out]

    def poll(self, wall_time_s: float) -> list[tuple[Hashable, bytes]]:
        """Let time pass and return the telemetry that is due, with its destinations."""
        return [(to, self._signer.sign(out)) for to, out in self._server.poll(wall_time_s)]
