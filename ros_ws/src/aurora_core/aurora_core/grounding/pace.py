# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How fast a convoy may drive so that what is asked of the UAVs can come true, and who closes in.

Speeds that the prompt does not state are free: a tracked or observed convoy is slowed, and when
two vehicles have to meet, the front one drives slowly enough for the rear one to catch up.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import inf

from aurora_core.grounding.awaited import awaited_at
from aurora_core.grounding.causes import slows_at_sight
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.settings import GroundingSettings, SpeedSettings
from aurora_core.quantities.actions import FROM_MOTION
from aurora_core.spec.doing import dated_s
from aurora_core.spec.events import sets_off
from aurora_core.spec.flight_order import begun_by
from aurora_core.spec.own_events import own_events
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AgentAction,
    DistanceTrigger,
    EventDoneTrigger,
    GroundAgent,
    MissionDoneTrigger,
    ScenarioSpec,
    SpeedTrigger,
    UavMission,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, MissionMode

# A driver who is to see somebody beside a vehicle comes so near at least (m).
_SEEN_WITHIN_M = 30.0

# An observed convoy covers at most this share of the sensing range during a hover.
_OBSERVED_SHARE = 0.5

# Distance beyond the trigger distance at which two that are to meet start: so much, and what a
# stated speed needs to be reached and driven for so long (m, m/s^2, s).
_ROOM_M = 15.0
_GAINS_MPS2 = 1.5
_DRIVES_S = 3.0

# Who slows down to a speed at the sight of somebody drives so much faster before (m/s).
_SLOWS_BY_MPS = 6.0

# Below a bound on the speed of a UAV its target is so much slower, to be caught up with (m/s).
_CAUGHT_UP_MPS = 3.0

_TRACKS = frozenset({MissionMode.TRACK})
_WATCHES = _TRACKS | {MissionMode.HOVER}

# Who does this drives as fast as the one that it does it to.
PACED = frozenset({BehaviorKind.FOLLOW, BehaviorKind.TAILGATE})


@dataclass(frozen=True, slots=True, kw_only=True)
class Encounter:
    """Two vehicles that have to come closer than a trigger distance."""

    actor: str
    other: str
    within_m: float


def encounters(spec: ScenarioSpec) -> tuple[Encounter, ...]:
    """Return the pairs of vehicles that an event waits for to come close.

    Who is to come near a UAV that watches somebody comes near that one.
    """
    vehicles = {a.id for a in spec.agents if a.type is not AgentType.PEDESTRIAN}
    triggers = (e.trigger for e in (*spec.events, *own_events(spec)))
    found = [
        Encounter(actor=_body(spec, t.a), other=_body(spec, t.b), within_m=t.value_m.value)
        for t in triggers
        if isinstance(t, DistanceTrigger) and t.on == 'distance_below'
    ]
    return tuple(
        one for one in found if one.actor != one.other and {one.actor, one.other} <= vehicles
    )


def _body(spec: ScenarioSpec, name: str, modes: frozenset[MissionMode] = _WATCHES) -> str:
    """Return whom a UAV watches that begins so, else the body itself."""
    first = next((m for m in spec.missions if m.uav == name), None)
    return first.target or name if first is not None and first.mode in modes else name


def encounter_room_m(speed_mps: float | None) -> float:
    """Return how much farther apart than a trigger says two start that are to meet, metres.

    Args:
        speed_mps: Stated speed of the one that comes, None where there is none.
    """
    if speed_mps is None:
        return _ROOM_M
    return _ROOM_M + speed_mps * speed_mps / (2.0 * _GAINS_MPS2) + _DRIVES_S * speed_mps


def met_persons(spec: ScenarioSpec) -> tuple[tuple[GroundAgent, str, float], ...]:
    """Return the persons that something is to come near, who that is, and how near (m).

    A driver who is to see somebody comes near, too.
    """
    drivers = {a.id for a in spec.agents if a.type not in (AgentType.PEDESTRIAN, AgentType.RSU)}
    persons = {a.id: a for a in spec.agents if a.type is AgentType.PEDESTRIAN}
    found = []
    for trigger in (e.trigger for e in spec.events):
        if isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_below':
            for own, other in ((trigger.a, trigger.b), (trigger.b, trigger.a)):
                # A UAV that hovers over somebody stays there while that one drives on.
                whom = _body(spec, other, _TRACKS)
                if own in persons and whom != own:
                    found.append((persons[own], whom, trigger.value_m.value))
        elif isinstance(trigger, VisibilityTrigger) and trigger.on == 'visible':
            # Who stands by another vehicle is seen by a driver who comes along there.
            person = persons.get(trigger.target)
            beside = set() if person is None else {p.of for p in person.placements} & drivers
            if person is not None and beside and trigger.observer in drivers:
                found.append((person, trigger.observer, _SEEN_WITHIN_M))
    # Two of them are to come as near as the farthest trigger says.
    return tuple(sorted(found, key=lambda one: -one[2]))


