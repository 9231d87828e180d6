# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a flying UAV keeps from a place, whatever its height."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.geometry.polygon import Polygon, PolygonSet
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName

# Distances are not told apart beyond this (m).
_FARTHEST_M = 1e5


class Clearance(StatedSeries):
    """Horizontal distance from the outline of a place, metres; 0 over it.

    The outline of a landmark that is a building is that of the building; all other places are
    where the world says. Of a body it is the distance from its reference point.
    """

    name = QuantityName.CLEARANCE
    kind: Literal['clearance'] = 'clearance'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the distance at every tick."""
        uav, thing = condition.of
        building = context.view.geometry.building_of(thing)
        if building is None:
            return motion.horizontal_distance(context.view, uav, thing)
        outline = Polygon(
            np.asarray(building.ring, dtype=np.float64),
            tuple(np.asarray(hole, dtype=np.float64) for hole in building.holes),
        )
        xy = context.view.reference(uav)[:, :2]
        return np.maximum(PolygonSet((outline,)).signed_distance(xy, _FARTHEST_M), 0.0)
