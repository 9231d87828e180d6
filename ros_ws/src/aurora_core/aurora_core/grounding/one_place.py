# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Several vehicles at, or before, one intersection or crosswalk: how far apart that puts them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aurora_core.grounding.distances import Distances
from aurora_core.grounding.places import POINTS
from aurora_core.grounding.ties import IN_LINE_M, Tie
from aurora_core.spec.scenario import GroundAgent, Placement
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import Place, Relation

# Who is at such a place stands with its front bumper so far before its middle (m): at the line of
# most intersections, or at the edge of a crosswalk; and with its centre at most so far from it.
_FRONT_M = {Place.INTERSECTION: 10.0, Place.CROSSWALK: 3.0}
_CENTRE_M = 14.3

_AT = (Relation.AT, Relation.PARKED_AT)


def is_before_place(placement: Placement) -> bool:
    """Tell whether a placement says how far before an intersection or a crosswalk one stands."""
    return placement.relation is Relation.BEFORE and placement.of in POINTS


def common_places(vehicles: Sequence[GroundAgent], distances: Distances) -> Iterator[Tie]:
    """Yield the ties of vehicles before, or at, the place before which another one stands.

    "A van 6 m before the crosswalk, the ego 30 m before it" are 24 m apart on one street. Of whom
    nobody says how far it is lines up behind the others.
    """
    for place in POINTS:
        told = [
            (a.id, p, to_place_m)
            for a in vehicles
            for p in a.placements
            if p.of == place and (to_place_m := _before_m(a.id, p, distances)) is not None
        ]
        base = next((one for one in told if is_before_place(one[1])), None)
        if base is None:
            continue
        taken_m = [
            base[2],
            *(way_m for _, p, way_m in told if p is not base[1] and is_stated(p.distance_m)),
        ]
        for name, placement, to_place_m in told:
            if placement is base[1]:
                continue
            if not is_stated(placement.distance_m) and is_before_place(placement):
                while any(abs(to_place_m - m) < IN_LINE_M for m in taken_m):
                    to_place_m += IN_LINE_M
                taken_m.append(to_place_m)
            yield Tie(name, base[0], base[2] - to_place_m, 0, guess=True)


def _before_m(name: str, placement: Placement, distances: Distances) -> float | None:
    """Return how far before a place its placement puts a vehicle (m), None where that is open."""
    if placement.relation is Relation.BEFORE:
        return distances.placed(name, None, placement)
    if placement.relation not in _AT or placement.distance_m is not None:
        return None
    half_m = distances.lengths_m.get(name, 0.0) / 2.0
    return min(_CENTRE_M, half_m + _FRONT_M[Place(str(placement.of))])
