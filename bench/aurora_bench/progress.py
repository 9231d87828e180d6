# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Progress of a campaign on standard error: one line per step, with the time it has taken."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import TextIO


class Progress:
    """Numbers the steps of a campaign.

    Args:
        name: Of the campaign; begins every line.
        steps: How many there will be; 0 when unknown.
        stream: None: standard error.
        clock: Steady seconds.
    """

    def __init__(
        self,
        name: str,
        steps: int = 0,
        stream: TextIO | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._name = name
        self._steps = steps
        self._stream = stream
        self._clock = clock
        self._begun_s = clock()
        self._done = 0

    @property
    def elapsed_s(self) -> float:
        """Steady seconds since the campaign began."""
        return self._clock() - self._begun_s

    def step(self, text: str) -> None:
        """Say what the next step is or what it gave, and count it."""
        self._done += 1
        share = f'{self._done}/{self._steps}' if self._steps else f'{self._done}'
        self._line(f'[{share}] {text}')

    def note(self, text: str) -> None:
        """Say something without counting."""
        self._line(text)

    def _line(self, text: str) -> None:
        stream = self._stream if self._stream is not None else sys.stderr
        stream.write(f'{self._name} {self.elapsed_s:6.0f} s  {text}\n')
        stream.flush()
