# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a stated speed can show: far from junctions, and before one has caught up."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.grounding.pace import own_speed_mps
from aurora_core.grounding.sites import SeatedAgent, Site, open_way_m
from aurora_core.knowledge.limits import Tolerances
from aurora_core.quantities.free_road import caught_up_m
from aurora_core.spec.scenario import ScenarioSpec

# A stated speed shows well when it is held for so long (s), within so much time (s).
_SHOWS_WELL_S = 8.0
LOOKED_S = 40.0

# A stated speed has shown when it was held for so long (s).
_SHOWN_S = 2.0


def room_for(speed_mps: float, site: Site, tolerances: Tolerances) -> float:
    """Return whether a stated speed can show near a site, in [0, 1]: far from junctions.

    Args:
        speed_mps: The speed.
        site: Where its vehicles stand.
        tolerances: In force.
    """
    settle_m = speed_mps * speed_mps / (2.0 * tolerances.route_acceleration_mps2)
    low_m = site.origin_arc_m + settle_m
    high_m = low_m + LOOKED_S * speed_mps
    open_m = open_way_m(site.origin_path, low_m, high_m, tolerances.free_road_m)
    return min(1.0, open_m / (_SHOWS_WELL_S * speed_mps))


def shows_before(spec: ScenarioSpec, site: Site, tolerances: Tolerances) -> float:
    """Return which share of the time that a speed needs to show each one has before, in [0, 1].

    Args:
        spec: The request.
        site: Where its vehicles stand.
        tolerances: In force.
    """
    shares = [
        open_way_m(rear.path, low_m, high_m, tolerances.free_road_m) / (_SHOWN_S * speed_mps)
        for rear, low_m, high_m, speed_mps in _chases(spec, site, tolerances)
    ]
    return min([1.0, *shares])


def _chases(
    spec: ScenarioSpec, site: Site, tolerances: Tolerances
) -> Iterator[tuple[SeatedAgent, float, float, float]]:
    """Yield who comes up behind a slower one, on which stretch of its way (m), and how fast."""
    for rear in site.seated:
        speed_mps = own_speed_mps(rear.agent)
        for front in site.seated:
            slow_mps = own_speed_mps(front.agent)
            gap_m = front.arc_m - rear.arc_m
            if speed_mps is None or slow_mps is None or slow_mps >= speed_mps or gap_m <= 0.0:
                continue
            if front.path.edge_ids != rear.path.edge_ids:
                continue
            closes_m = gap_m - caught_up_m(speed_mps, tolerances.tailgate_time_gap_s)
            settle_m = speed_mps * speed_mps / (2.0 * tolerances.route_acceleration_mps2)
            way_m = speed_mps * closes_m / (speed_mps - slow_mps)
            yield rear, rear.arc_m + settle_m, rear.arc_m + way_m, speed_mps
