# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Few samples that tell a motion over time to a tolerance."""

from __future__ import annotations

import numpy as np

from aurora_core.trace.trace import FloatArray


def kept_samples(times_s: FloatArray, points: FloatArray, tolerance: float) -> list[int]:
    """Return indices between which a motion is straight and steady, to a tolerance.

    At every sample, the point that lies on the straight line between the kept samples around it,
    at that time, is no farther away than the tolerance. Speeds are kept with it, not the shape
    alone.

    Args:
        times_s: (n,) increasing.
        points: (n, d), finite.
        tolerance: Greatest distance, in the unit of the points.

    Returns:
        Sorted indices, first and last sample always among them.

    Source: Meratnia and de By 2004, "Spatiotemporal compression techniques for moving point
    objects" (TD-TR: Douglas-Peucker with time-synchronous distance).
    """
    if len(times_s) == 0:
        return []
    kept = {0, len(times_s) - 1}
    stack = [(0, len(times_s) - 1)]
    while stack:
        first, last = stack.pop()
        if last - first < 2:
            continue
        share = (times_s[first + 1 : last] - times_s[first]) / (times_s[last] - times_s[first])
        line = points[first] + share[:, None] * (points[last] - points[first])
        off = np.linalg.norm(points[first + 1 : last] - line, axis=1)
        worst = int(np.argmax(off))
        if off[worst] > tolerance:
            middle = first + 1 + worst
            kept.add(middle)
            stack += [(first, middle), (middle, last)]
    return sorted(kept)
