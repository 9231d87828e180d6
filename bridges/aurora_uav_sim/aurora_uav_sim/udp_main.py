# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The executable `uav_sim`: the simulator on a UDP socket."""

from __future__ import annotations

import argparse
import errno
import gc
import math
import os
import select
import signal
import socket
import struct
import sys
import time
from collections.abc import Hashable
from pathlib import Path
from types import FrameType

from aurora_uav_sim.late_link import LateLink
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.protocol import (
    MAX_FLEET,
    MAX_SYSTEM_ID,
    OWNER_SILENCE_S,
    mavlink_port,
)
from aurora_uav_sim.signed_server import SignedServer
from aurora_uav_sim.signing import KeyFileError, signer_from

LOOPBACK = '127.0.0.1'
# How often time passes, s of steady time.
_POLL_S = 0.01
_RECEIVE_BUFFER_BYTES = 1 << 20
# Worse clocks and links than any that a paced run is for.
_MAX_DRIFT_PPM, _MAX_JITTER_MS = 10_000.0, 1000.0

Address = tuple[str, int]


def _address(text: str) -> Address:
    host, _, port = text.rpartition(':')
    if not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise argparse.ArgumentTypeError(f'expected HOST:PORT, found {text!r}')
    return host, int(port)


def _arguments(argv: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog='uav_sim', description='Multirotors behind MAVLink 2 over UDP (PX4 flavour).'
    )
    parser.add_argument('--count', type=int, default=1, help='vehicles while stand-alone')
    parser.add_argument('--system-id', type=int, default=1, help='system id of the first vehicle')
    parser.add_argument('--port', type=int, help='UDP port; default: from ROS_DOMAIN_ID')
    parser.add_argument('--host', default=LOOPBACK, help='address to bind')
    parser.add_argument(
        '--gcs', type=_address, action='append', default=[], metavar='HOST:PORT',
        help='send telemetry there unasked, e.g. 127.0.0.1:14550 (may be repeated)',
    )  # fmt: skip
    parser.add_argument(
        '--owner-silence', type=float, default=OWNER_SILENCE_S, metavar='SECONDS',
        help='a lockstep session may be taken over after its owner was silent for so long '
        '(default: %(default)s)',
    )  # fmt: skip
    late = parser.add_argument_group('to try clients with, not in lockstep')
    late.add_argument(
        '--clock-drift', type=float, default=0.0, metavar='PPM',
        help='the clock counts so many millionths more per second (default: %(default)s)',
    )  # fmt: skip
    late.add_argument(
        '--jitter', type=float, default=0.0, metavar='MS',
        help='each datagram takes a time drawn evenly from 0 to this (default: %(default)s)',
    )  # fmt: skip
    late.add_argument('--jitter-seed', type=int, default=1, help='seed of those times')
    # `ros2 run` and launch files add these; there is nothing of ROS here to configure.
    own = argv[: argv.index('--ros-args')] if '--ros-args' in argv else argv
    options = parser.parse_args(own)
    last = options.system_id + options.count - 1
    if not 1 <= options.count <= MAX_FLEET or options.system_id < 1 or last > MAX_SYSTEM_ID:
        parser.error(f'expected 1 to {MAX_FLEET} vehicles with system ids 1 to {MAX_SYSTEM_ID}')
    if not 0.0 < options.owner_silence < math.inf:
        parser.error(f'expected seconds of silence above 0, found {options.owner_silence}')
    if not abs(options.clock_drift) <= _MAX_DRIFT_PPM:
        parser.error(f'expected a drift of at most {_MAX_DRIFT_PPM:g} ppm')
    if not 0.0 <= options.jitter <= _MAX_JITTER_MS:
        parser.error(f'expected a jitter from 0 to {_MAX_JITTER_MS:g} ms')
    if options.port is None:
        try:
            options.port = mavlink_port(
                int(os.environ.get('ROS_DOMAIN_ID') or 0), options.system_id
            )
        except ValueError as error:
            parser.error(f'ROS_DOMAIN_ID: {error}')
    elif not 0 <= options.port < 65536:
        parser.error(f'expected a port from 0 to 65535, found {options.port}')
    return options


def _open_socket(host: str, port: int) -> socket.socket:
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _RECEIVE_BUFFER_BYTES)
        # A receive that waits at most one poll period, in one system call.
        sock.setsockopt(
            socket.SOL_SOCKET, socket.SO_RCVTIMEO, struct.pack('ll', 0, int(_POLL_S * 1e6))
        )
        sock.bind((host, port))
    except OSError:
        sock.close()
        raise
    return sock


