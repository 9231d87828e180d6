# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Complete a request: what it leaves open gets the values that this scenario needs.

Called once, when a prompt was read; every later stage takes the request as it is here. What the
prompt states is never touched.
"""

from __future__ import annotations

from aurora_core.grounding.apart import layer_m
from aurora_core.knowledge.limits import Limits
from aurora_core.parsing import values
from aurora_core.planning.bodies import approaching, meeting, passed, standing, yielding
from aurora_core.planning.bounds import bent
from aurora_core.planning.deadlines import hurried
from aurora_core.planning.endings import landing
from aurora_core.planning.ids import free_ids
from aurora_core.planning.kept_distances import at_start_where_changed
from aurora_core.planning.orders import following, waiting
from aurora_core.spec.events import Event, MessageTrigger, actor_of, least_due_s
from aurora_core.spec.flight_order import begins_as_high
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    ScenarioSpec,
    SendMessage,
    StatedCondition,
    Uav,
    UavMission,
)
from aurora_core.spec.scene import Link, World
from aurora_core.spec.vocabulary import (
    MissionMode,
)

# Sight is lost now and then: this much longer than the time of sight that is asked. A scenario of
# stated length has no such room.
SPARE = 1.25


def complete(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return a request with missions for all UAVs, triggers for orders, durations and altitudes.

    Who yields gets somebody to yield to, who approaches or is oncoming somebody to meet, and who
    is overtaken is ahead until then only.

    Args:
        spec: The request, whoever read it; it is not changed.
        limits: Limits in force.
    """
    spec = meeting(passed(standing(blowing(landing(spec), limits))))
    spec = following(waiting(hovering(reporting(telling(yielding(approaching(spec)))))))
    timed = at_start_where_changed(hurried(spec, limits))
    return as_high(layered(as_high(bent(lasting(timed), limits)), limits))


