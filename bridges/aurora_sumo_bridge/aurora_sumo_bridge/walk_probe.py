# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sidewalks and crossings of a network, each really walked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations
from pathlib import Path

import libsumo

from aurora_sumo_bridge.network import PEDESTRIAN, Network
from aurora_sumo_bridge.sumo_process import SumoProcess

# Walks begin and end so far from the ends of a sidewalk, at most a quarter of it.
_INSET_M = 5.0
# A walk may take its own time so often, and wait so long at lights.
_PATIENCE = 1.5
_WAIT_S = 150.0
_SLOWEST_MPS = 1.0
# Pairs of sidewalks that are tried for a crossing, the nearest ones first.
_MOST_PAIRS = 8
# From an island, over one more crossing and the corner behind it, to the sidewalk there.
_MOST_HOPS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class Walk:
    """What came of walking along a sidewalk or over a crossing.

    Attributes:
        id: Lane of the sidewalk, or edge of the crossing.
        walked: It was gone through to its end.
        seconds: On it: for a crossing from kerb to kerb, waiting aside; 0 when not walked.
        why: What was wrong, '' when walked.
    """

    id: str
    walked: bool
    seconds: float
    why: str = ''


@dataclass(frozen=True, slots=True, kw_only=True)
class _Plan:
    """One walk: where it begins, where it leads, and what it has to go over."""

    id: str
    first_lane: str
    begin_m: float
    edges: tuple[str, ...]
    end_m: float
    over: str
    longest_s: float


def probe_walks(
    net_path: Path,
    vtypes_path: Path,
    sidewalks: Sequence[str],
    crossings: Sequence[str],
    dt_s: float,
) -> tuple[tuple[Walk, ...], tuple[Walk, ...]]:
    """Walk along every sidewalk and over every crossing, and say of each what came of it.

    Args:
        net_path: Network.
        vtypes_path: Additional file with the types; `pedestrian` walks.
        sidewalks: Lanes for walkers only.
        crossings: Internal edges of crossings.
        dt_s: Step.

    Returns:
        Walks along sidewalks and over crossings, in the order asked.

    Raises:
        GroundSimulatorError: SUMO does not start, or another client of this process is loaded.
    """
    process = SumoProcess(net_path=net_path, vtypes_path=vtypes_path, dt_s=dt_s, seed=1)
    try:
        network = Network()
        along = _walked([_along(network, lane) for lane in sidewalks], dt_s)
    finally:
        process.close()
    done: dict[str, Walk] = {}
    for attempt in range(_MOST_PAIRS):
        left = [c for c in crossings if c not in done or not done[c].walked]
        if not left:
            break
        process = SumoProcess(net_path=net_path, vtypes_path=vtypes_path, dt_s=dt_s, seed=1)
        try:
            corners = _Corners(Network())
            plans = []
            for crossing in left:
                plan = corners.plan(crossing, attempt)
                if plan is not None:
                    plans.append(plan)
                elif attempt == 0:
                    done[crossing] = Walk(
                        id=crossing, walked=False, seconds=0.0, why='no sidewalk leads to it'
                    )
            if not plans:
                break
            done |= {walk.id: walk for walk in _walked(plans, dt_s)}
        finally:
            process.close()
    return along, tuple(done[crossing] for crossing in crossings)


def _along(network: Network, lane_id: str) -> _Plan:
    length_m = float(libsumo.lane.getLength(lane_id))
    inset_m = min(_INSET_M, 0.25 * length_m)
    edge = network.edge_of(lane_id)
    return _Plan(
        id=lane_id,
        first_lane=lane_id,
        begin_m=inset_m,
        edges=(edge,),
        end_m=length_m - inset_m,
        over=edge,
        longest_s=length_m / _SLOWEST_MPS * _PATIENCE + 10.0,
    )


