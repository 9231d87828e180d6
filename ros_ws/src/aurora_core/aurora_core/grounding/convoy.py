# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Relations between vehicles as offsets along one common route.

All vehicles tied together by placements form a convoy; each gets an arc-length offset of its
reference point from the convoy's origin (positive: ahead) and a lane shift (positive: left).
"""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.grounding.pace import Encounter, encounters
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Relation, Role

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
}

# Gap of an agent that follows without a stated placement (contract default for vehicles).
DEFAULT_GAP_M = 20.0

# Distance beyond the trigger distance at which two vehicles that are to meet start.
ENCOUNTER_ROOM_M = 15.0

STILL = frozenset({BehaviorKind.STOP, BehaviorKind.WAIT, BehaviorKind.PARK})


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvoyMember:
    """A vehicle of the convoy: arc offset (m, positive ahead) and lane shift from the origin."""

    agent: GroundAgent
    offset_m: float
    lane_shift: int


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneSplit:
    """Agents by how they are placed.

    Attributes:
        convoy: Vehicles with relations to each other (the origin first).
        free: Vehicles without a relation, placed around.
        persons: Pedestrians.
        unsupported: Placements that grounding cannot realise yet, in words.
    """

    convoy: tuple[ConvoyMember, ...]
    free: tuple[GroundAgent, ...]
    persons: tuple[GroundAgent, ...]
    unsupported: tuple[str, ...]


def split_scene(spec: ScenarioSpec) -> SceneSplit:
    """Sort the agents of a scene into convoy, free vehicles and persons."""
    vehicles = [a for a in spec.agents if a.type not in (AgentType.PEDESTRIAN, AgentType.RSU)]
    persons = tuple(a for a in spec.agents if a.type is AgentType.PEDESTRIAN)
    unsupported = [f'{a.id}: roadside units' for a in spec.agents if a.type is AgentType.RSU]
    ties: dict[str, tuple[str, float, int]] = {}
    by_id = {a.id: a for a in vehicles}
    meetings = encounters(spec)
    for agent in vehicles:
        tie = _tie(agent, by_id, unsupported, meetings)
        if tie is not None:
            ties[agent.id] = tie
    origin = _origin(spec, vehicles, ties)
    if origin is None:
        return SceneSplit(
            convoy=(), free=tuple(vehicles), persons=persons, unsupported=tuple(unsupported)
        )
    offsets = _solve(origin, ties)
    convoy = tuple(
        ConvoyMember(agent=by_id[i], offset_m=offset, lane_shift=shift)
        for i, (offset, shift) in offsets.items()
    )
    free = tuple(a for a in vehicles if a.id not in offsets)
    unsupported += [f'{a.id}: a second group of related vehicles' for a in free if a.id in ties]
    return SceneSplit(convoy=convoy, free=free, persons=persons, unsupported=tuple(unsupported))


def _tie(
    agent: GroundAgent,
    by_id: dict[str, GroundAgent],
    unsupported: list[str],
    meetings: tuple[Encounter, ...],
) -> tuple[str, float, int] | None:
    for placement in agent.placements:
        if placement.of in by_id and placement.relation in ALONG:
            sign, shift = ALONG[placement.relation]
            assert placement.of is not None
            distance = _distance(agent.id, placement.of, placement.distance_m, meetings)
            return placement.of, sign * distance, shift
        where = f' {placement.of}' if placement.of is not None else ''
        if placement.relation is not Relation.ON:
            unsupported.append(f'{agent.id}: placement {placement.relation.value}{where}')
    for behavior in agent.behaviors:
        chases = behavior.kind in (
            BehaviorKind.FOLLOW,
            BehaviorKind.TAILGATE,
            BehaviorKind.APPROACH,
            BehaviorKind.OVERTAKE,
        )
        if chases and behavior.target in by_id:
            gap = behavior.closing_from_m
            assert behavior.target is not None
            return behavior.target, -_distance(agent.id, behavior.target, gap, meetings), 0
    for meeting in meetings:
        # Nothing says where the actor is: it comes from behind.
        if meeting.actor == agent.id and meeting.other in by_id:
            return meeting.other, -_distance(agent.id, meeting.other, None, meetings), 0
    return None


def _distance(
    agent: str, other: str | None, stated: Parameter | None, meetings: tuple[Encounter, ...]
) -> float:
    """Return the distance of a tie; a free one leaves room for an encounter still to come."""
    if stated is not None and stated.provenance is Provenance.EXPLICIT:
        return stated.value
    room = [
        m.within_m + ENCOUNTER_ROOM_M for m in meetings if {m.actor, m.other} == {agent, other}
    ]
    return max([DEFAULT_GAP_M if stated is None else stated.value, *room])


def _origin(
    spec: ScenarioSpec, vehicles: list[GroundAgent], ties: dict[str, tuple[str, float, int]]
) -> str | None:
    """Choose the origin: ego, else one that others refer to, else a target, else the first."""
    ids = [a.id for a in vehicles]
    ego = [a.id for a in vehicles if a.role is Role.EGO]
    referred = [i for i in ids if i not in ties and any(t[0] == i for t in ties.values())]
    targets = [m.target for m in spec.missions if m.target in ids]
    foreground = [a.id for a in vehicles if a.role is not Role.BACKGROUND]
    for group in (ego, referred, targets, foreground):
        if group:
            return group[0]
    return None


def _solve(origin: str, ties: dict[str, tuple[str, float, int]]) -> dict[str, tuple[float, int]]:
    """Propagate offsets from the origin along the ties, in both directions."""
    offsets: dict[str, tuple[float, int]] = {origin: (0.0, 0)}
    changed = True
    while changed:
        changed = False
        for agent, (other, offset, shift) in sorted(ties.items()):
            if other in offsets and agent not in offsets:
                base = offsets[other]
                offsets[agent] = (base[0] + offset, base[1] + shift)
                changed = True
            elif agent in offsets and other not in offsets:
                base = offsets[agent]
                offsets[other] = (base[0] - offset, base[1] - shift)
                changed = True
    return offsets
