# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events as an annotation states them, and bodies that move by a profile."""

from __future__ import annotations

from typing import Any

import numpy as np


def event_of(on: dict[str, Any] | None, do: dict[str, Any] | None, **more: Any) -> dict[str, Any]:
    found: dict[str, Any] = {'kind': 'event', 'ref': 'e1', **more}
    if on is not None:
        found['trigger'] = on
    if do is not None:
        found['action'] = do
    return found


AT_20 = {'on': 'time', 'at_s': 20}


def does(do: str, **more: Any) -> dict[str, Any]:
    return {'do': do, 'agent': 'car1', **more}


def profile_of(*points: tuple[float, float]) -> Any:
    times, speeds = zip(*points, strict=True)
    return lambda t: np.interp(t, times, speeds)
