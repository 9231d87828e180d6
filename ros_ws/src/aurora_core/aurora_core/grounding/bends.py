# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a street bends between two vehicles, they are nearer than the way between them is long.

A stated distance is judged both ways, so it can be kept on a straight street only.
"""

from __future__ import annotations

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.sites import Site
from aurora_core.grounding.ties import BeforePlace
from aurora_core.knowledge.limits import Tolerance
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import Relation

_ALONG = (Relation.AHEAD, Relation.BEHIND)
# The rest of the tolerance is for the simulator's way of counting on curves.
_USED = 0.25


def bends_between(
    spec: ScenarioSpec, site: Site, tolerance: Tolerance, before: BeforePlace | None = None
) -> bool:
    """Tell whether a bend spoils a stated distance between two vehicles of the convoy.

    Args:
        spec: Request.
        site: Place of the convoy.
        tolerance: Of stated distances.
        before: Who stands before a place: the way there is counted as it is driven, so that a
            bend or another lane spoils that distance, too.
    """
    seats = {seat.agent.id: seat for seat in site.seated}
    if before is not None:
        member = seats[before.agent]
        x, y, _, _ = member.path.position_at(member.arc_m)
        end_m = min(member.path.length_m, member.arc_m + before.distance_m)
        ahead_x, ahead_y, _, _ = member.path.position_at(end_m)
        lost_m = before.distance_m - norm2(ahead_x - x, ahead_y - y)
        aside = any(member.arc_m < c.end_m and c.start_m < end_m for c in member.path.lane_changes)
        if aside or lost_m > _USED * tolerance.of(before.distance_m):
            return True
    for agent in spec.agents:
        for placement in agent.placements:
            own, other = seats.get(agent.id), seats.get(placement.of or '')
            stated = placement.distance_m
            if own is None or other is None or stated is None:
                continue
            if stated.provenance is Provenance.DEFAULT or placement.relation not in _ALONG:
                continue
            x, y, _, _ = own.path.position_at(own.arc_m)
            other_x, other_y, _, _ = other.path.position_at(other.arc_m)
            straight_m = norm2(x - other_x, y - other_y)
            slack_m = tolerance.of(stated.value, approximate=stated.approximate)
            if abs(straight_m - abs(own.arc_m - other.arc_m)) > _USED * slack_m:
                return True
    return False
