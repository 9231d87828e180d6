# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The steady clock that engines hand to the pipeline."""

from __future__ import annotations

import time


class MonotonicClock:
    """Steady wall time, for the timings of a report."""

    def seconds(self) -> float:
        """Return seconds since some moment."""
        return time.monotonic()
