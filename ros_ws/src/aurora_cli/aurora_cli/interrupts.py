# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C asks a run to stop and leave a readable folder; a second one stops at once."""

from __future__ import annotations

import os
import signal
from contextlib import suppress
from types import FrameType
from typing import Any, Self

_STANDARD_ERROR = 2  # file descriptor


class Interrupts:
    """Context in which SIGINT, SIGTERM and SIGHUP set `requested` instead of raising.

    A terminal that is closed sends SIGHUP; `nohup` has it ignored, and it stays so.
    """

    def __init__(self) -> None:
        self.requested = False
        self._before: dict[int, Any] = {}

    def __enter__(self) -> Self:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if number == signal.SIGHUP and signal.getsignal(number) is signal.SIG_IGN:
                continue
            self._before[number] = signal.signal(number, self._on_signal)
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def cancelled(self) -> bool:
        """Tell whether the user wants to stop."""
        return self.requested

    def _on_signal(self, _number: int, _frame: FrameType | None) -> None:
        if self.requested:
            raise KeyboardInterrupt
        self.requested = True
        # Not through sys.stderr: the signal may have come amid a write of the run to it, and a
        # buffer that is written to again from inside raises RuntimeError.
        with suppress(OSError):
            os.write(_STANDARD_ERROR, b'aurora: stopping; once more to stop at once\n')
