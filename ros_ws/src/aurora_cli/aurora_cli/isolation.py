# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A network of its own for a graph: nobody else on this machine can send to it or listen to it.

    python -m aurora_cli.isolation new COMMAND...         in a new network with loopback alone
    python -m aurora_cli.isolation enter PID COMMAND...   in the network of a process of this user

The kernel gives it without root: a user namespace in which this user keeps its name, and a network
namespace in it. What the command becomes has no privilege in either, unless the user is root. Uses
the standard library alone, so that a shell script can call it.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import socket
import struct
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

# linux/sched.h, linux/sockios.h, linux/if.h
_CLONE_NEWUSER = 0x10000000
_CLONE_NEWNET = 0x40000000
_SIOCGIFFLAGS = 0x8913
_SIOCSIFFLAGS = 0x8914
_IFF_UP = 0x1
_INTERFACE_REQUEST = '16sh22x'  # struct ifreq: name, flags, the rest of its union
_USAGE = 64
_REFUSED = 77  # EX_NOPERM: this kernel or container gives no network of its own

_TRY_S = 10.0

# Set inside, so that nothing is isolated twice.
ISOLATED = 'AURORA_ISOLATED'


def enter_new() -> None:
    """Move this process into a new network; it must have a single thread.

    Raises:
        OSError: The kernel, or the container around us, does not let this user.
    """
    user, group = os.geteuid(), os.getegid()
    _call('unshare', _CLONE_NEWUSER | _CLONE_NEWNET)
    Path('/proc/self/setgroups').write_text('deny')
    Path('/proc/self/uid_map').write_text(f'{user} {user} 1')
    Path('/proc/self/gid_map').write_text(f'{group} {group} 1')
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        asked = struct.pack(_INTERFACE_REQUEST, b'lo', 0)
        _, flags = struct.unpack(_INTERFACE_REQUEST, fcntl.ioctl(any_socket, _SIOCGIFFLAGS, asked))
        up = struct.pack(_INTERFACE_REQUEST, b'lo', flags | _IFF_UP)
        fcntl.ioctl(any_socket, _SIOCSIFFLAGS, up)


def enter(pid: int) -> None:
    """Move this process into the network of another process of this user.

    Raises:
        OSError: There is no such process, or it is another user's.
    """
    names = [name for name in ('user', 'net') if _space(pid, name) != _space(os.getpid(), name)]
    opened = [os.open(f'/proc/{pid}/ns/{name}', os.O_RDONLY | os.O_CLOEXEC) for name in names]
    for descriptor in opened:
        _call('setns', descriptor, 0)


def same_network(pid: int) -> bool:
    """Tell whether a process is in the network that this one is in.

    Raises:
        OSError: There is no such process, or it is another user's.
    """
    return _space(pid, 'net') == _space(os.getpid(), 'net')


def refusal() -> str:
    """Return why no network of its own can be had here, '' when it can."""
    tried = [sys.executable, '-m', 'aurora_cli.isolation', 'new', 'true']
    try:
        done = subprocess.run(
            tried, stdin=subprocess.DEVNULL, capture_output=True, timeout=_TRY_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as err:
        return str(err)
    told = done.stderr.decode('utf-8', 'replace').strip().splitlines()
    return '' if done.returncode == 0 else (told[-1].rpartition(': ')[2] if told else 'refused')


def _space(pid: int, name: str) -> int:
    return os.stat(f'/proc/{pid}/ns/{name}').st_ino


def _call(name: str, *arguments: int) -> None:
    library = ctypes.CDLL(None, use_errno=True)
    if getattr(library, name)(*arguments) != 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))


def main(arguments: Sequence[str]) -> int:
    """Become a command in another network; returns only when that cannot be."""
    match arguments:
        case ['new', *command] if command:
            where = 'a network of its own cannot be had'
        case ['enter', pid, *command] if command and pid.isascii() and pid.isdecimal():
            where = f'the network of process {pid} cannot be entered'
        case _:
            print('usage: new COMMAND... | enter PID COMMAND...', file=sys.stderr)  # noqa: T201
            return _USAGE
    try:
        if arguments[0] == 'new':
            enter_new()
        else:
            enter(int(arguments[1]))
    except OSError as err:
        print(f'aurora: {where}: {err.strerror or err}', file=sys.stderr)  # noqa: T201
        return _REFUSED
    os.environ[ISOLATED] = '1'
    try:
        os.execvp(command[0], command)
    except OSError as err:
        print(f'aurora: {command[0]}: {err.strerror or err}', file=sys.stderr)  # noqa: T201
        return 127


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
