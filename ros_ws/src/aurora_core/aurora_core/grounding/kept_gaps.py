# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How vehicles drive that keep a stated distance all the way.

Whoever follows gets the gap at the start as the gap that it never goes below, and a time gap that
adds next to nothing to it at speed; whoever is followed accelerates no harder than its follower,
and of an exact distance is slower than that one may be: who lost some way in a bend or at a light
makes up for it. Several who follow one vehicle in line keep close, so that the last one still
follows it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from aurora_core.grounding.kept_apart import kept_apart
from aurora_core.grounding.sites import SeatedAgent
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, Relation

# Room inside a bound on the distance of two, and the least gap (m).
_ROOM_M = 2.0
_LEAST_M = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptGap:
    """A vehicle that stays at a stated distance behind another one.

    Attributes:
        follower: Id.
        leader: Id.
        gap_m: Bumper to bumper at the start.
        acceleration_mps2: What the follower can do.
        exact: It is to be no greater, either.
        longer_braking_s2pm: Half of what the follower needs to brake for each (m/s)^2 more than
            the leader (s^2/m), which the simulator keeps free beside the gap.
    """

    follower: str
    leader: str
    gap_m: float
    acceleration_mps2: float
    exact: bool = False
    longer_braking_s2pm: float = 0.0

    def least_m(self, speed_mps: float, step_s: float) -> float:
        """Return the gap to stand with so that `gap_m` is kept at a speed (m/s)."""
        if not self.exact:
            return self.gap_m
        beside_m = speed_mps * step_s + self.longer_braking_s2pm * speed_mps * speed_mps / 2.0
        return max(_LEAST_M, self.gap_m - beside_m)


def kept_gaps(
    spec: ScenarioSpec, seats: Mapping[str, SeatedAgent], types: Mapping[str, AgentTypeRecord]
) -> tuple[KeptGap, ...]:
    """Return the gaps that the request asks to be kept, of vehicles that have a place.

    Args:
        spec: The request.
        seats: Places of the convoy by agent.
        types: Agent sizes.
    """
    found = []
    for agent in spec.agents:
        for placement in agent.placements:
            own, other = seats.get(agent.id), seats.get(placement.of or '')
            if own is None or other is None or not placement.keeps_distance:
                continue
            ahead = placement.relation is Relation.AHEAD
            if ahead or placement.relation is Relation.BEHIND:
                pair = (other, own) if ahead else (own, other)
                exact = placement.distance_m is not None and (
                    placement.distance_m.bound is Bound.EXACTLY
                )
                found.append(replace(_kept_gap(*pair, types), exact=exact))
    for kept in kept_apart(spec, seats):
        back, front = seats[kept.behind], seats[kept.ahead]
        if front.arc_m - back.arc_m >= kept.least_m:
            found.append(_kept_gap(back, front, types))
    for agent in spec.agents:
        for behavior in agent.behaviors:
            own, other = seats.get(agent.id), seats.get(behavior.target or '')
            if behavior.kind is BehaviorKind.FOLLOW and own is not None and other is not None:
                line = _in_line(own, other, seats, types)
                within_m = _within_m(spec, agent.id, other.member.agent.id)
                found += (
                    line if line or within_m is None else [_close(own, other, types, within_m)]
                )
    return tuple(dict.fromkeys(found))


def led(gaps: Iterable[KeptGap]) -> Mapping[str, tuple[str, ...]]:
    """Return who keeps an exact distance behind whom, by the very first one of each line."""
    behind = {gap.follower: gap.leader for gap in gaps if gap.exact}
    found: dict[str, list[str]] = {}
    for follower in behind:
        front, seen = follower, {follower}
        while front in behind and behind[front] not in seen:
            front = behind[front]
            seen.add(front)
        if front not in behind:
            found.setdefault(front, []).append(follower)
    return {front: tuple(followers) for front, followers in found.items()}


def _within_m(spec: ScenarioSpec, follower: str, leader: str) -> float | None:
    """Return how far away a follower is to be at most, None where nothing is stated."""
    stated = [
        c.value.value
        for c in spec.conditions
        if c.quantity in (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE)
        and set(c.of) == {follower, leader}
        and c.op in ('<=', '<')
    ]
    return min(stated, default=None)


def _close(
    own: SeatedAgent, other: SeatedAgent, types: Mapping[str, AgentTypeRecord], within_m: float
) -> KeptGap:
    """Return a gap that keeps a follower inside a bound, wherever it starts."""
    gap = _kept_gap(own, other, types)
    away_m = other.arc_m - own.arc_m
    closer_m = max(0.0, away_m - (within_m - _ROOM_M))
    return replace(gap, gap_m=max(_LEAST_M, gap.gap_m - closer_m))


def _in_line(
    own: SeatedAgent,
    target: SeatedAgent,
    seats: Mapping[str, SeatedAgent],
    types: Mapping[str, AgentTypeRecord],
) -> list[KeptGap]:
    """Return the gaps of those between a follower and its target, so that it stays near enough."""
    between = [
        s
        for s in seats.values()
        if own.arc_m < s.arc_m < target.arc_m and s.member.lane_shift == own.member.lane_shift
    ]
    line = [own, *sorted(between, key=lambda s: s.arc_m), target]
    return [_kept_gap(a, b, types) for a, b in pairwise(line)] if between else []


def _kept_gap(
    follower: SeatedAgent, leader: SeatedAgent, types: Mapping[str, AgentTypeRecord]
) -> KeptGap:
    own, other = (types[s.member.agent.type.value] for s in (follower, leader))
    return KeptGap(
        follower=follower.member.agent.id,
        leader=leader.member.agent.id,
        gap_m=max(0.0, leader.arc_m - follower.arc_m - (own.length_m + other.length_m) / 2.0),
        acceleration_mps2=own.accel_mps2,
        longer_braking_s2pm=1.0 / own.decel_mps2 - 1.0 / max(own.decel_mps2, other.decel_mps2),
    )
