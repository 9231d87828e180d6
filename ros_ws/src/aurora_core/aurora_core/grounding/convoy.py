# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Relations between vehicles as offsets along one common route.

All vehicles tied together by placements form a convoy; each gets an arc-length offset of its
reference point from the convoy's origin (positive: ahead) and a lane shift (positive: left).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from aurora_core.grounding.awaited import bound_to_places, near_its_partner
from aurora_core.grounding.distances import ALONG, DETACHED_M, Distances
from aurora_core.grounding.kept_apart import ties_apart
from aurora_core.grounding.nearby import BY_PERSONS, ON_SIDEWALKS, begins_near, reported
from aurora_core.grounding.one_place import common_places, is_before_place
from aurora_core.grounding.pace import (
    approaches,
    encounter_room_m,
    encounters,
    met_persons,
    moves,
    own_speed_mps,
)
from aurora_core.grounding.places import has_point
from aurora_core.grounding.ties import (
    IN_LINE_M,
    BeforePlace,
    Tie,
    agreed,
    in_passing_lane,
    passing_pairs,
    queued,
    solved,
    spread,
    with_room,
    without_implied,
)
from aurora_core.knowledge.agent_types import AgentTypeRecord
from aurora_core.knowledge.limits import EXACT, Tolerance
from aurora_core.spec.events import sets_off
from aurora_core.spec.own_events import let_cross, told_to_change_lane
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.parking import parks, stands
from aurora_core.spec.scenario import (
    Behavior,
    GroundAgent,
    Placement,
    ScenarioSpec,
    SendMessage,
)
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Place, Relation, Role

# What is said of a second one who is to stand before such a place.
BEFORE = 'placement before a place'

_SAME_PLACE_M = 1e-6

# Two who stand before one place are so far apart as that says, to so much (m).
_EXACT_M = 0.1

# Where a vehicle is anyway, at the right kerb, and where it can be put.
_ROADS = (None, Place.MAIN_ROAD, Place.ROADSIDE)

# Where a vehicle can be put at a place with a point; no distance is stated but with `near`.
_AT = (Relation.NEAR, Relation.AT, Relation.BESIDE, Relation.PARKED_AT)

_ON = (Relation.ON, Relation.AT, Relation.PARKED_AT)

# On which side of another vehicle one is.
SIDES = frozenset({Relation.LEFT, Relation.RIGHT})

