# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long an answer takes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aurora_bench.results import Table


def seconds_per_prompt(seconds: Sequence[float]) -> dict[str, float]:
    """Return mean, median, 95th percentile and maximum of wall-clock times (s)."""
    if not seconds:
        return {}
    return {
        'mean': float(np.mean(seconds)),
        'median': float(np.median(seconds)),
        'p95': float(np.percentile(seconds, 95)),
        'max': float(np.max(seconds)),
    }


def timing_table(seconds: Sequence[float]) -> Table:
    """Return the same in milliseconds, as a table."""
    return Table(
        headings=('reading and checking a prompt', 'ms'),
        rows=tuple((name, 1e3 * s) for name, s in seconds_per_prompt(seconds).items()),
    )
