# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Programs that try to get out, to take too much or to lie, and how each has to end.

A program that got through prints `ESCAPED`; what it must not read is `SECRET`.
"""

from __future__ import annotations

from dataclasses import dataclass

from aurora_bench.sandbox.process import End

ESCAPED = 'ESCAPED'
_REFUSED = frozenset({End.RAISED})


@dataclass(frozen=True, slots=True)
class Hostile:
    """One program.

    Attributes:
        name: What it tries.
        text: Its source; `{canary}` is a file outside that it must neither read nor change.
        ends: How it may end.
    """

    name: str
    text: str
    ends: frozenset[End] = _REFUSED


def _through(name: str, attempt: str, *, first: str = '') -> Hostile:
    """Return a program that says so when its attempt goes through."""
    return Hostile(name, f'import os, sys\n{first}\n{attempt}\nprint("{ESCAPED}")\n')


_CTYPES = 'import ctypes\nlibc = ctypes.CDLL(None, use_errno=True)'
_CALL = 'if libc.syscall({}) < 0: raise OSError(ctypes.get_errno(), "refused")'


def _call(name: str, arguments: str) -> Hostile:
    """Return a program that makes a system call past the interpreter."""
    return _through(name, _CALL.format(arguments), first=_CTYPES)


HOSTILE: tuple[Hostile, ...] = (
    # --- network ---
    _through('connect', 'socket.create_connection(("127.0.0.1", 22), 1)', first='import socket'),
    _through('datagram', 'socket.socket(type=socket.SOCK_DGRAM)', first='import socket'),
    _through('name service', 'socket.getaddrinfo("localhost", "ssh")', first='import socket'),
    _through('listen', 'socket.create_server(("", 0))', first='import socket'),
    _through('unix socket', 'socket.socket(socket.AF_UNIX)', first='import socket'),
    _through(
        'url', 'urllib.request.urlopen("http://127.0.0.1/", timeout=1)',
        first='import urllib.request',
    ),
    # --- files ---
    _through('read a file', 'open({canary!r}).read()'),
    _through('write a file', 'open({canary!r}, "w").write("x")'),
    _through('delete a file', 'os.unlink({canary!r})'),
    _through('read passwords', 'open("/etc/passwd").read()'),
    _through('write here', 'open("new.txt", "w")'),
    _through('write beside the guard', 'open("/scene/new.py", "w")'),
    _through('change the guard', 'open("/scene/guard.py", "a").write("x")'),
    _through('climb out', 'open("/scene/../../../.." + {canary!r})'),
    _through('temporary file', 'tempfile.TemporaryFile()', first='import tempfile'),
    _through('make a link', 'os.symlink({canary!r}, "/tmp_link")'),
    _through('file in memory', 'os.memfd_create("x")'),
    _through('processes of others', 'os.listdir("/proc")'),
    _through('devices', 'open("/dev/mem", "rb")'),
    # --- processes ---
    _through('fork', 'os.fork()'),
    Hostile(
        'fork bomb',
        'import os\nwhile True:\n    try:\n        os.fork()\n'
        f'        print("{ESCAPED}")\n    except PermissionError:\n        pass\n',
        frozenset({End.CPU}),
    ),
    _through('thread', 'threading.Thread(target=print).start()', first='import threading'),
    _through(
        'other program', 'subprocess.run(["/bin/sh", "-c", "true"])', first='import subprocess'
    ),
    _through('become another program', 'os.execv(sys.executable, [sys.executable, "-c", ""])'),
    _through('kill the parent', 'os.kill(os.getppid(), 9)'),
    _through('kill everybody', 'os.kill(-1, 9)'),
    _through('kill the group', 'os.killpg(0, 9)'),
    _through('new session', 'os.setsid()'),
    _through('trace', _CALL.format('101, 16, 1, 0, 0'), first=_CTYPES),
    # --- rights ---
    _through('more memory', 'r.setrlimit(r.RLIMIT_AS, (-1, -1))', first='import resource as r'),
    _through('more time', 'r.setrlimit(r.RLIMIT_CPU, (-1, -1))', first='import resource as r'),
    _through('become root', 'os.setuid(0)'),
    _call('mount', '165, b"none", b"/", b"tmpfs", 0, 0'),
    _call('another name space', '272, 0x10000000'),
    _call('kernel module', '175, 0, 0, b""'),
    _call('through 32 bits', '0x40000000 + 41, 2, 1, 0'),
    _call('ring of requests', '425, 8, 0'),
    # --- too much ---
    Hostile('endless loop', 'while True: pass', frozenset({End.CPU})),
    Hostile(
        'endless loop that catches all',
        'import signal\nfor n in range(1, 32):\n    try: signal.signal(n, signal.SIG_IGN)\n'
        '    except (OSError, ValueError): pass\n'
        'while True:\n    try:\n        while True: pass\n    except BaseException: pass\n',
        frozenset({End.CPU}),
    ),
    Hostile('sleeps', 'import time\ntime.sleep(1e6)', frozenset({End.WALL})),
    Hostile(
        'memory', 'a = []\nwhile True: a.append(bytearray(10**7))', frozenset({End.MEMORY})
    ),
    Hostile(
        'memory at once', f'x = bytearray(1 << 40)\nprint("{ESCAPED}")', frozenset({End.MEMORY})
    ),
    Hostile(
        'prints without end', 'while True: print("x" * 1000)',
        frozenset({End.RAISED, End.CPU, End.FINISHED}),
    ),
    Hostile(
        'recursion', 'import sys\nsys.setrecursionlimit(10**9)\ndef f(n): return f(n + 1)\nf(0)',
        frozenset({End.CPU, End.KILLED, End.MEMORY, End.RAISED}),
    ),
    # --- lies over the pipe ---
    Hostile(
        'garbage', 'import aurora_scene\naurora_scene._requests.write(b"\\xff\\xfe{{{{\\n")\n'
        'aurora_scene.first_line()',
        frozenset({End.PROTOCOL}),
    ),
    Hostile(
        'line without end', 'import aurora_scene\nwhile True:\n'
        '    aurora_scene._requests.write(b"x" * 65536)',
        frozenset({End.PROTOCOL}),
    ),
    Hostile(
        'deep nest', 'import aurora_scene\naurora_scene._requests.write(b"[" * 300000 + b"\\n")\n'
        'aurora_scene.first_line()',
        frozenset({End.PROTOCOL}),
    ),
    Hostile(
        'flood', 'import aurora_scene\nwhile True:\n'
        '    aurora_scene._requests.write(b"{{}}\\n" * 1000)',
        frozenset({End.PROTOCOL}),
    ),
    # --- end without a word ---
    Hostile('crash', 'import ctypes\nctypes.string_at(0)', frozenset({End.KILLED})),
    Hostile('abort', 'import os\nos.abort()', frozenset({End.KILLED, End.RAISED})),
    Hostile('exit code', 'import os\nos._exit(3)', frozenset({End.RAISED})),
)  # fmt: skip
