# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pure conversions between SUMO's positions and those of the map frame.

SUMO speaks of the middle of the FRONT bumper, everything else in AURORA of the centre of the box;
angles turn in `aurora_core.geometry.frames`.
"""

from __future__ import annotations


def centre_from_front(
    front_x_m: float, front_y_m: float, heading_x: float, heading_y: float, length_m: float
) -> tuple[float, float]:
    """Return the box centre (ENU, m) of a body whose front bumper is at the given point."""
    half_m = 0.5 * length_m
    return front_x_m - half_m * heading_x, front_y_m - half_m * heading_y


def front_from_centre(
    centre_x_m: float, centre_y_m: float, heading_x: float, heading_y: float, length_m: float
) -> tuple[float, float]:
    """Return the front bumper (ENU, m) of a body whose box centre is at the given point."""
    half_m = 0.5 * length_m
    return centre_x_m + half_m * heading_x, centre_y_m + half_m * heading_y
