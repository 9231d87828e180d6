# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which sockets a process has, from the kernel's tables."""

from __future__ import annotations

import ipaddress
import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

_TABLES = ('tcp', 'tcp6', 'udp', 'udp6')
_TCP_LISTEN = '0A'


@dataclass(frozen=True, slots=True, order=True)
class Socket:
    """A socket that takes something in.

    Attributes:
        kind: tcp, tcp6, udp or udp6; TCP only while it listens.
        address: Local address.
        port: Local port.
        inode: The kernel's number of it.
    """

    kind: str
    address: str
    port: int
    inode: int

    @property
    def is_loopback(self) -> bool:
        """Whether nothing from another machine reaches it."""
        address = ipaddress.ip_address(self.address)
        mapped = getattr(address, 'ipv4_mapped', None)
        return bool((mapped or address).is_loopback)


def listening(proc: Path) -> list[Socket]:
    """Return every socket of this network namespace that takes something in.

    Multicast groups are joined by sockets that are bound to the group's address: those are left
    out, since the group comes in through the interface that it was joined on.
    """
    found = []
    for kind in _TABLES:
        try:
            lines = (proc / 'net' / kind).read_text(encoding='ascii').splitlines()[1:]
        except OSError:
            continue
        for line in lines:
            fields = line.split()
            if kind.startswith('tcp') and fields[3] != _TCP_LISTEN:
                continue
            address, port = _address(fields[1])
            if not ipaddress.ip_address(address).is_multicast:
                found.append(Socket(kind, address, port, int(fields[9])))
    return found


def sockets_of(pid: int, proc: Path, table: Iterable[Socket] | None = None) -> list[Socket]:
    """Return the sockets of a process that take something in, sorted; none when it has ended.

    Args:
        pid: Process id.
        proc: The kernel's view of processes.
        table: `listening(proc)`, when several processes are looked at.

    Raises:
        PermissionError: The process belongs to somebody else.
    """
    inodes = socket_inodes(pid, proc)
    if table is None:
        table = listening(proc)
    return sorted(socket for socket in table if socket.inode in inodes)


def socket_inodes(pid: int, proc: Path) -> set[int]:
    """Return the kernel's numbers of all sockets of a process.

    Raises:
        PermissionError: The process belongs to somebody else.
    """
    inodes: set[int] = set()
    try:
        descriptors = list((proc / str(pid) / 'fd').iterdir())
    except (FileNotFoundError, ProcessLookupError):
        return inodes
    for descriptor in descriptors:
        try:
            target = os.readlink(descriptor)
        except (FileNotFoundError, ProcessLookupError):
            continue  # closed meanwhile
        if target.startswith('socket:['):
            inodes.add(int(target[8:-1]))
    return inodes


def _address(text: str) -> tuple[str, int]:
    """Read `0100007F:1F90`: 32-bit words, each in the byte order of the machine."""
    address, _, port = text.partition(':')
    words = [address[i : i + 8] for i in range(0, len(address), 8)]
    # The kernel prints each word as a number of this machine.
    packed = b''.join(int(word, 16).to_bytes(4, sys.byteorder) for word in words)
    return str(ipaddress.ip_address(packed)), int(port, 16)
