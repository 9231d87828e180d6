# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The communication term of the anchor score: do the links of a request reach at a site?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import dist

import numpy as np

from aurora_core.comm.reach import reach_of
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.planned_flight import (
    PlannedFlight,
    Point3,
    first_point,
    last_point,
)
from aurora_core.grounding.sites import Site
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import Limits
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.scene import Link
from aurora_core.spec.vocabulary import MissionMode


def link_score(
    spec: ScenarioSpec,
    site: Site,
    flights: Mapping[str, Sequence[PlannedFlight]],
    airspace: Airspace,
    types: Mapping[str, AgentTypeRecord],
    limits: Limits,
) -> float:
    """Return how well the worst link reaches at a site, in [0, 1]; 1 without a link.

    Of a link it is the mean over the places its two ends take: agents where they start, UAVs
    where each mission begins and ends. There it is 1 within the range, with or without line of
    sight, and beyond it the range divided by the distance.

    Args:
        spec: Whose links.
        site: With its agents seated.
        flights: Planned missions of each UAV.
        airspace: For lines of sight between buildings.
        types: Heights of agents.
        limits: Ranges that are not stated.

    Source: paper, joint anchor score, term of communication geometry.
    """

    def places(body: str) -> list[Point3]:
        if body in flights:
            placed = [f for f in flights[body] if f.plan.is_placed]
            ends = [(first_point(f.plan, site), _end(f, site)) for f in placed]
            return list(dict.fromkeys(place for both in ends for place in both))
        seat = site.seat(body)
        if seat is None:
            return []
        x, y, _, _ = seat.path.position_at(seat.arc_m)
        return [(x, y, types[seat.agent.type.value].height_m / 2.0)]

    scores = [
        _score(link, places(link.sender), places(link.receiver), airspace, limits)
        for link in spec.links
    ]
    return min(scores, default=1.0)


def _end(flight: PlannedFlight, site: Site) -> Point3:
    """Return where a mission ends; of a track where it begins: nobody knows more yet."""
    if flight.plan.mode is MissionMode.TRACK:
        return first_point(flight.plan, site)
    return last_point(flight.plan)


def _score(
    link: Link,
    senders: Sequence[Point3],
    receivers: Sequence[Point3],
    airspace: Airspace,
    limits: Limits,
) -> float:
    pairs = [(a, b) for a in senders for b in receivers]
    if not pairs:
        return 1.0  # an end that is placed later hinders no site
    reach = reach_of(link, limits)
    a, b = (np.array(ends, dtype=np.float64) for ends in zip(*pairs, strict=True))
    sees = airspace.sight.clearance_series(a, b) > 0.0
    found = [
        min(1.0, reach.range_m(bool(free)) / max(dist(*pair), 1e-9))
        for pair, free in zip(pairs, sees, strict=True)
    ]
    return sum(found) / len(found)
