# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The formulas behind the signals, written once for one tick and for a whole run.

Every function takes scalars or arrays of one shape and uses only + - * / sqrt and comparisons,
element by element; one tick and the whole series therefore agree to the last bit.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2, norm2_array, norm3, norm3_array
from aurora_core.spec.parameter import Bound

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Number = TypeVar('Number', float, FloatArray)


def distance_2d(dx: Number, dy: Number) -> Number:
    """Return the length of (dx, dy)."""
    return norm2(dx, dy) if isinstance(dx, float) else norm2_array(dx, dy)


def distance_3d(dx: Number, dy: Number, dz: Number) -> Number:
    """Return the length of (dx, dy, dz)."""
    return norm3(dx, dy, dz) if isinstance(dx, float) else norm3_array(dx, dy, dz)


def bound_error(value: Number, wanted: float, bound: Bound) -> Number:
    """Return how far a value is off a wanted one, 0 or less where a one-sided bound holds."""
    if bound is Bound.AT_LEAST:
        return wanted - value
    if bound is Bound.AT_MOST:
        return value - wanted
    return abs(value - wanted)


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackRule:
    """When a UAV tracks its target.

    Attributes:
        standoff_m: Wanted horizontal distance.
        standoff_bound: How it binds.
        horizontal_m: Tolerance on it.
        altitude_m: Wanted altitude above ground.
        altitude_bound: How it binds.
        vertical_m: Tolerance on it.
    """

    standoff_m: float
    standoff_bound: Bound = Bound.EXACTLY
    horizontal_m: float
    altitude_m: float
    altitude_bound: Bound = Bound.EXACTLY
    vertical_m: float


def track_errors(
    rule: TrackRule, dx: Number, dy: Number, altitude_m: Number
) -> tuple[Number, Number]:
    """Return horizontal and altitude error in metres; tracked where both are in tolerance.

    Args:
        rule: What is wanted.
        dx: UAV minus target, east.
        dy: North.
        altitude_m: UAV above ground.
    """
    away = distance_2d(dx, dy)
    return (
        bound_error(away, rule.standoff_m, rule.standoff_bound),
        bound_error(altitude_m, rule.altitude_m, rule.altitude_bound),
    )


class SightEnd(StrEnum):
    """What kind of end a sight line has; see `sight_height`."""

    UAV = 'uav'
    VEHICLE = 'vehicle'
    PERSON = 'person'
    PLACE = 'place'


# Contract: a person is seen at 1.0 m, a place 1 m above ground, a vehicle at half its height.
PERSON_SIGHT_M = 1.0
PLACE_SIGHT_M = 1.0


def sight_height(end: SightEnd, height_m: float) -> float:
    """Return the height above ground of the sight point of a body on the ground."""
    if end is SightEnd.PERSON:
        return PERSON_SIGHT_M
    if end is SightEnd.PLACE:
        return PLACE_SIGHT_M
    return height_m / 2.0


# Contract: drivers look out at this share of the height of their vehicle, persons at 1.6 m.
DRIVER_EYE_SHARE = 0.8
PERSON_EYE_M = 1.6


def eye_height(end: SightEnd, height_m: float) -> float:
    """Return the height above ground from which a body on the ground looks."""
    return PERSON_EYE_M if end is SightEnd.PERSON else DRIVER_EYE_SHARE * height_m


def ahead_m(dx: Number, dy: Number, heading_x: Number, heading_y: Number) -> Number:
    """Return how far (dx, dy) leads along a heading (unit vector); a driver sees from 0 on."""
    return dx * heading_x + dy * heading_y
