# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When vehicles may set off: with the run, or once the UAV that watches them is ready."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from aurora_core.grounding.awaited import awaited_at, is_kept_away, leaving
from aurora_core.grounding.causes import causes, slows_at_sight
from aurora_core.grounding.convoy import SceneSplit
from aurora_core.grounding.pace import encounters, moves, stated_times_s
from aurora_core.grounding.watched import asked_to_see, looks
from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.events import bodies_of, bodies_of_cause, sets_off
from aurora_core.spec.flight_order import begun_by, counts_from_capture, left_by
from aurora_core.spec.own_events import YIELDS_WITHIN_M, let_cross
from aurora_core.spec.parking import crosses_rested, stands, stands_first_s
from aurora_core.spec.scenario import (
    AgentAction,
    ArrivalTrigger,
    DistanceTrigger,
    Event,
    GroundAgent,
    Link,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    SpeedTrigger,
    UavAction,
    UavMission,
)
from aurora_core.spec.vocabulary import MissionMode

# A UAV climbs so fast at least (m/s), and is then where it should be within so much time (s),
# with what its target needs to be on the move.
_CLIMBS_MPS = 2.5
_THERE_S = 25.0
# Who is to look at something for some time does so longer (s).
_LOOKED_S = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Release:
    """When the convoy may start, and whose doing that is."""

    on: ReleaseOn = ReleaseOn.START
    uav: str = ''
    mission: str = ''
    agent: str = ''
    within_m: float = 0.0
    beyond_m: float = 0.0
    after_s: float = 0.0


def own_release(spec: ScenarioSpec, agent: GroundAgent, release: Release) -> Release:
    """Return when an agent may start: whoever an event lets set off waits for it.

    Of whom nothing is said but that a UAV tells it something stays within reach until that has
    landed. Of whom nothing is said but that it sees somebody, or a place, for some time drives off
    when it has.
    """
    if sets_off(spec.events, agent.id) is not None:
        return Release(on=ReleaseOn.EVENT)
    if release == Release() and any(vehicle == agent.id for vehicle, _ in let_cross(spec)):
        return _watched(spec, '')
    watched = release.on is ReleaseOn.OBSERVED and bool(release.mission)
    if watched and agent.behaviors and not stands(agent):
        return _ready_to_be_passed(spec, agent, release)
    if release.on is ReleaseOn.CAPTURED and slows_at_sight(spec, agent.id, release.uav):
        return Release()  # it is to be on the move by then, and is caught up with
    if release == Release() and (route := _reported_route(spec, agent)) is not None:
        # Nor does it leave before: at the end of the route it is to be in reach.
        return Release(on=ReleaseOn.CAPTURED, uav=route.uav, mission=route.id)
    looks_s = max((s for who, _, s in looks(spec) if who == agent.id), default=0.0)
    if release == Release() and looks_s > 0.0:
        return Release(on=ReleaseOn.WAITED, after_s=looks_s + _LOOKED_S)
    teller = _told_by(spec, agent)
    return release if teller is None else Release(on=ReleaseOn.OBSERVED, uav=teller)


def _reported_route(spec: ScenarioSpec, agent: GroundAgent) -> UavMission | None:
    """Return the route at whose end its UAV tells somebody so, None where none does."""
    routes = [m for m in spec.missions if m.mode is MissionMode.NAVIGATE]
    for event in spec.events:
        action, trigger = event.action, event.trigger
        if not isinstance(action, SendMessage) or action.receiver != agent.id:
            continue
        if isinstance(trigger, MissionDoneTrigger) and trigger.uav == action.sender:
            return next((m for m in routes if m.uav == action.sender), None)
    return None


def person_release(spec: ScenarioSpec, agent: GroundAgent) -> Release:
    """Return when a person may go, and whose doing that is.

    Who is watched goes once the UAV that watches is ready: also who crosses where one hovers. Who
    is let pass goes when the vehicle that does so comes near, unless that waits for the person.
    Who waits for a stated time is released by nothing else; who rests before it crosses walks up
    to there first.
    """
    if stands_first_s(agent) is not None:
        return Release(on=ReleaseOn.NEVER)
    rested = crosses_rested(spec, agent)
    caused = not rested and any(
        isinstance(e.action, AgentAction) and e.action.agent == agent.id and e.action.do == 'cross'
        for e in spec.events
    )
    if caused or sets_off(spec.events, agent.id) is not None:
        return Release(on=ReleaseOn.EVENT)
    for vehicle, person in let_cross(spec):
        if person == agent.id and not rested and not any(t.who == person for t in _arriving(spec)):
            within_m = _yields_within_m(spec, vehicle, person)
            return Release(on=ReleaseOn.NEARED, agent=vehicle, within_m=within_m)
    release = _watched(spec, agent.id)
    if _told_in_time(spec, agent.id) or slows_at_sight(spec, agent.id, release.uav):
        return Release()
    return release


