# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Steady wall time as an argument: for timings in the report, never for a decision."""

from __future__ import annotations

from typing import Protocol


class SteadyClock(Protocol):
    """A clock that never goes back."""

    def seconds(self) -> float:
        """Return steady seconds since some moment."""