def met_m(spec: ScenarioSpec, person: GroundAgent, vehicle: GroundAgent) -> Iterator[float]:
    """Yield how far ahead of a vehicle a person is that it is to come near, metres."""
    for met, other, within_m in met_persons(spec):
        if met.id == person.id and other == vehicle.id:
            yield within_m + encounter_room_m(own_speed_mps(vehicle))


def partings(spec: ScenarioSpec) -> tuple[frozenset[str], ...]:
    """Return the pairs of vehicles that an event waits for to get far from each other."""
    vehicles = {a.id for a in spec.agents if a.type is not AgentType.PEDESTRIAN}
    return tuple(
        frozenset((t.a, t.b))
        for t in (e.trigger for e in spec.events)
        if isinstance(t, DistanceTrigger)
        and t.on == 'distance_above'
        and t.a in vehicles
        and t.b in vehicles
    )


def approaches(spec: ScenarioSpec) -> tuple[tuple[str, str], ...]:
    """Return which vehicle approaches which other one."""
    vehicles = {a.id: a for a in spec.agents if a.type is not AgentType.PEDESTRIAN}
    return tuple(
        (agent.id, b.target)
        for agent in vehicles.values()
        for b in agent.behaviors
        if b.kind is BehaviorKind.APPROACH and b.target in vehicles and b.target != agent.id
    )