def _told_in_time(spec: ScenarioSpec, name: str) -> bool:
    """Tell whether something happens to somebody at a stated time, or by a chain from one."""
    timed = stated_times_s(spec)
    messages = [e.action for e in spec.events if e.id in timed]
    heard = {m.receiver for m in messages if isinstance(m, SendMessage)}
    acts = [e for e in spec.events if getattr(e.action, 'agent', None) == name]
    return any(e.id in timed for e in acts) or (name in heard and bool(acts))


def _watched(spec: ScenarioSpec, agent: str) -> Release:
    """Return the release by the UAV that watches an agent, else by one that stays anywhere."""
    holding = [m for m in spec.missions if m.mode is not MissionMode.NAVIGATE]
    watching = [m for m in holding if m.target == agent] or holding
    if watching:
        return Release(on=ReleaseOn.CAPTURED, uav=watching[0].uav, mission=watching[0].id)
    return Release()


def _arriving(spec: ScenarioSpec) -> list[ArrivalTrigger]:
    triggers = (e.trigger for e in spec.events)
    return [t for t in triggers if isinstance(t, ArrivalTrigger)]


def _yields_within_m(spec: ScenarioSpec, vehicle: str, person: str) -> float:
    """Return how near a vehicle comes before it lets a person cross, metres."""
    near = [
        e.trigger.value_m.value
        for e in spec.events
        if isinstance(e.trigger, DistanceTrigger)
        and isinstance(e.action, AgentAction)
        and (e.action.do, e.action.agent) == ('yield', vehicle)
        and {e.trigger.a, e.trigger.b} == {vehicle, person}
    ]
    return min(near, default=YIELDS_WITHIN_M)


def _told_by(spec: ScenarioSpec, agent: GroundAgent) -> str | None:
    """Return the UAV that stays at a place and sends a message to an agent without a motion.

    What makes somebody send something, or fly elsewhere, is one.
    """
    if moves(spec, agent) or any(m.target == agent.id for m in spec.missions):
        return None
    if any(agent.id in bodies_of_cause(e) and _is_of_motion(e) for e in spec.events):
        return None
    staying = {m.uav for m in spec.missions} - {
        m.uav for m in spec.missions if m.mode is not MissionMode.HOVER
    }
    told: list[SendMessage | Link] = [link for link in spec.links if link.rate_hz is not None]
    told += [e.action for e in spec.events if isinstance(e.action, SendMessage)]
    return next((a.sender for a in told if a.receiver == agent.id and a.sender in staying), None)


def _is_of_motion(event: Event) -> bool:
    """Tell whether an event waits for somebody to get far, to a place or to a speed."""
    trigger = event.trigger
    far = isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_above'
    return far or isinstance(trigger, ArrivalTrigger | SpeedTrigger)


def group_releases(spec: ScenarioSpec, split: SceneSplit) -> Mapping[str, Release]:
    """Return when the vehicles with roads of their own may start, where they are held themselves.

    Everybody else starts with the convoy.
    """
    releases: dict[str, Release] = {}
    for group in split.groups:
        own = convoy_release(spec, replace(split, convoy=group))
        if own != Release():
            releases |= {member.agent.id: own for member in group}
    return releases