class _Stop:
    """Set by SIGINT, SIGTERM, and SIGHUP where it is not ignored (`nohup`)."""

    def __init__(self) -> None:
        self.asked = False
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if number == signal.SIGHUP and signal.getsignal(number) is signal.SIG_IGN:
                continue
            signal.signal(number, self._ask)

    def _ask(self, number: int, frame: FrameType | None) -> None:
        del number, frame
        self.asked = True


def _send(sock: socket.socket, datagram: bytes, destination: Hashable) -> None:
    try:
        sock.sendto(datagram, destination)  # type: ignore[call-overload]
    except OSError:
        # A peer that is gone (refused, unreachable, full buffer) is UDP's ordinary loss.
        return


def _serve(sock: socket.socket, server: SimServer | SignedServer, stop: _Stop) -> None:
    next_poll_s = time.monotonic()
    while not stop.asked:
        try:
            datagram, source = sock.recvfrom(65536)
        except (BlockingIOError, ConnectionError):
            # Nothing came in one period, or an earlier datagram met a closed port.
            pass
        else:
            if not server.in_lockstep:
                # Who asks for the time is told the present one.
                for destination, out in server.poll(time.monotonic()):
                    _send(sock, out, destination)
            for reply in server.handle(datagram, source):
                _send(sock, reply, source)
        now_s = time.monotonic()
        if now_s >= next_poll_s:
            for destination, out in server.poll(now_s):
                _send(sock, out, destination)
            next_poll_s = now_s + _POLL_S


def _serve_late(sock: socket.socket, link: LateLink, stop: _Stop) -> None:
    sock.setblocking(False)
    while not stop.asked:
        now_s = time.monotonic()
        for destination, out in link.pass_time(now_s):
            _send(sock, out, destination)
        wait_s = _POLL_S if (next_s := link.next_s()) is None else min(next_s - now_s, _POLL_S)
        if select.select([sock], [], [], max(wait_s, 0.0))[0]:
            try:
                datagram, source = sock.recvfrom(65536)
            except (BlockingIOError, ConnectionError):
                continue
            link.take(datagram, source, time.monotonic())


def main(argv: list[str] | None = None) -> int:
    """Serve until a signal asks to stop; return the exit code."""
    options = _arguments(sys.argv[1:] if argv is None else argv)
    try:
        signer = signer_from()
    except KeyFileError as error:
        sys.stderr.write(f'uav_sim: {error}\n')
        return 1
    stop = _Stop()
    try:
        sock = _open_socket(options.host, options.port)
    except OSError as error:
        where = f'{options.host}:{options.port}'
        if error.errno == errno.EADDRINUSE:
            text = f'UDP {where} is in use; stop the other uav_sim or give another --port'
        else:
            text = f'cannot bind UDP {where}: {error.strerror or error}'
        sys.stderr.write(f'uav_sim: {text}\n')
        return 1
    with sock:
        if options.host != LOOPBACK:
            sys.stderr.write(f'uav_sim: warning: open to the network on {options.host}\n')
        first = options.system_id
        server = SimServer(
            range(first, first + options.count),
            options.gcs,
            owner_silence_s=options.owner_silence,
        )
        gc.freeze()
        host, port = sock.getsockname()
        served = server if signer is None else SignedServer(server, signer)
        late = None
        if options.clock_drift or options.jitter:
            start_s = time.monotonic()
            late = LateLink(
                served,
                drift_ppm=options.clock_drift,
                jitter_s=1e-3 * options.jitter,
                seed=options.jitter_seed,
                start_s=start_s,
            )
            sys.stdout.write(
                f'uav_sim: clock {options.clock_drift:+g} ppm from CLOCK_MONOTONIC {start_s!r}, '
                f'datagrams up to {options.jitter:g} ms late\n'
            )
        sys.stdout.write(f'uav_sim: {options.count} vehicle(s) on UDP {host}:{port}\n')
        sys.stdout.flush()
        ready = os.environ.get('AURORA_READY_FILE')
        if ready:
            # Whole at once: a reader never sees it empty.
            temporary = Path(f'{ready}.{os.getpid()}')
            temporary.write_text(f'{port}\n', encoding='ascii')
            temporary.replace(ready)
        if late is not None:
            _serve_late(sock, late, stop)
        else:
            _serve(sock, served, stop)
    return 0


if __name__ == '__main__':
    sys.exit(main())
