# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two vehicles on one road: how far one is ahead of the other, and in which lane."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import copysign

from aurora_core.spec.own_events import let_pass, own_events
from aurora_core.spec.scenario import AgentAction, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Place, Relation

# Several beside one vehicle spread along it so far from centre to centre, by who they are (m).
_SPREAD_M = {AgentType.BICYCLE: 3.2, AgentType.MOTORCYCLE: 3.4, AgentType.CAR: 7.0}

# Who is to be as far from a third one as another is, to so much, stands beside that (m).
_SAME_PLACE_M = 2.0

# Two vehicles whose places are nearer than this stand in each other's way, and how far apart they
# line up behind a third one: the last one still has to follow it (m, centre to centre).
_QUEUE_M = 14.0
IN_LINE_M = 15.0


@dataclass(frozen=True, slots=True)
class Tie:
    """`agent` is `offset_m` ahead of `other` along the route, `lane_shift` lanes to its left.

    Nobody says how far that is where it is `free`, nor that at all where it is a `guess`.
    """

    agent: str
    other: str
    offset_m: float
    lane_shift: int
    free: bool = False
    guess: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class BeforePlace:
    """A member whose place along its route an intersection or a crosswalk decides.

    Attributes:
        agent: Id.
        place: What it stands before.
        distance_m: Along its route from its reference point to the middle of that.
    """

    agent: str
    place: Place
    distance_m: float


def agreed(ties: list[Tie]) -> list[Tie]:
    """Return ties without guesses about two of whom something else is said.

    Who comes from behind says on which side of the other one it is, if not how far away: that is
    more than that two are near each other.
    """
    said = {frozenset((t.agent, t.other)) for t in ties if not t.guess}
    taken: set[int] = set()
    for number, tie in sorted(enumerate(ties), key=lambda row: row[1].guess and not row[1].free):
        pair = frozenset((tie.agent, tie.other))
        if not tie.guess or pair not in said:
            taken.add(number)
            said |= {pair}
    return [tie for number, tie in enumerate(ties) if number in taken]


def without_implied(ties: list[Tie]) -> list[Tie]:
    """Return ties without those of free distance that others imply.

    "Three cars in a row behind the ego": who is behind the second car is behind the ego.
    """
    found = list(ties)
    for tie in ties:
        if tie.free and tie.offset_m != 0.0:
            rest = [t for t in found if t is not tie]
            if _leads(tie.agent, tie, rest):
                found = rest
    return found


def _leads(agent: str, tie: Tie, ties: list[Tie]) -> bool:
    """Tell whether ties in the direction and lane of `tie` lead from an agent to its other."""
    reached, left = set[str](), [agent]
    while left:
        here = left.pop()
        for step in ties:
            along = step.lane_shift == tie.lane_shift == 0
            along = along and step.offset_m * tie.offset_m > 0.0 and step.agent == here
            if along and step.other not in reached:
                reached.add(step.other)
                left.append(step.other)
    return tie.other in reached


def passing_pairs(spec: ScenarioSpec) -> frozenset[tuple[str, str]]:
    """Return who is to pass whom; not where somebody says that they share a lane."""
    sharing = {
        frozenset((a.id, str(p.of)))
        for a in spec.agents
        for p in a.placements
        if p.relation is Relation.SAME_LANE
    }
    pairs = (
        (let_pass(spec, event), event.action.agent)
        for event in (*spec.events, *own_events(spec))
        if isinstance(event.action, AgentAction)
    )
    return frozenset((a, b) for a, b in pairs if a is not None and {a, b} not in sharing)


def in_passing_lane(tie: Tie, passing: frozenset[tuple[str, str]]) -> Tie:
    """Return a tie with the one that is to pass in the lane to the left of the other one."""
    if tie.lane_shift != 0:
        return tie
    shift = int((tie.agent, tie.other) in passing) - int((tie.other, tie.agent) in passing)
    return replace(tie, lane_shift=shift)


