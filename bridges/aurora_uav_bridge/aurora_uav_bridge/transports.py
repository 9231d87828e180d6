# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How datagrams reach the simulator and come back: UDP or memory."""

from __future__ import annotations

import itertools
import socket
import time
from collections import deque
from collections.abc import Hashable
from math import nan
from typing import Protocol
from urllib.parse import urlsplit

from aurora_core.errors import ConfigError
from aurora_uav_sim.signing import KEY_FILE_VARIABLE, KeyFileError, Signer, signer_from

_RECEIVE_BUFFER_BYTES = 1 << 20


class Transport(Protocol):
    """Datagrams to one simulator; any of them may be lost, doubled, late or cut."""

    @property
    def peer(self) -> str:
        """Name of the simulator for messages."""

    def send(self, datagram: bytes) -> None:
        """Send a datagram; a lost one is not an error."""

    def receive(self, timeout_s: float) -> bytes | None:
        """Return the next datagram, or None when none came within the time."""

    def steady_time_s(self) -> float:
        """Return a time that never jumps, for time limits."""

    def close(self) -> None:
        """Free the transport; safe to call twice."""


class UdpTransport:
    """UDP to a simulator process.

    Args:
        port: UDP port of the simulator (`aurora_uav_sim.protocol.mavlink_port`).
        host: Its address.
    """

    def __init__(self, port: int, host: str = '127.0.0.1') -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _RECEIVE_BUFFER_BYTES)
        # A connected socket takes datagrams from this peer alone.
        self._socket.connect((host, port))
        self._timeout_s = nan
        self._peer = f'uav_sim at {host}:{port}'

    @property
    def peer(self) -> str:
        """Name of the simulator for messages."""
        return self._peer

    def send(self, datagram: bytes) -> None:
        """Send a datagram; nobody listening yet is the same as a lost one."""
        try:
            self._socket.send(datagram)
        except ConnectionRefusedError:
            return

    def receive(self, timeout_s: float) -> bytes | None:
        """Return the next datagram, or None when none came within the time."""
        if timeout_s != self._timeout_s:
            self._timeout_s = timeout_s
            self._socket.settimeout(max(timeout_s, 1e-4))
        deadline_s = 0.0
        while True:
            try:
                return self._socket.recv(65536)
            except TimeoutError:
                return None
            except ConnectionRefusedError:
                # An earlier datagram met a closed port. Wait as if nothing had come, or the
                # caller would send again in a tight loop.
                now_s = time.monotonic()
                if deadline_s == 0.0:
                    deadline_s = now_s + timeout_s
                if now_s >= deadline_s:
                    return None
                self._timeout_s = nan
                self._socket.settimeout(max(deadline_s - now_s, 1e-4))

    def steady_time_s(self) -> float:
        """Return the system's monotonic time."""
        return time.monotonic()

    def close(self) -> None:
        """Close the socket; safe to call twice."""
        self._socket.close()


class DatagramServer(Protocol):
    """A simulator in the same process (`aurora_uav_sim.mavlink_server.SimServer`)."""

    def handle(self, datagram: bytes, source: Hashable) -> list[bytes]:
        """Act on a datagram and return the answers."""


class LoopbackTransport:
    """The same bytes without sockets: a datagram is answered while it is being sent.

    Time is counted in waits: an empty wait passes at once and adds its length, so that time
    limits still end, without anybody waiting.

    Args:
        server: The simulator.
    """

    _numbers = itertools.count(1)

    def __init__(self, server: DatagramServer) -> None:
        self._server = server
        self._source = ('loopback', next(self._numbers))
        self._inbox: deque[bytes] = deque()
        self._time_s = 0.0

    @property
    def peer(self) -> str:
        """Name of the simulator for messages."""
        return 'uav_sim in this process'

    def send(self, datagram: bytes) -> None:
        """Hand a datagram to the simulator and keep its answers."""
        self._inbox.extend(self._server.handle(datagram, self._source))

    def receive(self, timeout_s: float) -> bytes | None:
        """Return the next answer, or None at once."""
        if self._inbox:
            return self._inbox.popleft()
        self._time_s += max(timeout_s, 1e-4)
        return None

    def steady_time_s(self) -> float:
        """Return the sum of all empty waits."""
        return self._time_s

    def close(self) -> None:
        """Forget what was not read."""
        self._inbox.clear()


def autopilot_transport(url: str) -> Transport:
    """Return the way to autopilots, signed where `AURORA_MAVLINK_KEY_FILE` names a key.

    Args:
        url: `udp://HOST:PORT`.

    Raises:
        ConfigError: It is none, or the key cannot be read.
    """
    try:
        parts = urlsplit(url)
        port = parts.port
    except ValueError:
        port = None
    if not port or parts.scheme != 'udp' or not parts.hostname or parts.path or parts.query:
        raise ConfigError(
            f'expected an autopilot such as udp://127.0.0.1:14540, found {url!r}',
            hint='HOST and PORT are where it listens',
        )
    try:
        signer = signer_from()
        plain = UdpTransport(port, parts.hostname)
    except KeyFileError as err:
        raise ConfigError(str(err), hint=f'unset {KEY_FILE_VARIABLE}, or mend it') from err
    except OSError as err:
        raise ConfigError(f'{url}: {err.strerror or err}', hint='is the host name right?') from err
    return plain if signer is None else SignedTransport(plain, signer)


class SignedTransport:
    """Another transport, with signatures on what is sent and needed on what is taken.

    Args:
        inner: The transport; closed by `close`.
        signer: Has the key; shared by all transports of this process.
    """

    def __init__(self, inner: Transport, signer: Signer) -> None:
        self._inner = inner
        self._signer = signer

    @property
    def peer(self) -> str:
        """Name of the simulator for messages."""
        return f'{self._inner.peer} (signed)'

    def send(self, datagram: bytes) -> None:
        """Sign every frame and send."""
        self._inner.send(self._signer.sign(datagram))

    def receive(self, timeout_s: float) -> bytes | None:
        """Return what is signed of the next datagram, maybe nothing; None when none came."""
        datagram = self._inner.receive(timeout_s)
        return None if datagram is None else self._signer.signed_part(datagram)

    def steady_time_s(self) -> float:
        """Return the time of the inner transport."""
        return self._inner.steady_time_s()

    def close(self) -> None:
        """Close the inner transport; safe to call twice."""
        self._inner.close()
