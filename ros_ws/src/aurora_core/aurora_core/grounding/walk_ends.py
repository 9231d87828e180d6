# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where persons stop at the end of their walks: nobody walks into who has arrived."""

from __future__ import annotations

from aurora_core.grounding.going import heads_for
from aurora_core.grounding.kerb import STEP_M, steps_off_m
from aurora_core.grounding.pace import stated_times_s
from aurora_core.grounding.places import has_point
from aurora_core.grounding.sites import SeatedPerson, Site
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.spec.parking import crosses_rested, stops_for_good, stops_for_s
from aurora_core.spec.scenario import AgentAction, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import MOVING, BehaviorKind, Place

# Who waits stands this far before the end of the sidewalk (m), the next one behind the first.
KERB_M = 0.6
NEXT_M = 1.0
# Round the corner to a crosswalk the next one is so far behind (m).
NEXT_CROSSES_M = 1.6

# Who has crossed walks on this far (m), out of the way of the next one; who is said to walk, too,
# goes so far in all: farther than shows that it does.
_BEYOND_M = 6.0
WALKS_M = 24.0

# Who walks and stops has walked so far (m).
_STOP_AFTER_M = 15.0

# Who walks up to a crosswalk to cross at a stated time is there so long before (s).
_EARLY_S = 2.0


def rests_at(spec: ScenarioSpec, agent: GroundAgent) -> str | None:
    """Return the place that a person walks to and rests at, None without one.

    Who stops because of something does so wherever that comes. Who is only to go there ends there,
    unless he is to walk for some time.
    """
    told = any(
        isinstance(e.action, AgentAction)
        and (e.action.agent, e.action.do) == (agent.id, 'stop')
        and e.trigger is not None
        for e in spec.events
    )
    stops = (b.target for b in agent.behaviors if b.kind is BehaviorKind.STOP)
    rests = next((place for place in stops if has_point(place)), None)
    if told or rests is not None:
        return None if told else rests
    lasts = any(b.duration_s is not None and b.kind in MOVING for b in agent.behaviors)
    return None if lasts else heads_for(agent)


def arrival_m(site: Site, seat: SeatedPerson, goal_m: float, *, crosses: bool) -> float:
    """Return where a walk ends on its last sidewalk (m).

    Args:
        site: With all of its persons.
        seat: Of the one who walks.
        goal_m: Length of the last sidewalk.
        crosses: It crosses a street before.
    """
    group = [w for w in site.walkers if w.path.goal_lane_id == seat.path.goal_lane_id]
    if crosses:
        # The first one stands at the kerb and goes farthest.
        first_m = min(max(_BEYOND_M, _walks_on_m(seat, goal_m)), goal_m / 2.0)
        next_m = min(NEXT_M, (goal_m - KERB_M - first_m) / len(group))
        return first_m + next_m * (len(group) - 1 - group.index(seat))
    ahead = sum(w.arc_m > seat.arc_m for w in group)
    return walk_end_m(goal_m, ahead, len(group))


def _walks_on_m(seat: SeatedPerson, goal_m: float) -> float:
    """Return how far on the last sidewalk one goes who is said to walk, beside crossing (m)."""
    if all(b.kind is not BehaviorKind.WALK for b in seat.agent.behaviors):
        return 0.0
    before_m = seat.path.length_m - goal_m - seat.arc_m
    return WALKS_M - before_m


def walk_end_m(goal_m: float, ahead: int, group: int) -> float:
    """Return where somebody stops on a last sidewalk of a length (m), be it shorter than a step.

    Of the `group` that stops there so many are `ahead`.
    """
    last_m = max(goal_m - KERB_M, goal_m / 2.0)
    return last_m - min(NEXT_M, last_m / group) * ahead


def walks_up_m(spec: ScenarioSpec, agent: GroundAgent, walking_mps: float) -> float:
    """Return how far somebody walks to where he crosses (m), 0 for who stands there.

    "Walks on the sidewalk and crosses at 25 s": until then he walks. Who rests before he crosses
    has walked up to there.
    """
    comes_m = WALKS_M if heads_for(agent) == Place.CROSSWALK else 0.0
    if crosses_rested(spec, agent):
        return WALKS_M
    if all(b.kind is not BehaviorKind.WALK for b in agent.behaviors):
        return comes_m
    times_s = stated_times_s(spec)
    due_s = [
        times_s[e.id] + e.waits_s
        for e in spec.events
        if e.id in times_s
        and isinstance(e.action, AgentAction)
        and (e.action.agent, e.action.do) == (agent.id, 'cross')
    ]
    return walking_mps * max(0.0, min(due_s) - _EARLY_S) if due_s else comes_m


def halt_m(seat: SeatedPerson, network: RoadNetwork) -> float | None:
    """Return where on the way over a crosswalk one waits who walks up to the kerb (m).

    That is right before it gets onto the carriageway. None for who is there from the beginning, or
    crosses where no crosswalk is.
    """
    path = seat.path
    kerb_m = None if path.crossing_id is None else steps_off_m(network, path)
    if kerb_m is None:
        return None
    return kerb_m - STEP_M if kerb_m - STEP_M > seat.arc_m else None


def stopping_m(
    seat: SeatedPerson, halts_m: float | None, ends_m: float
) -> tuple[float | None, float]:
    """Return where on its way a person stands for a while (m; None: nowhere), and where it ends.

    That is the place where it is to rest, else a little way on.

    Args:
        seat: Of the one who walks.
        halts_m: Where it waits anyway.
        ends_m: Where the walk ends of who does not stop.
    """
    if seat.rest_m is not None:
        return seat.rest_m, seat.rest_m if stops_for_good(seat.agent) else ends_m
    stop_m = seat.arc_m + _STOP_AFTER_M
    if stops_for_s(seat.agent) is not None:
        return min(stop_m, seat.path.length_m), ends_m
    return halts_m, min(ends_m, stop_m) if stops_for_good(seat.agent) else ends_m
