# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Work for tests of the pool; in a module of its own, which the workers can import."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass

Task = tuple[str, int]


@dataclass(frozen=True)
class Squares:
    """Squares numbers, or does what the task's word says.

    Attributes:
        broken: It cannot prepare itself.
    """

    broken: str = ''

    def prepare(self) -> None:
        """Print as libraries do, and break if told so."""
        print('loading', flush=True)  # noqa: T201
        if self.broken:
            raise RuntimeError(self.broken)

    def __call__(self, task: Task) -> tuple[int, int]:
        """Return the square and who did it."""
        word, value = task
        if word == 'exit':
            os._exit(7)
        if word == 'crash':
            os.kill(os.getpid(), signal.SIGKILL)
        if word == 'hang':
            signal.pause()
        if word == 'raise':
            raise ValueError(f'cannot square {value}')
        if word == 'interrupt':
            os.kill(os.getpid(), signal.SIGINT)
        return value * value, os.getpid()