def moves(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Whether the prompt says or implies that an agent moves while it is observed."""
    tied = any(
        any(p.of == agent.id and p.kept_in_motion for p in a.placements)
        or any(b.target == agent.id for b in a.behaviors)
        for a in spec.agents
    )
    acted = any(getattr(e.action, 'agent', None) == agent.id for e in spec.events)
    met = any(agent.id in (m.actor, m.other) for m in encounters(spec))
    met = met or any(agent.id == other for _, other, _ in met_persons(spec))
    awaited = any(one.agent == agent.id for one in awaited_at(spec))
    return bool(agent.behaviors) or tied or acted or met or awaited


def moves_during(spec: ScenarioSpec, agent: GroundAgent, mission: UavMission) -> bool:
    """Whether an agent moves while a UAV is on a mission: not who sets off when that is over."""
    event = sets_off(spec.events, agent.id)
    trigger = None if event is None else event.trigger
    later = isinstance(trigger, MissionDoneTrigger) and trigger.uav == mission.uav
    return moves(spec, agent) and not later


def convoy_pace_mps(spec: ScenarioSpec, limits: Limits, settings: GroundingSettings) -> float:
    """Return the speed at which a tracked or observed convoy drives where the road allows it."""
    pace = settings.target_speed_mps
    range_m = limits.sensing_range(spec.world.weather.value, spec.world.time_of_day.value)
    agents = {a.id: a for a in spec.agents}
    for mission in spec.missions:
        target = agents.get(mission.target or '')
        hovers = mission.mode is MissionMode.HOVER and mission.duration_s is not None
        if hovers and target is not None and moves_during(spec, target, mission):
            assert mission.duration_s is not None
            if mission.duration_s.value <= 0.0:
                continue
            pace = min(pace, _OBSERVED_SHARE * range_m / mission.duration_s.value)
        if target is not None and _is_taken_over(spec, mission):
            pace = min(pace, settings.speeds.taken_over_mps)
        if target is not None and slows_at_sight(spec, target.id, mission.uav):
            # It is caught up with, and faster than it is to be then.
            least = _slowed_to_mps(spec, target.id) + _SLOWS_BY_MPS
            pace = min(pace, max(settings.speeds.taken_over_mps, least))
        if target is not None and mission.mode is MissionMode.TRACK:
            pace = min(pace, _kept_up_with_mps(spec, mission.uav))
    return pace


def _slowed_to_mps(spec: ScenarioSpec, agent: str) -> float:
    """Return the greatest speed that an event tells an agent to have, 0 for none (m/s)."""
    actions = [e.action for e in spec.events if isinstance(e.action, AgentAction)]
    told = (a.value_mps for a in actions if a.agent == agent)
    return max((v.value for v in told if v is not None), default=0.0)


def _kept_up_with_mps(spec: ScenarioSpec, uav: str) -> float:
    """Return how fast a target is that a UAV with a stated bound on its speed keeps up with."""
    bound_mps = least_bound_mps(spec, uav)
    return inf if bound_mps is None else max(bound_mps - _CAUGHT_UP_MPS, bound_mps / 2.0, 0.0)


def least_bound_mps(spec: ScenarioSpec, body: str) -> float | None:
    """Return the least number that the speed of a body is to stay below, None for none."""
    bounds = [
        one.value.value
        for one in spec.conditions
        if one.quantity == QuantityName.SPEED
        and one.of == (body,)
        and one.op in ('<=', '<')
        and one.by_s is None
    ]
    return min(bounds, default=None)


def _is_taken_over(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a UAV is set on a body that another one has tracked on its way until then."""
    others = [m for m in spec.missions if m.target == mission.target and m.uav != mission.uav]
    tracks = [m for m in (mission, *others) if m.mode is MissionMode.TRACK]
    return mission in tracks and len(tracks) > 1 and begun_by(spec, mission) is not None


def in_emergency(agent: GroundAgent) -> bool:
    """Tell whether a vehicle is on an emergency run: no speed limit is for it."""
    return any(b.kind is BehaviorKind.EMERGENCY_RUN for b in agent.behaviors)


def own_speed_mps(agent: GroundAgent) -> float | None:
    """Return the speed that the request states for an agent."""
    # "at least" a number below zero leaves everything open, and standing is the least there is.
    speeds = [
        max(0.0, b.speed_mps.value)
        for b in agent.behaviors
        if b.speed_mps is not None and b.kind is not BehaviorKind.SLOW
    ]
    return speeds[0] if speeds else None


def slows_from_mps(agent: GroundAgent, speeds: SpeedSettings) -> float:
    """Return how fast an agent has to drive for its slowing down to show, 0 where it does not."""
    goals = [
        b.speed_mps.value
        for b in agent.behaviors
        if b.kind is BehaviorKind.SLOW and b.speed_mps is not None
    ]
    return max((goal + speeds.before_slowing_mps for goal in goals), default=0.0)


def stated_speed_mps(
    spec: ScenarioSpec, agent: GroundAgent, settings: SpeedSettings
) -> float | None:
    """Return the stated speed of an agent, else of one that follows it: both drive the same.

    Whose speed an event waits for, as more than a number, drives faster than that.
    """
    followers = [
        own_speed_mps(a)
        for a in spec.agents
        if any(b.kind in PACED and b.target == agent.id for b in a.behaviors)
    ]
    awaited = [
        e.trigger.value_mps.value + settings.above_awaited_mps
        for e in spec.events
        if isinstance(e.trigger, SpeedTrigger)
        and e.trigger.on == 'speed_above'
        and e.trigger.who == agent.id
        and agent.type is not AgentType.PEDESTRIAN
    ]
    gains = _gains_from_mps(spec, agent, settings)
    capped = _capped_mps(spec, agent, settings)
    speeds = (own_speed_mps(agent), *followers, *awaited, gains, capped)
    return next((speed for speed in speeds if speed is not None), None)


def _gains_to_mps(spec: ScenarioSpec, agent: GroundAgent, speeds: SpeedSettings) -> list[float]:
    """Return the speeds that an agent is to accelerate to: without one, by a fair amount."""
    unsaid = (own_speed_mps(agent) or speeds.unsaid_mps) + speeds.before_gain_mps
    return [
        unsaid if e.action.value_mps is None else e.action.value_mps.value
        for e in spec.events
        if isinstance(e.action, AgentAction)
        and (e.action.agent, e.action.do) == (agent.id, 'accelerate')
        and agent.type is not AgentType.PEDESTRIAN
    ]


def _starts_at_mps(spec: ScenarioSpec, agent: GroundAgent) -> Iterator[float]:
    """Yield the speeds that an agent is to set off to."""
    for event in spec.events:
        action = event.action
        if isinstance(action, AgentAction) and (action.agent, action.do) == (agent.id, 'start'):
            yield 0.0 if action.value_mps is None else action.value_mps.value


_SLOWS = frozenset({'brake', 'slow', 'stop', 'yield'})


def _gains_from_mps(spec: ScenarioSpec, agent: GroundAgent, speeds: SpeedSettings) -> float | None:
    """Return how fast an agent drives before it accelerates to a speed, None if it does not.

    Who is to slow down or stop before is slow enough then, and drives as always until that.
    """
    goals = _gains_to_mps(spec, agent, speeds)
    does = [
        e.action.do
        for e in spec.events
        if isinstance(e.action, AgentAction) and e.action.agent == agent.id
    ]
    if not goals or set(does[: does.index('accelerate')]) & _SLOWS:
        return None
    return max(speeds.least_before_gain_mps, min(goals) - speeds.before_gain_mps)


def _capped_mps(spec: ScenarioSpec, agent: GroundAgent, speeds: SpeedSettings) -> float | None:
    """Return how fast an agent drives that is never to be faster than a number, None if free."""
    caps = [
        one.value.value
        for one in spec.conditions
        if one.quantity == QuantityName.SPEED
        and one.op in ('<=', '<')
        and one.by_s is None
        and (agent.id in one.of or agent.group in one.of)
    ]
    if not caps:
        return None
    most_mps = max(0.0, min(caps) - speeds.below_cap_mps)
    return min(most_mps, speeds.trackable_mps) if agent.id in tracked(spec) else most_mps


def tracked(spec: ScenarioSpec) -> frozenset[str | None]:
    """Return whom a UAV has to keep up with."""
    return frozenset(m.target for m in spec.missions if m.mode is MissionMode.TRACK)


def outruns(spec: ScenarioSpec, limit_mps: float, speeds: SpeedSettings) -> bool:
    """Tell whether an emergency run is too fast, where so much is allowed, for who tracks it."""
    return limit_mps + speeds.emergency_over_mps > speeds.trackable_mps and any(
        in_emergency(a) and own_speed_mps(a) is None and a.id in tracked(spec) for a in spec.agents
    )


def fastest_stated_mps(
    spec: ScenarioSpec, agents: Iterable[GroundAgent], speeds: SpeedSettings
) -> float:
    """Return the highest speed that the request states for any of them, 0 where for none.

    Who is on an emergency run does not count.
    """
    bound = (agent for agent in agents if not in_emergency(agent))
    return max(
        (
            max(
                stated_speed_mps(spec, a, speeds) or 0.0,
                slows_from_mps(a, speeds),
                *_gains_to_mps(spec, a, speeds),
                *_starts_at_mps(spec, a),
            )
            for a in bound
        ),
        default=0.0,
    )


def stated_times_s(spec: ScenarioSpec) -> dict[str, float]:
    """Return when events happen at a stated time, or by a chain from one, at the earliest (s)."""
    dated = ((e.id, dated_s(spec, e)) for e in spec.events)
    times_s = {event: at_s for event, at_s in dated if at_s is not None}
    known = -1
    while known != (known := len(times_s)):
        for e in spec.events:
            if isinstance(e.trigger, EventDoneTrigger) and e.trigger.event in times_s:
                after_s = 0.0 if e.trigger.after_s is None else e.trigger.after_s.value
                times_s.setdefault(e.id, times_s[e.trigger.event] + after_s)
    return times_s


def timed_way_m(
    spec: ScenarioSpec, agents: Iterable[GroundAgent], settings: GroundingSettings
) -> float:
    """Return how far agents get until the last of what they do on the move at a stated time.

    "At 45 s it stops": before a red light it would have stood by then, and nothing would change.

    Args:
        spec: The request.
        agents: Who.
        settings: With the speed of whom no speed is stated.
    """
    pace_mps = settings.target_speed_mps
    speeds = {a.id: stated_speed_mps(spec, a, settings.speeds) or pace_mps for a in agents}
    return max(
        (
            at_s * speeds[event.action.agent]
            for event in spec.events
            if (at_s := dated_s(spec, event)) is not None
            and isinstance(event.action, AgentAction)
            and event.action.do in FROM_MOTION
            and event.action.agent in speeds
        ),
        default=0.0,
    )


def watched_speed_mps(
    spec: ScenarioSpec, mission: UavMission, limits: Limits, settings: GroundingSettings
) -> float:
    """Return the speed of a mission's target: what is stated, else the pace of the convoy."""
    target = next((a for a in spec.agents if a.id == mission.target), None)
    stated = None if target is None else stated_speed_mps(spec, target, settings.speeds)
    if stated is None and target is not None and target.type is AgentType.PEDESTRIAN:
        return settings.persons.walking_mps
    return convoy_pace_mps(spec, limits, settings) if stated is None else stated
