# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One contained program, seen from outside: its requests, our answers, and how it ended.

Lines of JSON go both ways. Whatever the program writes is data: a line that is too long, no JSON
or no object ends it.
"""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from enum import StrEnum
from functools import lru_cache
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from aurora_bench.sandbox.inside.guard import NO_MEMORY, UNSAFE
from aurora_bench.sandbox.ways import ProgramLimits, SandboxError, WayName, command, ways
from aurora_core.document import Document

LONGEST_LINE = 1 << 20
_TOLD_BYTES = 4000


class End(StrEnum):
    """How a program ended."""

    FINISHED = 'finished'
    RAISED = 'raised'  # an exception of its own, or another exit code than 0
    CPU = 'cpu'  # more processor time than it may use
    WALL = 'wall'  # more waiting than it may cause
    MEMORY = 'memory'
    PROTOCOL = 'protocol'  # what it wrote is no request, or there were too many
    KILLED = 'killed'  # of a signal
    STOPPED = 'stopped'  # by us, for a reason of ours


class Ended(Document):
    """The end of a program.

    Attributes:
        end: How it ended.
        told: Last lines of what it printed.
    """

    end: End
    told: str = ''


# Whoever was killed after so much of its processor time was killed for that. The kernel counts its
# limit by ticks, which on a loaded machine run ahead of the time that it reports.
_SPENT_SHARE = 0.5


class ContainedProgram:
    """A running program; leave it by `with`, whatever happens.

    Args:
        text: Python source.
        limits: What it may use.
        way: How it is contained; None: the first one that holds on this machine.
        clock: Steady seconds.

    Raises:
        SandboxError: Nothing contains it.
    """

    def __init__(
        self,
        text: str,
        limits: ProgramLimits | None = None,
        *,
        way: WayName | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._limits = limits or ProgramLimits()
        self._clock = clock
        self._waited_s = 0.0
        self._requests = 0
        self._buffer = b''
        self._end: End | None = None
        way = way or chosen_way()
        self._root = tempfile.TemporaryDirectory(prefix='aurora_program_')
        self._printed = tempfile.TemporaryFile()  # noqa: SIM115  (closed on leaving)
        self._process = subprocess.Popen(
            command(way, self._limits, Path(self._root.name)),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._printed,
            env={},
            cwd='/',
            start_new_session=True,
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._to, self._from = self._process.stdin.fileno(), self._process.stdout.fileno()
        os.set_blocking(self._to, False)
        self.send({'program': text})

    def send(self, answer: Mapping[str, Any]) -> None:
        """Give an answer; one that does not read it in time is ended."""
        data = json.dumps(answer, allow_nan=False).encode() + b'\n'
        while data and self._end is None:
            if not self._wait(writing=True):
                return
            try:
                data = data[os.write(self._to, data) :]
            except BlockingIOError:
                continue
            except BrokenPipeError:
                return  # it has ended; `receive` tells

    def receive(self) -> dict[str, Any] | None:
        """Return the next request, None when there is none any more."""
        while b'\n' not in self._buffer:
            if len(self._buffer) > LONGEST_LINE:
                self._stop(End.PROTOCOL)
                return None
            if self._end is not None or not self._wait(writing=False):
                return None
            data = os.read(self._from, 1 << 16)
            if not data:
                return None
            self._buffer += data
        line, _, self._buffer = self._buffer.partition(b'\n')
        self._requests += 1
        if self._requests > self._limits.requests:
            self._stop(End.PROTOCOL)
            return None
        try:
            request = json.loads(line)
        except (ValueError, RecursionError):
            self._stop(End.PROTOCOL)
            return None
        if not isinstance(request, dict):
            self._stop(End.PROTOCOL)
            return None
        return request

    def stop(self) -> None:
        """End it for a reason of ours."""
        self._stop(End.STOPPED)

    def ended(self) -> Ended:
        """Wait for its end (as long as it may take) and tell how it was."""
        while self._end is None and self.receive() is not None:
            pass
        if self._end is None:
            self._reap()
        self._printed.seek(0)
        told = self._printed.read().decode(errors='replace')[-_TOLD_BYTES:]
        assert self._end is not None
        return Ended(end=self._end, told=told)

    def _wait(self, *, writing: bool) -> bool:
        """Wait for the program within its time; False when that is over."""
        begin = self._clock()
        left_s = self._limits.wall_s - self._waited_s
        readable, writable, _ = select.select(
            [] if writing else [self._from], [self._to] if writing else [], [], max(0.0, left_s)
        )
        self._waited_s += self._clock() - begin
        if not readable and not writable:
            self._stop(End.WALL)
            return False
        return True

    def _stop(self, why: End) -> None:
        if self._end is None:
            self._kill()
            self._end = why

    def _kill(self) -> None:
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()

    def _reap(self) -> None:
        """Take the end of a program that closed its pipe; one that goes on has until its time."""
        left_s = max(0.1, self._limits.wall_s - self._waited_s)
        before = _children_cpu_s()
        try:
            code = self._process.wait(timeout=left_s)
        except subprocess.TimeoutExpired:
            self._stop(End.WALL)
            return
        used_s = _children_cpu_s() - before
        if code == UNSAFE:
            self._printed.seek(0)
            raise SandboxError(
                'the program was not run: its limits could not be set',
                hint=self._printed.read().decode(errors='replace')[-500:],
            )
        if code == 0:
            self._end = End.FINISHED
        elif code == NO_MEMORY:
            self._end = End.MEMORY
        elif code == -signal.SIGKILL and used_s >= _SPENT_SHARE * self._limits.cpu_s:
            self._end = End.CPU
        else:
            self._end = End.KILLED if code < 0 else End.RAISED

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._kill()
        for stream in (self._process.stdin, self._process.stdout, self._printed):
            if stream is not None:
                with suppress(BrokenPipeError):
                    stream.close()
        self._root.cleanup()


def _children_cpu_s() -> float:
    times = os.times()
    return times.children_user + times.children_system


# What a program must not find, whichever way contains it.
_LOOK_AROUND = """
import os, socket
found = [p for p in ('/home', '/root', '/tmp', '/proc', '/etc/passwd') if os.path.exists(p)
         and not {python!r}.startswith(p + '/')]
for name, attempt in (
    ('network', lambda: socket.socket()),
    ('process', os.fork),
    ('file', lambda: open('/scene/x', 'w')),
    ('signal', lambda: os.kill(1, 0)),
):
    try:
        attempt()
    except OSError:
        continue
    found.append(name)
print(found)
raise SystemExit(1 if found else 0)
"""


def probe(way: WayName) -> Ended:
    """Run a program that looks around; it finishes when it found nothing."""
    import sys

    text = _LOOK_AROUND.format(python=str(Path(sys.executable).resolve()))
    with ContainedProgram(text, way=way) as program:
        return program.ended()


@lru_cache(maxsize=1)
def chosen_way() -> WayName:
    """Return the first way that holds on this machine.

    Raises:
        SandboxError: None does.
    """
    told = []
    for way in ways():
        try:
            found = probe(way)
        except (OSError, SandboxError) as err:
            told.append(f'{way.value}: {err}')
            continue
        if found.end is End.FINISHED:
            return way
        told.append(f'{way.value}: {found.end.value}, {found.told.strip()[-200:]}')
    raise SandboxError(
        f'no program is run: nothing contains it on this machine ({"; ".join(told)})',
        hint='install bubblewrap, or allow user namespaces without privileges',
    )