# Who does one of these comes from behind.
_CHASES = frozenset(
    {BehaviorKind.FOLLOW, BehaviorKind.TAILGATE, BehaviorKind.APPROACH, BehaviorKind.OVERTAKE}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvoyMember:
    """A vehicle of the convoy.

    Attributes:
        agent: Who it is.
        offset_m: From the origin, positive ahead.
        lane_shift: Lanes to the left of the origin.
        parked: It stands at the kerb, right of its lane.
        bike_lane: It rides in the bicycle lane at the right of the street.
    """

    agent: GroundAgent
    offset_m: float
    lane_shift: int
    parked: bool = False
    bike_lane: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneSplit:
    """Agents by how they are placed.

    Attributes:
        convoy: Vehicles with relations to each other (the origin first).
        free: Vehicles without a relation, placed around.
        persons: Pedestrians.
        oncoming: Vehicles in the other direction of a member's street.
        unsupported: Placements that grounding cannot realise yet, in words.
        before: The member that is placed before such a place, None when nobody is.
        groups: Vehicles at places of their own, on roads of their own.
        groups_before: Of each group the member that is placed before such a place, or None.
        anywhere: Who crosses and names no crosswalk goes straight over the street.
    """

    convoy: tuple[ConvoyMember, ...]
    free: tuple[GroundAgent, ...]
    persons: tuple[GroundAgent, ...]
    unsupported: tuple[str, ...]
    oncoming: tuple[GroundAgent, ...] = ()
    before: BeforePlace | None = None
    groups: tuple[tuple[ConvoyMember, ...], ...] = ()
    groups_before: tuple[BeforePlace | None, ...] = ()
    anywhere: bool = False


def split_scene(
    spec: ScenarioSpec,
    tolerance: Tolerance = EXACT,
    types: Mapping[str, AgentTypeRecord] | None = None,
    *,
    apart: bool = False,
    bike_lanes: bool = False,
) -> SceneSplit:
    """Sort the agents of a scene into convoy, free vehicles and persons.

    Args:
        spec: The request.
        tolerance: Of placement distances: so far inside a one-sided one everybody is put.
        types: Agent sizes; without them nobody needs room.
        apart: Who is bound to a place and related to nobody in the convoy has a road of its own.
            Else the convoy's is tried for all: there they are near each other.
        bike_lanes: Bicycles ride in lanes of their own, where no lane is for all.
    """
    driving = [a for a in spec.agents if a.type not in ON_SIDEWALKS]
    ids = {a.id for a in driving}
    meets = {a.id: p.of for a in driving if (p := oncoming_to(a)) is not None and p.of in ids}
    # Where all are so to each other the first one is met, or who is watched.
    watched = {m.target for m in spec.missions}
    met = sorted(meets, key=lambda i: i not in watched)[:1] if meets.keys() == ids else []
    oncoming = tuple(a for a in driving if a.id in meets and a.id not in met)
    vehicles = [a for a in driving if a not in oncoming]
    # A roadside unit stands on the sidewalk as a person does who waits.
    persons = tuple(near_its_partner(spec, a) for a in spec.agents if a.type in ON_SIDEWALKS)
    unsupported: list[str] = []
    by_id = {a.id: a for a in vehicles}
    speeds = {a.id: v for a in spec.agents if (v := own_speed_mps(a)) is not None}
    parked = {a.id for a in vehicles if parks(spec, a)}
    distances = Distances(
        tolerance=tolerance,
        meetings=encounters(spec),
        speeds_mps=speeds,
        near=begins_near(spec),
        approaches=frozenset(map(frozenset, approaches(spec))),
        oncoming=frozenset(a.id for a in oncoming),
        persons=frozenset(a.id for a in persons),
        parked=frozenset(parked),
        standing=frozenset(a.id for a in vehicles if a.id in parked or stands(a)),
        lengths_m={a.id: types[a.type.value].length_m for a in vehicles} if types else {},
        changing=told_to_change_lane(spec),
    )
    passing = passing_pairs(spec)
    ties = [
        in_passing_lane(t, passing)
        for a in vehicles
        for t in _ties(a, by_id, unsupported, distances)
    ]
    if apart:
        # "From the left" to a place is another street, not the lane beside.
        ties = [t for t in ties if not _comes_from_a_side(spec, by_id[t.agent], t)]
    ties += [] if apart else common_places(vehicles, distances)
    ties = agreed(ties + ties_apart(spec, by_id) + _past_persons(spec, by_id, ties, speeds))
    ties = queued(without_implied(ties), {a.id: {b.kind for b in a.behaviors} for a in vehicles})
    ties = spread(ties, {a.id: a.type for a in vehicles}, _on_either_side(vehicles))
    origin = _origin(spec, vehicles, ties)
    ties = ties if origin is None else with_room(origin, ties, distances.needed_m)
    if origin is None:
        _, others = _before_place(vehicles, {}, distances)
        unsupported += [f'{i}: {BEFORE}' for i in others]
        return SceneSplit(
            convoy=(), free=tuple(vehicles), persons=persons, oncoming=oncoming,
            unsupported=tuple(unsupported),
        )  # fmt: skip
    offsets = solved(origin, ties)
    # Who is watched or related to somebody else has to be on the same road: groups line up behind.
    targets = {m.target for m in spec.missions}
    targets |= {a.id for a in vehicles if bound_to_places(spec, a)}
    targets |= {vehicle for vehicle, _ in let_cross(spec)}
    targets |= {a.id for a in vehicles if any(map(is_before_place, a.placements))}
    targets |= {p.of for person in persons for p in person.placements}
    targets |= {a.id for a in vehicles for p in a.placements if p.of in distances.persons}
    targets |= reported(spec)
    if targets & set(by_id):
        # A message has a range: who is to receive one is near those who are watched.
        targets |= {e.action.receiver for e in spec.events if isinstance(e.action, SendMessage)}
    tied = {i for t in ties for i in (t.agent, t.other)}
    groups: list[tuple[ConvoyMember, ...]] = []

    def member(name: str, offset_m: float, shift: int) -> ConvoyMember:
        rides = bike_lanes and _rides_beside(by_id[name])
        return ConvoyMember(
            agent=by_id[name],
            offset_m=offset_m,
            lane_shift=0 if rides else shift,
            parked=name in distances.parked,
            bike_lane=rides,
        )

    for agent in vehicles:
        alone = {m.agent.id for members in groups for m in members}
        if agent.id in offsets.keys() | alone or agent.id not in targets | tied:
            continue
        group = solved(agent.id, ties)
        if apart and any(bound_to_places(spec, by_id[i]) for i in group):
            groups.append(tuple(member(i, o, s) for i, (o, s) in group.items()))
            continue
        shift_m = _behind_m(group, offsets)
        # Nobody drives who stands in somebody's way: who is only told something stays where it
        # is, and who stands, all along or until an event, is behind those who do not.
        awaited = any(bound_to_places(spec, by_id[i]) for i in group)
        idle = awaited and not any(moves(spec, by_id[i]) for i in offsets)
        # Who is told by a UAV waits until that has landed: longer than who sets off by an event.
        waits = all(_only_told(spec, by_id[i]) for i in group) and any(
            sets_off(spec.events, i) is not None for i in offsets
        )
        if not _stand(spec, group, by_id) and (idle or _stand(spec, offsets, by_id)):
            shift_m = shift_m if waits else -_behind_m(offsets, group)
        offsets |= {i: (place[0] + shift_m, place[1]) for i, place in group.items()}
    places = offsets | {
        m.agent.id: (m.offset_m, m.lane_shift) for members in groups for m in members
    }
    broken = {t.agent for t in ties if not _kept(t, places)}
    unsupported += [
        f'{a.id}: places that contradict each other' for a in vehicles if a.id in broken
    ]
    before, others = _before_place(vehicles, offsets, distances)
    own = [{m.agent.id: (m.offset_m, m.lane_shift) for m in members} for members in groups]
    befores = [_before_place(vehicles, group, distances) for group in own]
    placed = {i for (_, left), group in zip(befores, own, strict=True) for i in {*group} - {*left}}
    unsupported += [f'{i}: {BEFORE}' for i in others if i not in placed]
    convoy = tuple(member(i, offset, shift) for i, (offset, shift) in offsets.items())
    free = tuple(a for a in vehicles if a.id not in places)
    return SceneSplit(
        groups=tuple(groups),
        groups_before=tuple(held for held, _ in befores),
        convoy=convoy,
        free=free,
        persons=persons,
        oncoming=oncoming,
        unsupported=tuple(unsupported),
        before=before,
    )


def _rides_beside(agent: GroundAgent) -> bool:
    """Tell whether a bicycle lane, right of the others, is where a vehicle may be."""
    elsewhere = (Relation.SAME_LANE, Relation.LEFT)
    return (
        agent.type is AgentType.BICYCLE
        and not any(p.relation in elsewhere for p in agent.placements)
        and all(b.kind is not BehaviorKind.PARK for b in agent.behaviors)
    )


def _on_either_side(vehicles: Iterable[GroundAgent]) -> frozenset[str]:
    """Return who is beside another one, on whichever side."""
    return frozenset(
        a.id for a in vehicles if any(p.relation is Relation.BESIDE for p in a.placements)
    )


def _behind_m(
    group: Mapping[str, tuple[float, int]], others: Mapping[str, tuple[float, int]]
) -> float:
    """Return by how much a group is moved to line up behind others (m, negative)."""
    front = max(place[0] for place in group.values())
    return min(place[0] for place in others.values()) - DETACHED_M - front


def _stand(spec: ScenarioSpec, ids: Iterable[str], by_id: Mapping[str, GroundAgent]) -> bool:
    return all(stands(by_id[i]) or sets_off(spec.events, i) is not None for i in ids)


def _only_told(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether of a vehicle nothing is said but that a UAV tells it something."""
    uavs = {uav.id for uav in spec.uavs}
    sent = [e.action for e in spec.events if isinstance(e.action, SendMessage)]
    told = any(m.receiver == agent.id and m.sender in uavs for m in sent)
    return told and not agent.behaviors and sets_off(spec.events, agent.id) is None


def oncoming_to(agent: GroundAgent) -> Placement | None:
    """Return the placement that puts an agent into the other direction, None if there is none."""
    return next((p for p in agent.placements if p.relation is Relation.ONCOMING), None)


def _is_at_place(placement: Placement) -> bool:
    return placement.relation in _AT and has_point(placement.of)


def _before_place(
    vehicles: list[GroundAgent], offsets: dict[str, tuple[float, int]], distances: Distances
) -> tuple[BeforePlace | None, list[str]]:
    """Return the first member that is placed so, and who else is to be and is not by that.

    One place on the route fixes the places of all members.
    """
    asked = [(a.id, p) for a in vehicles for p in a.placements if is_before_place(p)]
    for agent, placement in asked:
        if agent in offsets:
            distance_m = distances.placed(agent, None, placement)
            held = BeforePlace(agent=agent, place=Place(str(placement.of)), distance_m=distance_m)
            return held, [
                other
                for other, p in asked
                if p is not placement and not _is_so_before(other, p, held, offsets, distances)
            ]
    return None, [i for i, _ in asked]


def _is_so_before(
    agent: str,
    placement: Placement,
    held: BeforePlace,
    offsets: Mapping[str, tuple[float, int]],
    distances: Distances,
) -> bool:
    """Tell whether somebody stands as far before a place as asked, where another one does."""
    if agent not in offsets or placement.of != held.place:
        return False
    along_m = offsets[agent][0] - offsets[held.agent][0]
    if not is_stated(placement.distance_m):
        return along_m < held.distance_m
    asked_m = held.distance_m - distances.placed(agent, None, placement)
    return abs(along_m - asked_m) < _EXACT_M


def can_be_placed(agent: str, placement: Placement, spec: ScenarioSpec) -> bool:
    """Tell whether a placement of a vehicle is realised, once it has found a place at all."""
    if placement.relation in _ON and placement.of in _ROADS:
        return True
    if _is_at_place(placement):
        return True
    if is_before_place(placement):
        splits = (split_scene(spec, apart=apart) for apart in (False, True))
        return any(f'{agent}: {BEFORE}' not in split.unsupported for split in splits)
    vehicles = {a.id for a in spec.agents if a.type not in ON_SIDEWALKS}
    known = placement.relation in ALONG or placement.relation is Relation.ONCOMING
    if placement.of in {a.id for a in spec.agents} - vehicles:
        return placement.relation in BY_PERSONS
    return placement.of in vehicles and known


def _ties(
    agent: GroundAgent,
    by_id: dict[str, GroundAgent],
    unsupported: list[str],
    distances: Distances,
) -> list[Tie]:
    others: dict[str, list[Placement]] = {}
    for placement in agent.placements:
        if placement.of in by_id and placement.relation in ALONG:
            others.setdefault(str(placement.of), []).append(placement)
        elif is_before_place(placement) or _is_at_place(placement):
            continue  # nobody else's place follows from it
        elif distances.places_other(placement):
            continue
        elif placement.relation not in _ON or placement.of not in _ROADS:
            where = f' {placement.of}' if placement.of is not None else ''
            unsupported.append(f'{agent.id}: placement {placement.relation.value}{where}')
    if others:
        return [
            tie
            for other, placements in others.items()
            for tie in _placed(agent.id, other, placements, distances)
        ]
    chased = [b for b in agent.behaviors if b.kind in _CHASES and b.target in by_id]
    passed = [b for b in chased if b.kind is BehaviorKind.OVERTAKE]
    # Of several that are overtaken, one drives ahead of the other.
    return (
        _chasing(agent.id, passed if len(passed) > 1 else chased[:1], distances)
        or [
            Tie(
                agent.id,
                meeting.other,
                distances.before_meeting_m(agent.id, meeting.other),
                0,
                guess=True,
            )
            for meeting in distances.meetings
            # Nothing says where the actor is.
            if meeting.actor == agent.id and meeting.other in by_id
        ][:1]
        or [
            Tie(agent.id, other, -distances.between(agent.id, other, None), 0, guess=True)
            for other in distances.near
            if agent.id == distances.near[other] and other in by_id
        ][:1]
    )


def _chasing(agent: str, behaviors: Sequence[Behavior], distances: Distances) -> list[Tie]:
    """Return the ties of an agent to those ahead of it that it does something to."""
    ties: list[Tie] = []
    for number, behavior in enumerate(behaviors):
        assert behavior.target is not None
        gap = behavior.closing_from_m
        distance_m = distances.between(agent, behavior.target, gap) + IN_LINE_M * number
        # Whom it is to come near first may start farther away than the one after that.
        distance_m = max([distance_m, *(IN_LINE_M - tie.offset_m for tie in ties)])
        told = gap is not None
        ties.append(Tie(agent, behavior.target, -distance_m, 0, free=not told, guess=not told))
    return ties


def _comes_from_a_side(spec: ScenarioSpec, agent: GroundAgent, tie: Tie) -> bool:
    """Tell whether a tie says only from which side somebody comes who goes to a place."""
    sides = {p.relation for p in agent.placements if p.of == tie.other}
    return bool(sides) and sides <= SIDES and bound_to_places(spec, agent)


def _past_persons(
    spec: ScenarioSpec, by_id: Mapping[str, GroundAgent], ties: list[Tie], speeds: dict[str, float]
) -> list[Tie]:
    """Return the ties of vehicles beside which persons stand whom another vehicle comes near."""
    tied = {frozenset((t.agent, t.other)) for t in ties}
    found = []
    for person, vehicle, within_m in met_persons(spec):
        for placement in person.placements:
            beside = placement.of
            pair = frozenset((vehicle, str(beside)))
            if beside in by_id and vehicle in by_id and len(pair) == 2 and pair not in tied:
                tied.add(pair)
                away_m = within_m + encounter_room_m(speeds.get(vehicle))
                found.append(Tie(str(beside), vehicle, away_m, 0, guess=True))
    return found


def _placed(
    agent: str, other: str, placements: list[Placement], distances: Distances
) -> list[Tie]:
    """Return the ties of an agent to one other: "ahead of it", "in the lane to its left"."""
    shifts = [distances.lanes_between(agent, other, p) for p in placements]
    shift = next((one for one in shifts if one != 0), 0)
    along = [p for p in placements if ALONG[p.relation][1] == 0]
    # "In the same lane, 30 m behind it" says the lane once and the place once.
    exact = [p for p in along if p.relation is not Relation.SAME_LANE] or along[:1]
    if not exact:
        # Lanes are told, and not how far along them: who meets, or changes lane, starts apart.
        lanes = all(p.relation is Relation.ADJACENT_LANE for p in placements)
        apart_m = distances.lane_apart_m(agent, other) if lanes else 0.0
        return [Tie(agent, other, apart_m, shift)]
    return [
        Tie(
            agent,
            other,
            ALONG[p.relation][0]
            * (distances.placed if shift else distances.clear_m)(agent, other, p),
            shift,
            free=p.distance_m is None or p.distance_m.provenance is Provenance.DEFAULT,
        )
        for p in exact
    ]


def _kept(tie: Tie, offsets: dict[str, tuple[float, int]]) -> bool:
    own, other = offsets[tie.agent], offsets[tie.other]
    along_m = own[0] - other[0]
    exact = abs(along_m - tie.offset_m) < _SAME_PLACE_M
    # Nobody says how far: it is enough that there is room on the right side.
    roomy = tie.free and along_m * tie.offset_m > 0.0 and abs(along_m) >= IN_LINE_M
    return (exact or roomy) and own[1] - other[1] == tie.lane_shift


def _origin(spec: ScenarioSpec, vehicles: list[GroundAgent], ties: list[Tie]) -> str | None:
    """Choose the origin: ego, else one that others refer to, else a target, else the first."""
    ids = [a.id for a in vehicles]
    ego = [a.id for a in vehicles if a.role is Role.EGO]
    placed, named = {t.agent for t in ties}, {t.other for t in ties}
    referred = [i for i in ids if i in named - placed]
    targets = [m.target for m in spec.missions if m.target in ids]
    placed_there = [a.id for a in vehicles if bound_to_places(spec, a)]
    foreground = [a.id for a in vehicles if a.role is not Role.BACKGROUND]
    for group in (ego, referred, targets, placed_there, foreground):
        if group:
            return group[0]
    return None
