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
from aurora_core.spec.scenario import GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Place, Relation, Role

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

# Gap in front of a group of vehicles that nothing relates to those before it.
DETACHED_M = 40.0

_SAME_PLACE_M = 1e-6

# Where a vehicle is anyway, and where it can be put.
_ROADS = (None, Place.MAIN_ROAD)

STILL = frozenset({BehaviorKind.STOP, BehaviorKind.WAIT, BehaviorKind.PARK})


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvoyMember:
    """A vehicle of the convoy: arc offset (m, positive ahead) and lane shift from the origin."""

    agent: GroundAgent
    offset_m: float
    lane_shift: int


@dataclass(frozen=True, slots=True)
class _Tie:
    """`agent` is `offset_m` ahead of `other` along the route, `lane_shift` lanes to its left."""

    agent: str
    other: str
    offset_m: float
    lane_shift: int


@dataclass(frozen=True, slots=True, kw_only=True)
class BeforeIntersection:
    """A member whose place along its route an intersection decides.

    Attributes:
        agent: Id.
        distance_m: Along its route from its reference point to the centre of the intersection.
    """

    agent: str
    distance_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneSplit:
    """Agents by how they are placed.

    Attributes:
        convoy: Vehicles with relations to each other (the origin first).
        free: Vehicles without a relation, placed around.
        persons: Pedestrians.
        unsupported: Placements that grounding cannot realise yet, in words.
        before: The member that is placed before an intersection, None when nobody is.
    """

    convoy: tuple[ConvoyMember, ...]
    free: tuple[GroundAgent, ...]
    persons: tuple[GroundAgent, ...]
    unsupported: tuple[str, ...]
    before: BeforeIntersection | None = None


def split_scene(spec: ScenarioSpec) -> SceneSplit:
    """Sort the agents of a scene into convoy, free vehicles and persons."""
    vehicles = [a for a in spec.agents if a.type not in (AgentType.PEDESTRIAN, AgentType.RSU)]
    persons = tuple(a for a in spec.agents if a.type is AgentType.PEDESTRIAN)
    unsupported = [f'{a.id}: roadside units' for a in spec.agents if a.type is AgentType.RSU]
    by_id = {a.id: a for a in vehicles}
    meetings = encounters(spec)
    ties = [t for a in vehicles for t in _ties(a, by_id, unsupported, meetings)]
    origin = _origin(spec, vehicles, ties)
    if origin is None:
        _, others = _before_intersection(vehicles, {})
        unsupported += [f'{i}: placement before intersection' for i in others]
        return SceneSplit(
            convoy=(), free=tuple(vehicles), persons=persons, unsupported=tuple(unsupported)
        )
    offsets = _solve(origin, ties)
    # Everybody who is watched or related to somebody else has to be on the same road, or no UAV
    # could be planned for it: further groups line up behind.
    targets = {m.target for m in spec.missions}
    tied = {i for t in ties for i in (t.agent, t.other)}
    for agent in vehicles:
        if agent.id in offsets or agent.id not in targets | tied:
            continue
        group = _solve(agent.id, ties)
        front = max(place[0] for place in group.values())
        rear = min(place[0] for place in offsets.values())
        shift_m = rear - DETACHED_M - front
        offsets |= {i: (place[0] + shift_m, place[1]) for i, place in group.items()}
    broken = {t.agent for t in ties if not _kept(t, offsets)}
    unsupported += [
        f'{a.id}: places that contradict each other' for a in vehicles if a.id in broken
    ]
    before, others = _before_intersection(vehicles, offsets)
    unsupported += [f'{i}: placement before intersection' for i in others]
    convoy = tuple(
        ConvoyMember(agent=by_id[i], offset_m=offset, lane_shift=shift)
        for i, (offset, shift) in offsets.items()
    )
    free = tuple(a for a in vehicles if a.id not in offsets)
    return SceneSplit(
        convoy=convoy,
        free=free,
        persons=persons,
        unsupported=tuple(unsupported),
        before=before,
    )


def _is_before_intersection(placement: Placement) -> bool:
    return placement.relation is Relation.BEFORE and placement.of == Place.INTERSECTION


def _before_intersection(
    vehicles: list[GroundAgent], offsets: dict[str, tuple[float, int]]
) -> tuple[BeforeIntersection | None, list[str]]:
    """Return the first member that is placed so, and everybody else who is to be.

    One place on the route fixes the places of all members.
    """
    asked = [(a.id, p) for a in vehicles for p in a.placements if _is_before_intersection(p)]
    for agent, placement in asked:
        if agent in offsets:
            stated = placement.distance_m
            distance_m = DEFAULT_GAP_M if stated is None else stated.value
            held = BeforeIntersection(agent=agent, distance_m=distance_m)
            return held, [i for i, p in asked if p is not placement]
    return None, [i for i, _ in asked]