def convoy_release(spec: ScenarioSpec, split: SceneSplit) -> Release:
    """Hold the convoy until the UAV that watches it is ready, or has finished with it."""
    members = {m.agent.id: m.agent for m in split.convoy}
    times_s = stated_times_s(spec)
    on_time = [
        times_s[e.id]
        for e in spec.events
        if e.id in times_s and getattr(e.action, 'agent', None) in members
    ]
    if on_time and min(on_time) < _watched_by_s(spec):
        return Release()  # What happens at a stated time does not wait for a UAV.
    for mission in spec.missions:
        target = members.get(mission.target or '')
        if target is None or mission.mode is MissionMode.NAVIGATE:
            continue
        if begun_by(spec, mission) is not None:
            before = _watched_from(spec, mission)
            if before is None:
                if _waits_there(spec, mission):
                    return Release(on=ReleaseOn.CAPTURED, uav=mission.uav, mission=mission.id)
                continue
            if _breaks_off(spec, before, mission):
                # Broken off before its first lap is over, a route would not show.
                return Release(on=ReleaseOn.LAPPED, uav=before.uav, mission=before.id)
            # Whom a UAV has to come upon waits where it will be.
            watched = mission if _comes_upon(spec, mission) else before
            return Release(on=ReleaseOn.CAPTURED, uav=watched.uav, mission=watched.id)
        if mission.mode is MissionMode.HOVER and not moves(spec, target):
            followed = _followed_later(spec, mission)
            if followed is not None:
                return Release(on=ReleaseOn.CAPTURED, uav=followed.uav, mission=followed.id)
            return Release(on=ReleaseOn.OBSERVED, uav=mission.uav, mission=mission.id)
        last = _captured_last(spec, mission)
        return Release(on=ReleaseOn.CAPTURED, uav=last.uav, mission=last.id)
    arriving = {t.who for t in _arriving(spec)}
    for mission in spec.missions:
        ends = left_by(spec, mission)
        awaited = None if ends is None else ends.trigger
        flies = mission.mode is MissionMode.NAVIGATE
        if flies and isinstance(awaited, ArrivalTrigger) and awaited.who in members:
            # Broken off before its first lap is over, a route would not show.
            return Release(on=ReleaseOn.LAPPED, uav=mission.uav, mission=mission.id)
    for premise in awaited_at(spec):
        # A UAV that stays at a place awaits whom it is to see there, or to come near it.
        there = premise.mission
        if premise.agent in members and there is not None:
            if there.mode is MissionMode.HOVER:
                return Release(on=ReleaseOn.CAPTURED, uav=there.uav, mission=there.id)
            if left_by(spec, there) == premise.event:
                return Release(on=ReleaseOn.LAPPED, uav=there.uav, mission=there.id)
        arriving.add(premise.agent)
    for one in leaving(spec):
        # Who gets far from a place is near it until the flight that this changes has begun.
        if one.agent in members and isinstance(one.event.action, UavAction):
            return _reporter_ready(spec, one.event.action.uav)
    for uav in spec.uavs:
        # Who is to be seen for a time does not go before anybody looks.
        if asked_to_see(spec, uav.id) & set(members):
            return _reporter_ready(spec, uav.id)
    met = {name for m in encounters(spec) for name in (m.actor, m.other)} | arriving
    # Who is reported by a UAV, or changes its flight, waits until that is up and can see it.
    flying = {uav.id for uav in spec.uavs}
    for event in spec.events:
        action, waits = event.action, ''
        if isinstance(action, SendMessage) and action.sender in flying:
            waits = action.sender
        elif isinstance(action, UavAction) and counts_from_capture(spec, event):
            waits = action.uav
        if waits and bodies_of_cause(event) & set(members):
            return _reporter_ready(spec, waits)
    for event in spec.events:
        trigger = event.trigger
        if isinstance(trigger, DistanceTrigger) and trigger.on == 'distance_below':
            # Who is to come near a UAV does not leave before that is up.
            pair = {trigger.a, trigger.b}
            for name in sorted(pair & flying):
                if pair & set(members):
                    return _reporter_ready(spec, name)
    for mission in spec.missions:
        # A UAV that waits for an event on the ground goes up when somebody has set off.
        if met & set(members) and _goes_up(spec, mission.uav):
            return Release(on=ReleaseOn.ASCENDED, uav=mission.uav)
    return Release()


def _goes_up(spec: ScenarioSpec, uav: str) -> bool:
    """Tell whether a UAV takes off without an event."""
    first = next(m for m in spec.missions if m.uav == uav)
    return begun_by(spec, first) is None


def _ready_to_be_passed(spec: ScenarioSpec, agent: GroundAgent, release: Release) -> Release:
    """Return when one sets off who is to move while a UAV watches another one that does not.

    Once that UAV is there, and the one, too, that watches the mover itself.
    """
    own = next(
        (
            m
            for m in spec.missions
            if m.target == agent.id
            and m.mode is not MissionMode.NAVIGATE
            and begun_by(spec, m) is None
        ),
        None,
    )
    if own is not None:
        return Release(on=ReleaseOn.CAPTURED, uav=own.uav, mission=own.id)
    return replace(release, on=ReleaseOn.CAPTURED)


