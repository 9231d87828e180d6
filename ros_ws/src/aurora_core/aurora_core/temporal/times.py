# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When each event, mission and landing of a plan can be."""

from __future__ import annotations

from itertools import chain

from aurora_core.outcomes.schedule import PlannedTime
from aurora_core.temporal.demands import demands, horizon_link, inside_links
from aurora_core.temporal.flights import flight_links
from aurora_core.temporal.happenings import event_links
from aurora_core.temporal.links import START, Basis
from aurora_core.temporal.network import first_conflict
from aurora_core.temporal.stn import SECOND, Stn
from aurora_core.temporal.words import told


def planned_times(basis: Basis, horizon_s: float) -> tuple[tuple[PlannedTime, ...], str]:
    """Return the earliest and latest times of a plan, or none and what excludes itself in it.

    Args:
        basis: The request with its plan.
        horizon_s: By when all is done.
    """
    links = (
        *flight_links(basis),
        *event_links(basis),
        horizon_link(basis, horizon_s),
        *inside_links(basis),
        *chain.from_iterable(demands(basis)),
    )
    conflict = first_conflict(links)
    if conflict:
        return (), told(conflict)
    spans = Stn([link.edge for link in links]).spans_us(START)
    assert spans is not None  # there is no conflict
    found = [
        PlannedTime(point=point, earliest_s=earliest / SECOND, latest_s=latest / SECOND)
        for point, (earliest, latest) in spans.items()
        if _is_shown(point) and earliest is not None and latest is not None
    ]
    return tuple(found), ''


def _is_shown(point: str) -> bool:
    """Tell whether a point is one that people ask for: an event, a mission, a landing."""
    kind, *rest = point.split('/')
    return kind == 'missions' or (kind, *rest[1:]) in (('events',), ('uavs', 'landed'))