def queued(ties: list[Tie], doing: Mapping[str, set[BehaviorKind]]) -> list[Tie]:
    """Return ties in which those behind, or ahead of, one other do not stand in one place.

    Who tailgates is next to it, others stand behind, and who overtakes is in the lane to the left.
    """
    found, tied = list(ties), Counter(i for t in ties for i in (t.agent, t.other))
    groups: dict[tuple[str, int, float], list[Tie]] = {}
    for tie in ties:
        if tie.offset_m != 0.0:
            side = copysign(1.0, tie.offset_m)
            groups.setdefault((tie.other, tie.lane_shift, side), []).append(tie)
    for (_, _, side), group in groups.items():
        group.sort(
            key=lambda t: (_rank(doing[t.agent], t.offset_m), abs(t.offset_m), t.free, t.agent)
        )
        last_m, said_m = 0.0, list[float]()
        for tie in group:
            alone, away_m = tie.free and tied[tie.agent] == 1, abs(tie.offset_m)
            if not tie.free:
                # "Two cyclists 10 m ahead" ride abreast.
                abreast = sum(abs(away_m - one) < _SAME_PLACE_M for one in said_m)
                said_m.append(away_m)
                if abreast:
                    shift = (abreast + 1) // 2 * (1 if abreast % 2 else -1)
                    found[found.index(tie)] = replace(tie, lane_shift=tie.lane_shift + shift)
                    continue
            if not alone or away_m >= last_m + _QUEUE_M or last_m == 0.0:
                last_m = max(last_m, away_m)
            elif side < 0.0 and BehaviorKind.OVERTAKE in doing[tie.agent]:
                found[found.index(tie)] = replace(tie, lane_shift=tie.lane_shift + 1)
            else:
                last_m += IN_LINE_M
                found[found.index(tie)] = replace(tie, offset_m=side * last_m)
    return found


def spread(ties: list[Tie], types: Mapping[str, AgentType], beside: frozenset[str]) -> list[Tie]:
    """Return ties in which several beside one other do not stand in one place.

    Args:
        ties: Of the vehicles.
        types: What they are.
        beside: Who may be on either side: two of them are on both.
    """
    found = list(ties)
    groups: dict[tuple[str, int], list[Tie]] = {}
    for tie in ties:
        if tie.offset_m == 0.0 and tie.lane_shift != 0:
            groups.setdefault((tie.other, tie.lane_shift), []).append(tie)
    for group in groups.values():
        if len(group) == 2 and group[1].agent in beside:
            other = replace(group[1], lane_shift=-group[1].lane_shift)
            found[found.index(group[1])] = other
            continue
        step_m = max(_SPREAD_M.get(types[t.agent], _QUEUE_M) for t in group)
        for number, tie in enumerate(group):
            offset_m = step_m * ((len(group) - 1) / 2.0 - number)
            found[found.index(tie)] = replace(tie, offset_m=offset_m)
    return found


def _rank(kinds: set[BehaviorKind], offset_m: float) -> int:
    if offset_m > 0.0:
        return 0
    if BehaviorKind.TAILGATE in kinds:
        return 0
    return 2 if BehaviorKind.OVERTAKE in kinds else 1


def with_room(
    origin: str, ties: list[Tie], needed_m: Callable[[str, str], float] = lambda *_: 0.0
) -> list[Tie]:
    """Return ties in which nobody stands where another one does of whom nothing says where it is.

    Such a one lines up behind, or ahead, until it has room.

    Args:
        origin: Whose place all others follow from.
        ties: Of the vehicles.
        needed_m: How far apart two in one lane have to be, from middle to middle (m).
    """
    found = list(ties)
    tied = Counter(i for t in ties for i in (t.agent, t.other))
    for number, tie in enumerate(ties):
        open_ = tie.guess or (tie.free and tie.offset_m != 0.0)
        if not open_ or tied[tie.agent] > 1 or tie.agent == origin:
            continue
        while _is_taken(tie.agent, solved(origin, found), needed_m):
            step_m = copysign(IN_LINE_M, found[number].offset_m)
            found[number] = replace(tie, offset_m=found[number].offset_m + step_m)
    return found


def _is_taken(
    agent: str,
    places: Mapping[str, tuple[float, int]],
    needed_m: Callable[[str, str], float],
) -> bool:
    own = places.get(agent)
    return own is not None and any(
        other != agent
        and lane == own[1]
        and abs(along_m - own[0]) < max(_SAME_PLACE_M, needed_m(agent, other))
        for other, (along_m, lane) in places.items()
    )


def solved(origin: str, ties: list[Tie]) -> dict[str, tuple[float, int]]:
    """Propagate offsets from the origin along the ties, in both directions.

    What is said of a distance goes first: those that are free bend.
    """
    offsets: dict[str, tuple[float, int]] = {origin: (0.0, 0)}
    said = sorted((t for t in ties if not t.free), key=lambda t: t.agent)
    free = sorted((t for t in ties if t.free), key=lambda t: t.agent)
    while any(_carry(tie, offsets) for tie in said) or any(_carry(tie, offsets) for tie in free):
        pass
    return offsets


def _carry(tie: Tie, offsets: dict[str, tuple[float, int]]) -> bool:
    """Place one of the two of a tie by the other; tell whether that was new."""
    if tie.other in offsets and tie.agent not in offsets:
        base = offsets[tie.other]
        offsets[tie.agent] = (base[0] + tie.offset_m, base[1] + tie.lane_shift)
        return True
    if tie.agent in offsets and tie.other not in offsets:
        base = offsets[tie.agent]
        offsets[tie.other] = (base[0] - tie.offset_m, base[1] - tie.lane_shift)
        return True
    return False