def can_be_placed(agent: str, placement: Placement, spec: ScenarioSpec) -> bool:
    """Tell whether a placement of a vehicle is realised, once it has found a place at all."""
    if placement.relation is Relation.ON:
        return placement.of in _ROADS
    if _is_before_intersection(placement):
        return f'{agent}: placement before intersection' not in split_scene(spec).unsupported
    persons = (AgentType.PEDESTRIAN, AgentType.RSU)
    vehicles = {a.id for a in spec.agents if a.type not in persons}
    return placement.of in vehicles and placement.relation in ALONG


def _ties(
    agent: GroundAgent,
    by_id: dict[str, GroundAgent],
    unsupported: list[str],
    meetings: tuple[Encounter, ...],
) -> list[_Tie]:
    others: dict[str, list[Placement]] = {}
    for placement in agent.placements:
        if placement.of in by_id and placement.relation in ALONG:
            others.setdefault(str(placement.of), []).append(placement)
        elif _is_before_intersection(placement):
            continue  # nobody else's place follows from it
        elif placement.relation is not Relation.ON or placement.of not in _ROADS:
            where = f' {placement.of}' if placement.of is not None else ''
            unsupported.append(f'{agent.id}: placement {placement.relation.value}{where}')
    if others:
        return [
            tie
            for other, placements in others.items()
            for tie in _placed(agent.id, other, placements, meetings)
        ]
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
            distance = _distance(agent.id, behavior.target, gap, meetings)
            return [_Tie(agent.id, behavior.target, -distance, 0)]
    for meeting in meetings:
        # Nothing says where the actor is: it comes from behind.
        if meeting.actor == agent.id and meeting.other in by_id:
            distance = _distance(agent.id, meeting.other, None, meetings)
            return [_Tie(agent.id, meeting.other, -distance, 0)]
    return []


def _placed(
    agent: str, other: str, placements: list[Placement], meetings: tuple[Encounter, ...]
) -> list[_Tie]:
    """Return the ties of an agent to one other: "ahead of it", "in the lane to its left"."""
    shifts = [ALONG[p.relation][1] for p in placements if ALONG[p.relation][1] != 0]
    shift = shifts[0] if shifts else 0
    along = [p for p in placements if ALONG[p.relation][1] == 0]
    # "In the same lane, 30 m behind it" says the lane once and the place once.
    exact = [p for p in along if p.relation is not Relation.SAME_LANE] or along[:1]
    if not exact:
        return [_Tie(agent, other, 0.0, shift)]
    return [
        _Tie(
            agent,
            other,
            ALONG[p.relation][0] * _distance(agent, other, p.distance_m, meetings),
            shift,
        )
        for p in exact
    ]


def _kept(tie: _Tie, offsets: dict[str, tuple[float, int]]) -> bool:
    own, other = offsets[tie.agent], offsets[tie.other]
    along = own[0] - other[0] - tie.offset_m
    return abs(along) < _SAME_PLACE_M and own[1] - other[1] == tie.lane_shift


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


def _origin(spec: ScenarioSpec, vehicles: list[GroundAgent], ties: list[_Tie]) -> str | None:
    """Choose the origin: ego, else one that others refer to, else a target, else the first."""
    ids = [a.id for a in vehicles]
    ego = [a.id for a in vehicles if a.role is Role.EGO]
    placed, named = {t.agent for t in ties}, {t.other for t in ties}
    referred = [i for i in ids if i in named - placed]
    targets = [m.target for m in spec.missions if m.target in ids]
    foreground = [a.id for a in vehicles if a.role is not Role.BACKGROUND]
    for group in (ego, referred, targets, foreground):
        if group:
            return group[0]
    return None


def _solve(origin: str, ties: list[_Tie]) -> dict[str, tuple[float, int]]:
    """Propagate offsets from the origin along the ties, in both directions."""
    offsets: dict[str, tuple[float, int]] = {origin: (0.0, 0)}
    changed = True
    while changed:
        changed = False
        for tie in sorted(ties, key=lambda t: t.agent):
            if tie.other in offsets and tie.agent not in offsets:
                base = offsets[tie.other]
                offsets[tie.agent] = (base[0] + tie.offset_m, base[1] + tie.lane_shift)
                changed = True
            elif tie.agent in offsets and tie.other not in offsets:
                base = offsets[tie.agent]
                offsets[tie.other] = (base[0] - tie.offset_m, base[1] - tie.lane_shift)
                changed = True
    return offsets