def blowing(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return the specification with a speed for a wind that is named without one.

    Args:
        spec: The request, whoever read it; it is not changed.
        limits: In force; where the weather has a wind it is as fast as that.
    """
    world = spec.world
    if not world.names_wind or world.wind_mps is not None:
        return spec
    speed = values.default('wind_speed')
    usual_mps = limits.wind_mean_mps[world.weather.value]
    if usual_mps > 0.0:
        speed = speed.model_copy(update={'value': usual_mps})
    world = World.model_validate({**dict(world), 'wind_mps': speed})
    return ScenarioSpec.model_validate({**dict(spec), 'world': world})


def reporting(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with reports over the links that no event sends anything over.

    A link is described for what goes over it.

    Args:
        spec: The request, whoever read it; it is not changed.
    """
    sent = {
        (e.action.sender, e.action.receiver)
        for e in spec.events
        if isinstance(e.action, SendMessage)
    }
    links = tuple(
        link
        if link.rate_hz is not None or (link.sender, link.receiver) in sent
        else Link.model_validate({**dict(link), 'rate_hz': values.default('link_rate')})
        for link in spec.links
    )
    return (
        spec
        if links == spec.links
        else ScenarioSpec.model_validate({**dict(spec), 'links': links})
    )


def telling(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with the messages that something waits for and nobody sends.

    "Only once it has the message of the roadside unit the van may start": that one is sent.

    Args:
        spec: The request, whoever read it; returned as it is when all is sent.
    """
    bodies = {agent.id for agent in spec.agents} | {uav.id for uav in spec.uavs}
    sent = {
        (e.action.sender, e.action.receiver)
        for e in spec.events
        if isinstance(e.action, SendMessage)
    }
    linked = {(link.sender, link.receiver) for link in spec.links}
    events, links = free_ids(spec, 'e'), free_ids(spec, 'link')
    added: list[Event] = []
    over: list[Link] = []
    for event in spec.events:
        trigger = event.trigger
        if not isinstance(trigger, MessageTrigger) or trigger.sender not in bodies:
            continue
        pair = (trigger.sender, trigger.by)
        if pair in sent | linked:  # what is described as a link carries reports
            continue
        sent.add(pair)
        message = SendMessage(do='send_message', sender=trigger.sender, receiver=trigger.by)
        added.append(Event(id=next(events), action=message, span=event.span))
        over.append(
            Link(
                id=next(links),
                sender=trigger.sender,
                receiver=trigger.by,
                loss=values.default('link_loss'),
                latency_s=values.default('link_latency'),
                retransmissions=values.default('link_retransmissions'),
                retransmission_interval_s=values.default('link_retransmission_interval'),
                span=event.span,
            )
        )
    if not added:
        return spec
    update = {'events': (*spec.events, *added), 'links': (*spec.links, *over)}
    return ScenarioSpec.model_validate({**dict(spec), **update})


def hovering(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with a mission for every UAV that has none.

    Who reports what a vehicle does has to see it, and tracks it. Who relays or is there, and
    nothing else is said of it, hovers over the scene.

    Args:
        spec: The request, whoever read it; returned as it is when every UAV has a mission.
    """
    flying = {mission.uav for mission in spec.missions}
    idle = [uav for uav in spec.uavs if uav.id not in flying]
    if not idle:
        return spec
    ids = free_ids(spec, 'm')
    added = tuple(_mission(spec, uav, next(ids)) for uav in idle)
    return ScenarioSpec.model_validate({**dict(spec), 'missions': (*spec.missions, *added)})


def _mission(spec: ScenarioSpec, uav: Uav, mission_id: str) -> UavMission:
    reported = (
        actor_of(e)
        for e in spec.events
        if isinstance(e.action, SendMessage) and e.action.sender == uav.id
    )
    ids = {agent.id for agent in spec.agents}
    target = next((actor for actor in reported if actor in ids), None)
    return UavMission(
        id=mission_id,
        uav=uav.id,
        mode=MissionMode.HOVER if target is None else MissionMode.TRACK,
        target=target,
        target_inferred=target is not None,
        altitude_m=values.default('altitude'),
        standoff_m=None if target is None else values.default('standoff'),
        duration_s=values.default('mission_duration'),
        span=uav.span,
    )


def lasting(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with default durations lengthened, inside their domains.

    "Keeps it in view for 60 s" cannot come true in a phase of 30 s, nor can a stretch without a
    break that is longer than its phase; who is to send a message 63 s after t = 0 does not land
    before; whoever drives for 60 s is tracked for as long. Stated durations stay.

    Args:
        spec: The request; it is not changed.
    """
    spare = SPARE if spec.world.duration_s is None else 1.0
    need: dict[str, float] = {}
    for stated in spec.conditions:
        asked_s = _asked_s(stated)
        for mission in _of(spec, stated) if asked_s > 0.0 else ():
            need[mission.id] = max(need.get(mission.id, 0.0), spare * asked_s)
    for link in spec.links:
        # Who flies for as long as an outage lasts from t = 0 shows its end, too.
        for mission in (m for m in spec.missions if m.uav in (link.sender, link.receiver)):
            if link.outage is not None:
                need[mission.id] = max(need.get(mission.id, 0.0), spare * link.outage[1])
    for event in spec.events:
        if isinstance(event.action, SendMessage):
            own = [m for m in spec.missions if m.uav == event.action.sender]
            for mission in own[-1:]:
                due_s = least_due_s(spec.events, event.id)
                need[mission.id] = max(need.get(mission.id, 0.0), spare * due_s)
    doing_s = {
        a.id: sum(b.duration_s.value for b in a.behaviors if b.duration_s) for a in spec.agents
    }
    for mission in spec.missions:
        asked_s = doing_s.get(mission.target or '', 0.0)
        if mission.mode is MissionMode.TRACK and asked_s > 0.0:
            need[mission.id] = max(need.get(mission.id, 0.0), spare * asked_s)
    if not need:
        return spec
    missions = tuple(_at_least(m, need.get(m.id, 0.0)) for m in spec.missions)
    return ScenarioSpec.model_validate({**dict(spec), 'missions': missions})


def _asked_s(stated: StatedCondition) -> float:
    """Return how long a phase has to be for a condition to come true in it, 0 for any."""
    asked_s = 0.0 if stated.hold_s is None else stated.hold_s.value
    if stated.quantity == QuantityName.VISIBLE_TIME and stated.op in ('>=', '>', '=='):
        asked_s = max(asked_s, stated.value.value)
    return asked_s


def _of(spec: ScenarioSpec, stated: StatedCondition) -> tuple[UavMission, ...]:
    own = tuple(m for m in spec.missions if m.uav in stated.of)
    return tuple(m for m in own if m.target in stated.of) or own


def _at_least(mission: UavMission, seconds: float) -> UavMission:
    duration = mission.duration_s
    if duration is None or duration.provenance is not Provenance.DEFAULT:
        return mission
    longer = Parameter.model_validate(
        {**duration.model_dump(), 'value': max(duration.value, min(seconds, duration.high))}
    )
    return UavMission.model_validate({**dict(mission), 'duration_s': longer})


def as_high(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification in which who stays, or goes on, where it is does so as high.

    Args:
        spec: The request; it is not changed.
    """
    found: list[UavMission] = []
    for mission in spec.missions:
        if begins_as_high(spec, mission):
            before = next(m for m in reversed(found) if m.uav == mission.uav)
            mission = _at(mission, before.altitude_m.value)
        found.append(mission)
    if tuple(found) == spec.missions:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'missions': tuple(found)})


def layered(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return the specification with the altitudes that its UAVs will fly at.

    Several UAVs get different ones, so that their ways never meet. Only altitudes that the prompt
    does not state are moved: upwards, inside domain and limits.

    Args:
        spec: The request; it is not changed.
        limits: Limits in force; layers are twice the separation apart, or what is asked.
    """
    step_m = layer_m(spec, limits)
    taken: dict[str, set[float]] = {}
    for mission in spec.missions:
        if mission.altitude_m.provenance is Provenance.EXPLICIT:
            taken.setdefault(mission.uav, set()).add(mission.altitude_m.value)
    # Who is told something is lowest, so that it is up when others begin to report.
    told = {e.action.receiver for e in spec.events if isinstance(e.action, SendMessage)}
    found: dict[str, UavMission] = {}
    for mission in sorted(spec.missions, key=lambda m: m.uav not in told):
        others = [z for uav, used in taken.items() if uav != mission.uav for z in used]
        height_m = _free_height(mission, others, step_m, limits)
        taken.setdefault(mission.uav, set()).add(height_m)
        found[mission.id] = _at(mission, height_m)
    missions = tuple(found[mission.id] for mission in spec.missions)
    return ScenarioSpec.model_validate({**spec.model_dump(), 'missions': missions})


def _free_height(mission: UavMission, others: list[float], step_m: float, limits: Limits) -> float:
    wanted = mission.altitude_m
    if wanted.provenance is Provenance.EXPLICIT:
        return wanted.value
    top = min(wanted.high, limits.uav_altitude_max_m)
    height_m = wanted.value
    while height_m <= top:
        if all(abs(height_m - z) >= step_m for z in others):
            return height_m
        height_m += step_m
    return wanted.value


def _at(mission: UavMission, height_m: float) -> UavMission:
    known = mission.altitude_m
    if known.value == height_m:
        return mission
    domain = {'low': min(known.low, height_m), 'high': max(known.high, height_m)}
    altitude = {**known.model_dump(), 'value': height_m, **domain}
    return UavMission.model_validate({**mission.model_dump(), 'altitude_m': altitude})