class _Corners:
    """Which sidewalks meet at the two ends of each crossing."""

    def __init__(self, network: Network) -> None:
        self._network = network
        # Walkers go both ways, so what leads into a corner is also reached from it.
        self._meets: dict[str, set[str]] = {}
        for lane_id in libsumo.lane.getIDList():
            if not network.allows(lane_id, PEDESTRIAN):
                continue
            for link in libsumo.lane.getLinks(lane_id):
                other = str(link[0])
                self._meets.setdefault(lane_id, set()).add(other)
                self._meets.setdefault(other, set()).add(lane_id)

    def plan(self, crossing: str, attempt: int) -> _Plan | None:
        """Return the walk over a crossing between the next pair of sidewalks, None: no more."""
        pairs = sorted(self._pairs(f'{crossing}_0'))
        if attempt >= len(pairs):
            return None
        _, first, last, begin_m, end_m = pairs[attempt]
        edges = (self._network.edge_of(first), self._network.edge_of(last))
        return _Plan(
            id=crossing,
            first_lane=first,
            begin_m=begin_m,
            edges=edges,
            end_m=end_m,
            over=crossing,
            longest_s=_WAIT_S,
        )

    def _pairs(self, lane_id: str) -> Iterator[tuple[float, str, str, float, float]]:
        corners = sorted(lane for lane in self._meets.get(lane_id, ()) if lane.startswith(':'))
        reached = {corner: self._sidewalks(corner, lane_id) for corner in corners}
        for first_corner, last_corner in permutations(corners, 2):
            for first in reached[first_corner]:
                for last in reached[last_corner]:
                    if self._network.edge_of(first) == self._network.edge_of(last):
                        continue
                    begin_m, first_off_m = self._near(first, first_corner)
                    end_m, last_off_m = self._near(last, last_corner)
                    yield first_off_m + last_off_m, first, last, begin_m, end_m

    def _sidewalks(self, corner: str, crossing: str) -> list[str]:
        """Return the sidewalks at a corner, or behind other crossings of an island there."""
        seen, found = {corner, crossing}, set[str]()
        front = [corner]
        for _ in range(_MOST_HOPS):
            met = sorted({lane for here in front for lane in self._meets.get(here, ())} - seen)
            seen.update(met)
            found.update(lane for lane in met if not lane.startswith(':'))
            front = [lane for lane in met if lane.startswith(':')]
        return sorted(found)

    def _near(self, lane_id: str, corner: str) -> tuple[float, float]:
        """Return a position on a sidewalk near a corner, and how far that is."""
        length_m = float(libsumo.lane.getLength(lane_id))
        inset_m = min(_INSET_M, 0.25 * length_m)
        middle = _middle(libsumo.lane.getShape(corner))
        shape = libsumo.lane.getShape(lane_id)
        squared, position_m = min(
            (_squared(shape[0], middle), inset_m),
            (_squared(shape[-1], middle), length_m - inset_m),
        )
        return position_m, squared


def _walked(plans: Sequence[_Plan], dt_s: float) -> tuple[Walk, ...]:
    """Walk all plans at once, each by a person of its own."""
    why: dict[int, str] = {}
    for number, plan in enumerate(plans):
        person = str(number)
        try:
            libsumo.person.add(
                person,
                plan.edges[0],
                plan.begin_m,
                libsumo.constants.DEPARTFLAG_NOW,
                PEDESTRIAN,
            )
            libsumo.person.appendWalkingStage(person, plan.edges, plan.end_m)
        except libsumo.TraCIException as err:
            why[number] = f'SUMO says: {err}'
    under_way = {n for n in range(len(plans)) if n not in why}
    ticks_over = dict.fromkeys(under_way, 0)
    last_edge = dict.fromkeys(under_way, '')
    tick = 0
    while under_way:
        libsumo.simulationStep()
        tick += 1
        present = set(libsumo.person.getIDList())
        for number in sorted(under_way):
            plan = plans[number]
            if str(number) in present:
                edge = str(libsumo.person.getRoadID(str(number)))
                last_edge[number] = edge
                ticks_over[number] += edge == plan.over
                if tick * dt_s <= plan.longest_s:
                    continue
                why[number] = f'not through after {plan.longest_s:.0f} s, on {edge}'
                libsumo.person.remove(str(number))
            elif last_edge[number] != plan.edges[-1]:
                why[number] = f'gone on {last_edge[number] or "nothing"}'
            elif not ticks_over[number]:
                why[number] = 'walkers take another way'
            under_way.discard(number)
    return tuple(
        Walk(
            id=plan.id,
            walked=number not in why,
            seconds=0.0 if number in why else round(ticks_over[number] * dt_s, 2),
            why=why.get(number, ''),
        )
        for number, plan in enumerate(plans)
    )


def _middle(shape: Sequence[tuple[float, ...]]) -> tuple[float, float]:
    return sum(p[0] for p in shape) / len(shape), sum(p[1] for p in shape) / len(shape)


def _squared(a: Sequence[float], b: Sequence[float]) -> float:
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
