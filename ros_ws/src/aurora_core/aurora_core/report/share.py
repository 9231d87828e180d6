# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shares with their uncertainty."""

from __future__ import annotations

import math

from aurora_core.document import Document

# Two-sided 95 % quantile of the normal distribution.
_Z = 1.959963984540054


class Share(Document):
    """Hits out of trials with the 95 % Wilson score interval.

    Source: E. B. Wilson, "Probable inference, the law of succession, and statistical inference",
    J. Am. Stat. Assoc. 22 (1927) 209-212.
    """

    met: int = 0
    total: int = 0

    @property
    def value(self) -> float:
        """The share; 0 without trials."""
        return self.met / self.total if self.total else 0.0

    @property
    def interval(self) -> tuple[float, float]:
        """Low and high end; [0, 1] without trials."""
        if self.total == 0:
            return 0.0, 1.0
        n, p = self.total, self.value
        scale = 1.0 + _Z**2 / n
        middle = (p + _Z**2 / (2 * n)) / scale
        half = _Z * math.sqrt(p * (1.0 - p) / n + _Z**2 / (4 * n * n)) / scale
        return max(0.0, middle - half), min(1.0, middle + half)

    def plus(self, met: int, total: int) -> Share:
        """Return the share with more trials."""
        return Share(met=self.met + met, total=self.total + total)
