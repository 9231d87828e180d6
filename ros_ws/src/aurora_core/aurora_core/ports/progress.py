# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Telling somebody who waits that long work goes on."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

_T = TypeVar('_T')

# Called whenever a piece of the work is done.
Progress = Callable[[], None]


def quietly() -> None:
    """Tell nobody."""


def after(progress: Progress, done: _T) -> _T:
    """Return what is done, once that is told."""
    progress()
    return done
