# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The orchestrator's side of the agreement with `up`, which restarts dead nodes between runs.

The folder named by `AURORA_SUPERVISION_DIR` holds `busy`, locked (shared) while a run is going on
and (exclusively) while a node is being restarted: neither can begin during the other, and the
kernel lets go of the lock of a process that was killed. `NAME.silent` is put there for a node that
a run found silent although its process lives; `NAME.failed` by `up` when it has given up.
"""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Callable
from pathlib import Path

from aurora_core.errors import AuroraError, ExecutionError, ParticipantSilentError

VARIABLE = 'AURORA_SUPERVISION_DIR'
BUSY = 'busy'
_LOOK_S = 0.02
_SILENT = (ParticipantSilentError.default_code, 421)  # 421: uav_bridge about uav_sim


class Supervision:
    """The lock and the notes; without a folder there is nobody who restarts anything.

    Args:
        folder: None: not supervised.
        supervised_s: How long a dead node may take to come back when there is a supervisor.
        alone_s: The same when there is none.
    """

    def __init__(self, folder: Path | None, *, supervised_s: float, alone_s: float) -> None:
        self._folder = folder
        self._lock = -1
        self.restart_s = alone_s if folder is None else supervised_s

    def begin_run(self, deadline_s: float, cancelled: Callable[[], bool]) -> bool:
        """Keep nodes from being restarted; return whether that was possible.

        Args:
            deadline_s: Steady time until which a restart may be waited for.
            cancelled: True ends the wait.

        Raises:
            ExecutionError: The folder is gone.
        """
        if self._folder is None:
            return True
        self.end_run()
        try:
            lock = os.open(self._folder / BUSY, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        except OSError as err:
            raise ExecutionError(
                f'{self._folder / BUSY} cannot be opened: {err.strerror or err}',
                component='orchestrator',
                hint='the graph was started with this folder: stop the graph and start it again',
            ) from err
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                if cancelled() or time.monotonic() > deadline_s:
                    os.close(lock)
                    return False
                time.sleep(_LOOK_S)
            else:
                self._lock = lock
                return True

    def end_run(self) -> None:
        """Allow restarts again; safe to call twice."""
        lock, self._lock = self._lock, -1
        if lock >= 0:
            os.close(lock)

    def has_given_up(self, name: str) -> bool:
        """Return whether a node will not be restarted any more."""
        return self._folder is not None and (self._folder / f'{name}.failed').exists()

    def note(self, error: AuroraError | None) -> None:
        """Have a component restarted that a run found silent."""
        if self._folder is None or error is None or error.code not in _SILENT:
            return
        if (self._folder / f'{error.component}.pid').exists():
            (self._folder / f'{error.component}.silent').touch()


def supervision_folder() -> Path | None:
    """Return the folder that the environment names."""
    named = os.environ.get(VARIABLE, '')
    return Path(named) if named else None
