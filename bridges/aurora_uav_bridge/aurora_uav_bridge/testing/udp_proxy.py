# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A UDP proxy between a MAVLink client and the simulator that makes the link bad on purpose.

    python -m aurora_uav_bridge.testing.udp_proxy --listen 9001 --to 7600 --loss 0.2

Each client gets a socket of its own towards the simulator, as if it spoke to it directly.
"""

from __future__ import annotations

import argparse
import heapq
import itertools
import selectors
import signal
import socket
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import fields
from types import TracebackType

import numpy as np

from aurora_uav_bridge.testing.bad_link import BadLink, LinkFaults

LOOPBACK = '127.0.0.1'
_RECEIVE_BUFFER_BYTES = 1 << 20
# Clients come and go with their runs; the one silent for longest is forgotten.
_MOST_CLIENTS = 16

Send = Callable[[bytes], None]
Address = tuple[str, int]


class UdpProxy:
    """Passes datagrams on, both ways, through two bad links; served by a thread of its own.

    Args:
        to_port: UDP port of the simulator on 127.0.0.1.
        faults: What happens on the way to the simulator and back.
        seed: Of the random numbers.
        port: UDP port to listen on; 0 takes a free one.

    Attributes:
        port: Where clients find the proxy.
        to_simulator: The link one way.
        to_client: The link the other way.
    """

    def __init__(self, to_port: int, faults: LinkFaults, *, seed: int = 1, port: int = 0) -> None:
        there, back = np.random.SeedSequence(seed).spawn(2)
        self.to_simulator = BadLink(faults, np.random.Generator(np.random.PCG64(there)))
        self.to_client = BadLink(faults, np.random.Generator(np.random.PCG64(back)))
        self._to = (LOOPBACK, to_port)
        self._front = _socket()
        self._front.bind((LOOPBACK, port))
        self.port = int(self._front.getsockname()[1])
        self._clients: dict[Address, socket.socket] = {}
        self._late: list[tuple[float, int, bytes, Send]] = []
        self._numbers = itertools.count()
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._front, selectors.EVENT_READ)
        self._wake, self._woken = socket.socketpair()
        self._selector.register(self._woken, selectors.EVENT_READ)
        self._closing = False
        self._thread = threading.Thread(target=self._serve, name='udp_proxy', daemon=True)
        self._thread.start()

    def __enter__(self) -> UdpProxy:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def set_faults(self, faults: LinkFaults) -> None:
        """Change both directions from the next datagram on."""
        self.to_simulator.faults = faults
        self.to_client.faults = faults

    @property
    def counts(self) -> Counter[str]:
        """What has happened so far, both directions together."""
        return self.to_simulator.counts + self.to_client.counts

    def close(self) -> None:
        """Stop and close every socket; safe to call twice."""
        if self._closing:
            return
        self._closing = True
        self._wake.send(b'.')
        self._thread.join()
        self._selector.close()
        for sock in (self._front, self._wake, self._woken, *self._clients.values()):
            sock.close()

    def _serve(self) -> None:
        while not self._closing:
            wait_s = self._late[0][0] - time.monotonic() if self._late else None
            for key, _ in self._selector.select(wait_s if wait_s is None else max(wait_s, 0.0)):
                if key.fileobj is self._front:
                    self._from_client()
                elif key.fileobj is not self._woken:
                    self._from_simulator(key.data)
            while self._late and self._late[0][0] <= time.monotonic():
                _, _, data, send = heapq.heappop(self._late)
                send(data)

    def _from_client(self) -> None:
        try:
            data, client = self._front.recvfrom(65536)
        except OSError:
            return  # an earlier answer met a closed port
        back = self._clients.pop(client, None) or self._new_client(client)
        self._clients[client] = back  # the last is the one heard last
        self._carry(self.to_simulator, data, _sender(back.send))

    def _from_simulator(self, client: Address) -> None:
        back = self._clients.get(client)
        if back is None:
            return  # forgotten a moment ago
        try:
            data = back.recv(65536)
        except OSError:
            return  # nobody listens there
        self._carry(self.to_client, data, _sender(lambda out: self._front.sendto(out, client)))

    def _new_client(self, client: Address) -> socket.socket:
        if len(self._clients) >= _MOST_CLIENTS:
            oldest = next(iter(self._clients))
            forgotten = self._clients.pop(oldest)
            self._selector.unregister(forgotten)
            forgotten.close()
        sock = _socket()
        sock.connect(self._to)
        self._selector.register(sock, selectors.EVENT_READ, client)
        return sock

    def _carry(self, link: BadLink, data: bytes, send: Send) -> None:
        for arrival in link.carry(data):
            if arrival.late_s == 0.0:
                send(arrival.data)
            else:
                due_s = time.monotonic() + arrival.late_s
                heapq.heappush(self._late, (due_s, next(self._numbers), arrival.data, send))


def _socket() -> socket.socket:
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _RECEIVE_BUFFER_BYTES)
    return sock


def _sender(send: Callable[[bytes], int]) -> Send:
    """A closed port or socket is UDP's ordinary loss."""

    def sent(data: bytes) -> None:
        try:
            send(data)
        except OSError:
            return

    return sent


def main(arguments: Sequence[str] | None = None) -> int:
    """Serve until SIGINT or SIGTERM, then tell what happened on standard error."""
    parser = argparse.ArgumentParser(prog='udp_proxy', description='A bad link, on purpose.')
    parser.add_argument('--listen', type=int, default=0, help='UDP port of the proxy')
    parser.add_argument('--to', type=int, required=True, help='UDP port of the simulator')
    parser.add_argument('--seed', type=int, default=1, help='of the random numbers')
    for field in fields(LinkFaults):
        parser.add_argument(f'--{field.name.replace("_", "-")}', type=float, default=field.default)
    options = parser.parse_args(arguments)
    faults = LinkFaults(
        **{field.name: getattr(options, field.name) for field in fields(LinkFaults)}
    )
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda _number, _frame: stop.set())
    with UdpProxy(options.to, faults, seed=options.seed, port=options.listen) as proxy:
        sys.stdout.write(f'{proxy.port}\n')
        sys.stdout.flush()
        stop.wait()
        sys.stderr.write(f'udp_proxy: {dict(sorted(proxy.counts.items()))}\n')
    return 0


if __name__ == '__main__':
    sys.exit(main())
