# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What carries words of places, sides and ways; see `carriers.py`."""

from __future__ import annotations

from collections.abc import Callable

from aurora_core.parsing.doubts.clauses import meet
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import (
    AgentAction,
    ArrivalTrigger,
    Clause,
    DistanceTrigger,
    ScenarioSpec,
    UavAction,
)
from aurora_core.spec.vocabulary import BehaviorKind, LaneSide, Pattern


def _distinct(spec: ScenarioSpec, clause: Clause) -> bool:
    """Flights to places of which no two are the same."""
    places = [m.target for m in spec.missions if m.id in clause.ids]
    return len(set(places)) == len(places) > 1


def _at_place(spec: ScenarioSpec, clause: Clause) -> bool:
    """A flight to something, somebody who does so at a place, or no place that is named."""
    told = [b for a in spec.agents if a.id in clause.ids for b in a.behaviors]
    here = [b for b in told if b.span is not None and meet(b.span, clause.span)]
    here += [b for b in told if b.kind is BehaviorKind.PARK]
    acts = [e.action for e in spec.events if e.id in clause.ids]
    lands = any(isinstance(a, UavAction) and a.do == 'land' for a in acts)
    watches = any(m.target is not None for m in spec.missions if m.id in clause.ids)
    if any(b.target is not None for b in here) or (watches and not lands):
        return True
    places = [b.target for a in spec.agents for b in a.behaviors]
    places += [p.of for a in spec.agents for p in a.placements]
    places += [m.target for m in spec.missions]
    places += [e.trigger.place for e in spec.events if isinstance(e.trigger, ArrivalTrigger)]
    return not any(place is not None and is_place(place) for place in places)


def _parted(spec: ScenarioSpec, clause: Clause) -> bool:
    """An event that waits for a greater distance."""
    triggers = [e.trigger for e in spec.events if e.id in clause.ids]
    return any(isinstance(t, DistanceTrigger) and t.on == 'distance_above' for t in triggers)


def _crosses(spec: ScenarioSpec, clause: Clause) -> bool:
    """Somebody who crosses the road."""
    acts = (e.action for e in spec.events)
    return any(isinstance(a, AgentAction) and a.do == 'cross' for a in acts) or any(
        b.kind is BehaviorKind.CROSS for a in spec.agents for b in a.behaviors
    )


def _over_streets(spec: ScenarioSpec, clause: Clause) -> bool:
    """A flight along a street."""
    return any(m.over_streets or m.target for m in spec.missions if m.id in clause.ids)


def _sided(spec: ScenarioSpec, clause: Clause) -> bool:
    """A side or bearing of a flight, or a place of somebody on the ground."""
    flown = [m for m in spec.missions if m.id in clause.ids]
    away = [m.standoff_m for m in flown if m.standoff_m is not None]
    flies = any(m.side is not None or m.bearing_deg is not None for m in flown)
    flies = flies or any(s.provenance is Provenance.EXPLICIT for s in away)
    meets = [p for a in spec.agents for p in a.placements if p.span is not None]
    return flies or not flown or any(meet(p.span, clause.span) for p in meets if p.span)


def _lanes(spec: ScenarioSpec, clause: Clause) -> bool:
    """A pattern that goes to and fro."""
    return any(m.pattern is Pattern.LAWNMOWER for m in spec.missions if m.id in clause.ids)


def _left_lane(spec: ScenarioSpec, clause: Clause) -> bool:
    """A change to the lane on the left."""
    return LaneSide.LEFT in _lane_sides(spec, clause)


def _right_lane(spec: ScenarioSpec, clause: Clause) -> bool:
    """A change to the lane on the right."""
    return LaneSide.RIGHT in _lane_sides(spec, clause)


def _lane_sides(spec: ScenarioSpec, clause: Clause) -> set[LaneSide | None]:
    told = {
        e.action.side
        for e in spec.events
        if isinstance(e.action, AgentAction) and e.id in clause.ids
    }
    agents = [a for a in spec.agents if a.id in clause.ids]
    return told | {b.side for a in agents for b in a.behaviors}


OF_PLACES: dict[str, Callable[[ScenarioSpec, Clause], bool]] = {
    'sided': _sided,
    'lanes': _lanes,
    'left_lane': _left_lane,
    'right_lane': _right_lane,
    'distinct': _distinct,
    'at_place': _at_place,
    'parted': _parted,
    'crosses': _crosses,
    'over_streets': _over_streets,
}
