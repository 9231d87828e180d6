# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A queue of samples that is one array at any time."""

from __future__ import annotations

import numpy as np

from aurora_core.stl.windows import FloatArray

_LEAST_ROOM = 64  # samples


class Kept:
    """Samples that come at the end and go at the front, each at a constant cost on average.

    Room is at most some four times what was kept at the last change of it, so a long push leaves
    no large array behind once its samples are gone.

    Args:
        values: The first samples; copied.
    """

    def __init__(self, values: FloatArray) -> None:
        self._start = 0
        self._stop = 0
        self._room: FloatArray = np.empty(0)
        self.append(values)

    def __len__(self) -> int:
        """Return how many samples are kept."""
        return self._stop - self._start

    @property
    def values(self) -> FloatArray:
        """The samples; a view that holds until the next change."""
        return self._room[self._start : self._stop]

    def append(self, values: FloatArray) -> None:
        """Add samples at the end."""
        stop = self._stop + len(values)
        if stop > len(self._room):
            self._move(len(values))
            stop = self._stop + len(values)
        self._room[self._stop : stop] = values
        self._stop = stop

    def drop(self, count: int) -> None:
        """Forget the first samples."""
        self._start += count
        if len(self._room) > _LEAST_ROOM + 4 * len(self):
            self._move(0)

    def _move(self, more: int) -> None:
        """Move into new room for twice the samples and those that come."""
        kept = self.values
        room = np.empty(max(_LEAST_ROOM, 2 * (len(kept) + more)))
        room[: len(kept)] = kept
        self._room, self._start, self._stop = room, 0, len(kept)
