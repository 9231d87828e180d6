# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Start nodes at once: `ros2 run aurora_nodes together RUN_DIR LOG_DIR`, for `up`.

Eleven processes that import the same modules take most of the time that a start takes. Here they
are imported once, and each node is a fork of that, in a process group of its own: as soon as what
it needs is there, so that it gets ready while the rest is imported.

Standard input: a node per line, its name and the processor core that it keeps to (`-`: any). Each
gets what `up` gives to one that it starts alone: RUN_DIR/NAME.pid, LOG_DIR/NAME.log, and the
variables of its ready file and its supervision. Exit code 1, and nothing started, when one of them
is unknown.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path

from aurora_nodes.modules import MODULES
from aurora_nodes.supervision import VARIABLE
from aurora_ros.enclaves import take_enclave
from aurora_ros.main import READY_FILE_VARIABLE
from aurora_ros.processes import process_state

_ANY = '-'
_COMM = Path('/proc/self/comm')
_BOOT = Path('/proc/sys/kernel/random/boot_id')


def main(arguments: Sequence[str] | None = None) -> int:
    """Start the nodes and return; in each of them, serve until it is told to end."""
    run_dir, log_dir = map(Path, sys.argv[1:] if arguments is None else arguments)
    wanted = [(name, core) for name, core in map(str.split, sys.stdin)]
    unknown = [name for name, _ in wanted if name not in MODULES]
    if unknown:
        sys.stderr.write(f'there is no node {unknown[0]}\n')
        return 1
    gc.disable()
    places = list(MODULES)
    for name, core in sorted(wanted, key=lambda each: places.index(each[0])):
        # What is missing fails in its own node.
        with suppress(ImportError):
            import_module(MODULES[name])
        # The collector of a forked node need not look at it, and so not copy it.
        gc.freeze()
        pid = os.fork()
        if pid == 0:
            gc.enable()
            _become(name, core, run_dir, log_dir)
            return int(import_module(MODULES[name]).main())
        _note(run_dir / f'{name}.pid', pid)
    return 0


def _note(file: Path, pid: int) -> None:
    """Write the pid file as `up` reads it: id, start, boot."""
    state = process_state(pid)
    if state is None:  # gone already: nobody waits for its ready file then
        return
    boot = _BOOT.read_text(encoding='ascii').strip()
    new = file.with_name(f'{file.name}.new')
    new.write_text(f'{pid} {state.started} {boot}\n', encoding='ascii')
    new.replace(file)


def _become(name: str, core: str, run_dir: Path, log_dir: Path) -> None:
    """Make this process what a start of its own would have made it."""
    os.setpgid(0, 0)
    if core != _ANY:
        os.sched_setaffinity(0, {int(core)})
    # Who was started in the background of a script may have been told to ignore them.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for other in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(other, signal.SIG_DFL)
    nothing = os.open(os.devnull, os.O_RDONLY)
    log = os.open(log_dir / f'{name}.log', os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
    for descriptor, number in ((nothing, 0), (log, 1), (log, 2)):
        os.dup2(descriptor, number)
    os.close(nothing)
    os.close(log)
    os.environ[READY_FILE_VARIABLE] = str(run_dir / f'{name}.ready')
    os.environ[VARIABLE] = str(run_dir)
    take_enclave(name)
    sys.argv = [name]
    _COMM.write_text(name, encoding='ascii')  # what `ps` and `top` show
