# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Air that a request asks its UAVs to stay out of: so far round a place, at any height."""

from __future__ import annotations

import shapely

from aurora_core.grounding.places import MapPlaces
from aurora_core.outcomes.grounded import Ring
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import ScenarioSpec

# Straight pieces of a quarter of a circle: they cut less than a metre off 40 m.
_PIECES = 8


def kept_out(spec: ScenarioSpec, places: MapPlaces) -> tuple[Ring, ...]:
    """Return the outlines that UAVs stay out of, each grown by the distance that is asked.

    Args:
        spec: The request; a clearance that is asked of one UAV is kept by all.
        places: Of the map.
    """
    rings = []
    for stated in spec.conditions:
        if stated.quantity != QuantityName.CLEARANCE or stated.op not in ('>=', '>'):
            continue
        for place in (name for name in stated.of if is_landmark(name)):
            building = places.building(place)
            shape = (
                shapely.Point(places.itself(place, (0.0, 0.0)))
                if building is None
                else shapely.Polygon(building.ring)
            )
            grown = shape.buffer(max(stated.value.value, 0.0), quad_segs=_PIECES)
            if not grown.is_empty:
                corners = shapely.get_coordinates(grown.exterior)[:-1].tolist()
                rings.append(tuple((x, y) for x, y in corners))
    return tuple(rings)
