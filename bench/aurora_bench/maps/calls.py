# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Call `aurora` as a user does, in a process of its own, and see what that takes."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

_LIMIT_S = 900.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Called:
    """A command that ended.

    Args:
        code: Its exit code; None when it was stopped after 15 minutes.
        out: What it answered.
        err: What it said besides.
        seconds: Wall time.
        peak_mib: Memory that it, or one of its children, held at most.
    """

    code: int | None
    out: str
    err: str
    seconds: float
    peak_mib: float


def call(arguments: Sequence[str], folder: Path, environment: Mapping[str, str]) -> Called:
    """Run `aurora` with arguments in a folder.

    Args:
        arguments: After the name of the command.
        folder: Where it runs; what it says is kept there meanwhile.
        environment: Variables beside those of this process.
    """
    out_path, err_path = folder / 'out.txt', folder / 'err.txt'
    begin_s = time.monotonic()
    with out_path.open('wb') as out, err_path.open('wb') as err:
        process = subprocess.Popen(
            [sys.executable, '-c', _MAIN, *arguments],
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            cwd=folder,
            env={**os.environ, **environment},
        )
        late = threading.Timer(_LIMIT_S, process.kill)
        late.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        finally:
            late.cancel()
            if process.returncode is None:
                process.kill()
                process.wait()
    return Called(
        code=process.returncode if process.returncode >= 0 else None,
        out=out_path.read_text(encoding='utf-8', errors='replace'),
        err=err_path.read_text(encoding='utf-8', errors='replace'),
        seconds=time.monotonic() - begin_s,
        peak_mib=usage.ru_maxrss / 1024.0,
    )


_MAIN = 'from aurora_cli.main import main; main()'
