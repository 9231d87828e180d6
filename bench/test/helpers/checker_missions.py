# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Missions as an annotation states them, and UAVs that fly them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

Motion = Callable[[Any], tuple[Any, Any, Any]]


def fly_route(
    points: Sequence[tuple[float, float]], z: float, speed: float, start: float
) -> Motion:
    """Fly from point to point from a time on."""
    legs = np.linalg.norm(np.diff(np.array(points), axis=0), axis=1)
    marks = start + np.concatenate([[0.0], np.cumsum(legs)]) / speed

    def motion(t: Any) -> tuple[Any, Any, Any]:
        xs, ys = zip(*points, strict=True)
        return np.interp(t, marks, xs), np.interp(t, marks, ys), z

    return motion


RECTANGLE = {
    'kind': 'mission',
    'ref': 'm1',
    'uav': 'drone',
    'mode': 'navigate',
    'pattern': 'rectangle',
    'altitude_m': 40,
}


def flies(stage: Any, points: Sequence[tuple[float, float]], speed: float = 10.0) -> None:
    stage.uav('drone', fly_route(points, 40.0, speed, 12.0), ends=(58.0,))


def climb_at(at_s: float) -> dict[str, Any]:
    action = {'do': 'ascend', 'uav': 'drone', 'altitude_m': 70}
    return {
        'kind': 'event',
        'ref': 'e1',
        'trigger': {'on': 'time', 'at_s': at_s},
        'action': action,
    }