def _reporter_ready(spec: ScenarioSpec, uav: str) -> Release:
    """Return the release by a UAV that is to report: once it stays, or tracks, or is up."""
    first = next((m for m in spec.missions if m.uav == uav), None)
    if first is None or begun_by(spec, first) is not None:
        return Release()
    if first.mode is MissionMode.NAVIGATE:
        return Release(on=ReleaseOn.ASCENDED, uav=uav)
    return Release(on=ReleaseOn.CAPTURED, uav=uav, mission=first.id)


def _watched_by_s(spec: ScenarioSpec) -> float:
    """Return by when, at the latest, every UAV that takes off at once is where it should be."""
    heights = [m.altitude_m.value for m in spec.missions if begun_by(spec, m) is None]
    return max(heights, default=0.0) / _CLIMBS_MPS + _THERE_S


def _comes_upon(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a mission begins when its UAV, on a route, gets near its target."""
    event = begun_by(spec, mission)
    trigger = None if event is None else event.trigger
    before = _watched_from(spec, mission)
    return (
        isinstance(trigger, DistanceTrigger)
        and trigger.on == 'distance_below'
        and {trigger.a, trigger.b} == {mission.uav, mission.target}
        and before is not None
        and before.mode is MissionMode.NAVIGATE
    )


def _breaks_off(spec: ScenarioSpec, patrol: UavMission, mission: UavMission) -> bool:
    """Tell whether a UAV leaves its route for a body that it sees, or that comes somewhere."""
    event = begun_by(spec, mission)
    arrives = event is not None and isinstance(event.trigger, ArrivalTrigger)
    if patrol.mode is not MissionMode.NAVIGATE or not (arrives or is_kept_away(spec, patrol)):
        return False
    return event is not None and mission.target in bodies_of_cause(event)


def _waits_there(spec: ScenarioSpec, mission: UavMission) -> bool:
    """Tell whether a target waits for a UAV that takes off for it later on.

    Nobody else watches it, and it does nothing that the UAV waits for.
    """
    event = begun_by(spec, mission)
    others = [m for m in spec.missions if m.target == mission.target and m.uav != mission.uav]
    return event is not None and not others and not _brings_about(spec, event, mission.target)


def _watched_from(spec: ScenarioSpec, mission: UavMission) -> UavMission | None:
    """Return the mission in which a UAV awaits the event that lets another one begin."""
    own = [m for m in spec.missions if m.uav == mission.uav]
    before = [m for m in own[: own.index(mission)] if begun_by(spec, m) is None]
    return before[-1] if before else None


def _followed_later(spec: ScenarioSpec, hover: UavMission) -> UavMission | None:
    """Return the flight in which a UAV follows whom it has hovered over, None if it does not."""
    later = spec.missions[spec.missions.index(hover) + 1 :]
    own = (m for m in later if (m.uav, m.target) == (hover.uav, hover.target))
    return next((m for m in own if m.mode is MissionMode.TRACK), None)


def _captured_last(spec: ScenarioSpec, mission: UavMission) -> UavMission:
    """Return which of the UAVs that wait for the same body is ready last.

    Those that begin by watching it, and those whose first mission ends with something that it
    does: broken off before it has begun, that would not show. The highest one is ready last;
    nobody has to catch up with a target that another one has set free.
    """
    first = {m.uav: m for m in reversed(spec.missions)}.values()
    if mission not in first:
        return mission
    sharing = [
        m
        for m in first
        if begun_by(spec, m) is None
        and (
            (m.target == mission.target and m.mode is mission.mode)
            or (m.mode is MissionMode.HOVER and _is_ended_by(spec, m, mission.target or ''))
        )
    ]
    return max((mission, *sharing), key=lambda m: m.altitude_m.value)


def _is_ended_by(spec: ScenarioSpec, mission: UavMission, body: str) -> bool:
    """Tell whether a mission ends with what a body does, or with what comes of that."""
    ends = left_by(spec, mission)
    return ends is not None and any(body in bodies_of_cause(e) for e in causes(spec, ends))


def _brings_about(spec: ScenarioSpec, event: Event, body: str | None) -> bool:
    """Tell whether an event waits for a body, or for something that it does first."""
    first, *earlier = causes(spec, event)
    return body in bodies_of_cause(first) or any(body in bodies_of(e) for e in earlier)
