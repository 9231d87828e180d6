# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Findings, and the machine that is looked at."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """One thing that is not as it should be.

    Attributes:
        expected: What should be.
        found: What is.
        fix: What to do, a command to paste where there is one.
        dead: Files that are provably ours and that nobody uses any more; `--fix` removes them.
    """

    expected: str
    found: str
    fix: str
    dead: tuple[Path, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Probe:
    """How a piece of Python went in a process of its own.

    Attributes:
        code: Exit code; None when it did not end in time.
        out: Standard output.
        err: Standard error.
    """

    code: int | None
    out: str = ''
    err: str = ''

    @property
    def last_words(self) -> str:
        """The last line of standard error, or what happened without one."""
        lines = self.err.strip().splitlines()
        if self.code is None:
            return 'it did not end in time'
        return lines[-1] if lines else f'exit code {self.code}'


def run_python(script: str, limit_s: float) -> Probe:
    """Run a piece of Python in a process of its own: what breaks there breaks nothing here.

    Args:
        script: The program.
        limit_s: Wall-clock limit.
    """
    try:
        done = subprocess.run(
            [sys.executable, '-c', script], capture_output=True, timeout=limit_s, check=False,
            stdin=subprocess.DEVNULL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return Probe(code=None)
    return Probe(
        code=done.returncode,
        out=done.stdout.decode('utf-8', 'replace'),
        err=done.stderr.decode('utf-8', 'replace'),
    )


def installed_version(name: str) -> str | None:
    """Return the version of an installed distribution, None when there is none."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def may_live(process: Any) -> bool:
    """Tell whether a process (`ProcessIdentity`) may still live."""
    from aurora_core.report.process import process_lives

    return process_lives(process)


def checkout_of(file: Path) -> Path | None:
    """Return the top folder of the source checkout that a file belongs to, links followed."""
    for parent in file.resolve().parents:
        if (parent / 'ros_ws' / 'setup.bash').is_file() and (parent / 'requirements').is_dir():
            return parent
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """Every place that a check looks at; tests plant problems in it.

    Attributes:
        environment: Environment variables.
        runs: Folder of all runs.
        model: Language model that is configured.
        checkout: Top folder of the source checkout, None when it is not known.
        proc: The kernel's view of processes.
        shm: Shared memory.
        temp: Folder for temporary files.
        python: Version of the interpreter.
        uid: User.
        installed: Version of a distribution.
        probe: Runs a piece of Python elsewhere, with a limit in s.
        wall_s: Wall clock, s since 1970.
        lives: Whether the process that wrote a run may still live.
    """

    environment: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
    runs: Path = Path('runs')
    model: str = 'offline'
    checkout: Path | None = field(default_factory=lambda: checkout_of(Path(__file__)))
    proc: Path = Path('/proc')
    shm: Path = Path('/dev/shm')  # nosec
    temp: Path = field(default_factory=lambda: Path(tempfile.gettempdir()))
    python: tuple[int, int] = field(default_factory=lambda: sys.version_info[:2])
    uid: int = field(default_factory=os.getuid)
    installed: Callable[[str], str | None] = installed_version
    probe: Callable[[str, float], Probe] = run_python
    wall_s: Callable[[], float] = time.time
    lives: Callable[[Any], bool] = may_live

    @property
    def domain_text(self) -> str:
        """ROS_DOMAIN_ID as it stands there."""
        return self.environment.get('ROS_DOMAIN_ID', '') or '0'

    @property
    def domain(self) -> int | None:
        """ROS domain, None when it is none."""
        text = self.domain_text
        return int(text) if text.isascii() and text.isdecimal() else None

    @property
    def run_dir(self) -> Path:
        """Where `up` keeps pid files, ready files and logs of this domain."""
        named = self.environment.get('AURORA_RUN_DIR', '')
        home = self.environment.get('HOME', '') or '/tmp'  # nosec
        top = Path(named) if named else Path(home) / '.ros' / 'aurora'
        return top / f'domain-{self.domain_text}'

    @property
    def setup_hint(self) -> str:
        """The command that puts the environment into a shell."""
        top = f'{self.checkout}/' if self.checkout is not None else ''
        return f'source {top}ros_ws/setup.bash'
