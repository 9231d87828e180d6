# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Brings a growing file to the disk beside the work, because the disk takes milliseconds for it.

What was handed to the operating system survives the death of this process at once; the disk is
asked for the case that the machine itself dies.
"""

from __future__ import annotations

import os
import threading
from types import TracebackType

# A call keeps a processor busy for 0.2 ms, and a fast run would ask for one every few: so long the
# next one waits.
PAUSE_S = 0.05


class DiskSync:
    """Calls `os.fsync` in a thread of its own; requests that come too soon become one.

    Args:
        descriptor: Open file; stays the caller's, who closes it after `close`.
    """

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        lock = threading.Lock()
        self._wake, self._end = threading.Condition(lock), threading.Condition(lock)
        self._wanted = False
        self._ending = False
        self._error: OSError | None = None
        # A daemon: a process that is told to end must not wait for a disk.
        self._thread = threading.Thread(target=self._work, name='disk-sync', daemon=True)
        self._thread.start()

    def __enter__(self) -> DiskSync:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def request(self) -> None:
        """Ask for everything written so far; returns at once.

        Raises:
            OSError: An earlier request failed.
        """
        with self._wake:
            if self._error is not None:
                raise self._error
            if not self._wanted:
                self._wanted = True
                self._wake.notify()

    def close(self) -> None:
        """End the thread after its present call; what it has not begun is the caller's."""
        with self._wake:
            self._ending = True
            self._wake.notify()
            self._end.notify()
        self._thread.join()

    def _work(self) -> None:
        while True:
            with self._wake:
                self._wake.wait_for(lambda: self._wanted or self._ending)
                if self._ending:
                    return
                self._wanted = False
            try:
                os.fsync(self._descriptor)
            except OSError as err:
                with self._wake:
                    self._error = err
                return
            with self._end:
                self._end.wait_for(lambda: self._ending, PAUSE_S)
