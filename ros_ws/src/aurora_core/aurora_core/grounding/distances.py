# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far apart two vehicles of a convoy start, along the road and in lanes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from aurora_core.grounding.nearby import BY_PERSONS
from aurora_core.grounding.pace import Encounter, encounter_room_m
from aurora_core.knowledge.limits import Tolerance
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import Relation

# Relations that a convoy can hold, as (sign of the offset, lane shift).
ALONG: dict[Relation, tuple[int, int]] = {
    Relation.AHEAD: (1, 0),
    Relation.SAME_LANE: (1, 0),
    Relation.BEHIND: (-1, 0),
    Relation.BEFORE: (-1, 0),
    Relation.ADJACENT_LANE: (0, 1),
    Relation.LEFT: (0, 1),
    Relation.RIGHT: (0, -1),
    Relation.BESIDE: (0, 1),
    Relation.NEAR: (-1, 0),
}

# Gap of an agent that follows without a stated placement (contract default for vehicles).
DEFAULT_GAP_M = 20.0

# Who has somebody so far away in the next lane, bumper to bumper, can change to it (m).
_CLEAR_M = 25.0

# Gap in front of a group of vehicles that nothing relates to those before it.
DETACHED_M = 40.0

# Between two bumpers in one lane there is at least so much at t = 0 (m), and where a stated
# distance leaves less it is aimed at inside this share of its tolerance.
BUMPERS_M = 0.3
_SAFE = 0.8

# Share of a bound on the way that is left for corners and stops, but for two buses' room (m).
_KEPT_ROOM = 0.25
_ROOMY_FROM_M = 14.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Distances:
    """How far apart two vehicles of the convoy start.

    Attributes:
        tolerance: So far inside a one-sided distance they are put.
        meetings: Encounters still to come.
        speeds_mps: Stated ones of agents.
        near: Those near whom another one begins, who that is by its id.
        approaches: Pairs of which one approaches the other.
        oncoming: Ids of those in the other direction.
        persons: Ids.
        parked: Ids of those who stand at the kerb.
        standing: Ids of those who stand all along, wherever.
        lengths_m: Of the vehicles; 0 of whom it does not know.
        changing: Ids of those who are to change lane.
    """

    tolerance: Tolerance
    meetings: tuple[Encounter, ...]
    speeds_mps: Mapping[str, float]
    near: Mapping[str, str]
    approaches: frozenset[frozenset[str]]
    oncoming: frozenset[str]
    persons: frozenset[str]
    parked: frozenset[str]
    standing: frozenset[str]
    lengths_m: Mapping[str, float]
    changing: frozenset[str] = frozenset()

    def lanes_between(self, agent: str, other: str, placement: Placement) -> int:
        """Return how many lanes an agent is to the left of another one by a placement."""
        relation = placement.relation
        shift = ALONG[relation][1]
        at_kerb, other_at_kerb = agent in self.parked, other in self.parked
        if shift == 0 or at_kerb == other_at_kerb:
            return shift
        # One is in the lane, the other at the kerb beside it.
        goes = (Relation.RIGHT if at_kerb else Relation.LEFT, Relation.BESIDE)
        return 0 if relation in goes else shift

    def places_other(self, placement: Placement) -> bool:
        """Tell whether it is the other one who is placed by it."""
        if placement.relation is Relation.ONCOMING:
            return placement.of in self.oncoming
        return placement.of in self.persons and placement.relation in BY_PERSONS

    def placed(self, agent: str, other: str | None, placement: Placement) -> float:
        """Return the distance that a placement asks for, metres.

        A bound that is kept on the way leaves room for corners and stops, too.
        """
        stated = placement.distance_m
        distance_m = self.between(agent, other, stated)
        if stated is None or not placement.keeps_distance:
            return distance_m
        roomy_m = stated.inside(_KEPT_ROOM * stated.value)
        return max(roomy_m, min(distance_m, _ROOMY_FROM_M))

    def clear_m(self, agent: str, other: str, placement: Placement) -> float:
        """Return the distance that a placement asks for of two in one lane, metres.

        Where it is shorter than the two are long, it is what they need, inside its tolerance.
        """
        distance_m, stated = self.placed(agent, other, placement), placement.distance_m
        needed_m = self.needed_m(agent, other)
        if stated is None or distance_m >= needed_m:
            return distance_m
        slack_m = self.tolerance.of(stated.value, approximate=stated.approximate)
        return needed_m if needed_m <= distance_m + _SAFE * slack_m else distance_m

    def needed_m(self, agent: str, other: str) -> float:
        """Return how far apart two have to be to stand in one lane, from middle to middle (m)."""
        if (agent in self.parked) != (other in self.parked):
            return 0.0
        half_m = (self.lengths_m.get(agent, 0.0) + self.lengths_m.get(other, 0.0)) / 2.0
        return half_m + BUMPERS_M

    def before_meeting_m(self, agent: str, other: str) -> float:
        """Return how far ahead of another one an agent starts that meets it, metres.

        Whom the event names first comes from behind, unless it stands; 0 where they do not meet.
        """
        met = next((m for m in self.meetings if {m.actor, m.other} == {agent, other}), None)
        if met is None:
            return 0.0
        waits = met.actor in self.standing and met.other not in self.standing
        comes = met.other if waits else met.actor
        return self.between(agent, other, None) * (-1.0 if agent == comes else 1.0)

    def lane_apart_m(self, agent: str, other: str) -> float:
        """Return how far ahead of another one an agent starts in the lane next to it (m).

        Who is to change lane needs that lane free: then one of them is clear ahead.
        """
        meeting_m = self.before_meeting_m(agent, other)
        if meeting_m or self.changing.isdisjoint((agent, other)):
            return meeting_m
        return self.needed_m(agent, other) + _CLEAR_M

    def between(self, agent: str, other: str | None, stated: Parameter | None) -> float:
        """Return a distance, metres; a free one leaves room for an encounter."""
        if stated is not None and stated.provenance is Provenance.EXPLICIT:
            return stated.inside(self.tolerance.of(stated.value))
        room = [
            m.within_m + encounter_room_m(self.speeds_mps.get(m.actor))
            for m in self.meetings
            if {m.actor, m.other} == {agent, other}
        ]
        # Who approaches has to have room to come nearer.
        room += [DETACHED_M] if {agent, other} in self.approaches else []
        return max([DEFAULT_GAP_M if stated is None else stated.value, *room])
