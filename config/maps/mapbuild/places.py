# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Zones and landmarks of a map."""

from __future__ import annotations

from dataclasses import dataclass

import shapely


@dataclass(frozen=True, slots=True, kw_only=True)
class Zone:
    """A named area; with kind `no_fly` the air above it from floor to ceiling is closed."""

    id: str
    name: str
    kind: str
    shape: shapely.Polygon
    floor_m: float = 0.0
    ceiling_m: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """A landmark, and a point on the street from which a vehicle reaches it."""

    name: str
    kind: str
    at: tuple[float, float]
    door: tuple[float, float]
