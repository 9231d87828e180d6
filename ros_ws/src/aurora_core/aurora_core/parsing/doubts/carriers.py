# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What carries the meaning of telling words: something of its kind in the specification.

Each takes the specification and a clause that holds the words.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from aurora_core.parsing.coverage import parameters
from aurora_core.parsing.doubts.carriers_of_places import OF_PLACES
from aurora_core.parsing.doubts.clauses import meet
from aurora_core.spec.parameter import Parameter, Provenance, Unit
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AgentAction,
    Behavior,
    Clause,
    DistanceTrigger,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    UavAction,
    UavMission,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    Relation,
    Weather,
)

_WINDLESS = frozenset({Weather.CLEAR, Weather.CLOUDY, Weather.FOG})
_STANDING = frozenset({BehaviorKind.PARK, BehaviorKind.STOP, BehaviorKind.WAIT})


def _timed(spec: ScenarioSpec, clause: Clause) -> bool:
    """An element with a place in time: not only bodies, whose behaviours have none."""
    bodies = {agent.id for agent in spec.agents}
    return any(name not in bodies for name in clause.ids)


def _no_act(spec: ScenarioSpec, clause: Clause) -> bool:
    """A list of what is there, `and then there is a bus`: nobody does anything."""
    behaviors = [b for a in spec.agents if a.id in clause.ids for b in a.behaviors]
    return not any(b.span is None or meet(b.span, clause.span) for b in behaviors)


def _stood(spec: ScenarioSpec, clause: Clause) -> bool:
    """A stated time of standing before: who waits does so from t = 0 on, and drives on by itself.

    Who stops may have done anything else before; driving on has no speed or destination to show.
    """
    told = [(a.behaviors, b) for a in spec.agents if a.id in clause.ids for b in a.behaviors]
    told = [(acts, b) for acts, b in told if b.span is not None and meet(b.span, clause.span)]
    plain = all(b == Behavior(kind=BehaviorKind.DRIVE, span=b.span) for _, b in told)
    kinds = _STANDING if plain else _STANDING - {BehaviorKind.STOP}
    return bool(told) and all(
        any(p.kind in kinds and p.duration_s is not None for p in acts[: acts.index(b)])
        for acts, b in told
    )


def _ground(spec: ScenarioSpec, clause: Clause) -> bool:
    """Bodies on the ground alone."""
    return set(clause.ids) <= {agent.id for agent in spec.agents}


def _speed(spec: ScenarioSpec, clause: Clause) -> bool:
    """A stated speed."""
    return any(p.unit is Unit.METRE_PER_SECOND for p in stated(spec))


def _tailgate(spec: ScenarioSpec, clause: Clause) -> bool:
    return any(
        b.kind is BehaviorKind.TAILGATE
        for a in spec.agents
        if a.id in clause.ids
        for b in a.behaviors
    )


def _length(spec: ScenarioSpec, clause: Clause) -> bool:
    """A stated length in the clause."""
    return any(p.unit is Unit.METRE and _inside(p, clause) for p in stated(spec))


def _time_of_day(spec: ScenarioSpec, clause: Clause) -> bool:
    return spec.world.time_of_day_span is not None


def _event(spec: ScenarioSpec, clause: Clause) -> bool:
    return any(e.id in clause.ids for e in spec.events)


def _sequence(spec: ScenarioSpec, clause: Clause) -> bool:
    """An order, a chain of events, or the phases of one UAV, which follow each other."""
    chained = any(
        isinstance(e.trigger, EventDoneTrigger | MissionDoneTrigger) for e in spec.events
    )
    return bool(spec.orders) or chained or _phases(spec, clause)


def _phases(spec: ScenarioSpec, clause: Clause) -> bool:
    """Several phases of one UAV, and nobody else who acts."""
    uavs = [m.uav for m in spec.missions]
    acting = {e.id for e in spec.agents if e.behaviors}
    return len(set(uavs)) == 1 < len(uavs) and not acting


def _condition(spec: ScenarioSpec, clause: Clause) -> bool:
    return any(c.id in clause.ids for c in spec.conditions)


def _of_bodies(spec: ScenarioSpec, clause: Clause) -> bool:
    """A distance of bodies, if any: `100 m apart` is none to the place that one is over."""
    bodies = {name for a in spec.agents for name in (a.id, a.group)}
    bodies |= {uav.id for uav in spec.uavs}
    return all(set(c.of) <= bodies for c in spec.conditions if c.id in clause.ids)


def _no_latency(spec: ScenarioSpec, clause: Clause) -> bool:
    """No latency, which counts from the sending on: `no later than 2 s after` that alone."""
    told = [c.quantity for c in spec.conditions if c.id in clause.ids]
    return 'after' in clause.text.lower() or QuantityName.DELIVERY_LATENCY not in told


def _mission(spec: ScenarioSpec, clause: Clause) -> bool:
    """A phase, whose values hold all along."""
    return any(m.id in clause.ids for m in spec.missions)


def _whole_run(spec: ScenarioSpec, clause: Clause) -> bool:
    """No flight of an open duration in a run of a stated one: it would end somewhere in it."""
    flown = [m.duration_s for m in spec.missions if m.id in clause.ids]
    told = all(d is not None and d.provenance is Provenance.EXPLICIT for d in flown)
    return told or spec.world.duration_s is None


def _unbroken(spec: ScenarioSpec, clause: Clause) -> bool:
    """A bound on sight that no gap keeps."""
    bounds = [c for c in spec.conditions if c.id in clause.ids]
    shares = [c.value.value for c in bounds if c.quantity == QuantityName.VISIBLE_FRACTION]
    return any(c.hold_s is not None for c in bounds) or any(s >= 1.0 for s in shares)


def _distances(spec: ScenarioSpec, clause: Clause) -> list[Parameter]:
    acting = [a for a in spec.agents if a.id in clause.ids]
    told = [p.distance_m for a in acting for p in a.placements if p.distance_m is not None]
    return [p for p in told if p.provenance is Provenance.EXPLICIT and _inside(p, clause)]


def _kept_distance(spec: ScenarioSpec, clause: Clause) -> bool:
    """A distance that holds on the way, and not at t = 0 only."""
    acting = [a for a in spec.agents if a.id in clause.ids]
    return any(p.keeps_distance for a in acting for p in a.placements)


def _no_distance(spec: ScenarioSpec, clause: Clause) -> bool:
    return not _distances(spec, clause)


def _linked(spec: ScenarioSpec, clause: Clause) -> bool:
    """What ties a clause to another in time: an event, a condition, an order.

    A flight does where nobody acts but once, or it watches who does.
    """
    told = {e.id for e in spec.events} | {c.id for c in spec.conditions}
    if told & set(clause.ids) or _sequence(spec, clause):
        return True
    watched = {m.target for m in spec.missions}
    acting = {a.id for a in spec.agents if any(map(_happens_once, a.behaviors))}
    # Whoever is watched, and those about, set out when that begins.
    tracked = any(m.mode is MissionMode.TRACK for m in spec.missions)
    flies = any(m.id in clause.ids for m in spec.missions)
    return acting <= watched or tracked or (not flies and len(acting) < 2)


def _tied(spec: ScenarioSpec, clause: Clause) -> bool:
    """An element with a place in time that is tied to what the other clause says."""
    return _timed(spec, clause) and _linked(spec, clause)


def _caused(spec: ScenarioSpec, clause: Clause) -> bool:
    """An event that waits for what others do, and not for a time."""
    return any(
        e.trigger is not None and not isinstance(e.trigger, TimeTrigger)
        for e in spec.events
        if e.id in clause.ids
    )


def _exclusive(spec: ScenarioSpec, clause: Clause) -> bool:
    """Events whose actions are judged not to come before their triggers."""
    # Whatever they wait for may stand in the same clause: it has no trigger of its own.
    events = [e for e in spec.events if e.id in clause.ids and e.trigger is not None] or [
        e for e in spec.events if not isinstance(e.trigger, TimeTrigger)
    ]
    bound = (
        isinstance(e.action, SendMessage)
        or (isinstance(e.action, UavAction) and e.action.do != 'ascend')
        or (isinstance(e.action, AgentAction) and e.action.do in _NOT_BEFORE)
        for e in events
    )
    return bool(events) and all(bound)


def _on_wheels(spec: ScenarioSpec, clause: Clause) -> bool:
    """Nobody on foot is to do it: `it drives on` is not said of a person."""
    walking = {a.id for a in spec.agents if a.type is AgentType.PEDESTRIAN}
    drives = {a.id for a in spec.agents} - walking
    return bool(drives & set(clause.ids)) or not any(
        isinstance(e.action, AgentAction) and e.action.agent in walking
        for e in spec.events
        if e.id in clause.ids
    )


def _uav_event(spec: ScenarioSpec, clause: Clause) -> bool:
    return any(isinstance(e.action, UavAction) for e in spec.events)


def _return_home(spec: ScenarioSpec, clause: Clause) -> bool:
    return any(
        isinstance(e.action, UavAction) and e.action.do == 'return_home' for e in spec.events
    )


def _looks(spec: ScenarioSpec, clause: Clause) -> bool:
    """Something about sight, or a flight that watches a body of the clause."""
    bodies = {agent.id for agent in spec.agents}
    return (
        any(isinstance(e.trigger, VisibilityTrigger) for e in spec.events)
        or any(c.quantity.startswith('visible') for c in spec.conditions)
        or any(m.target in bodies for m in spec.missions if m.id in clause.ids)
    )


def _watches(spec: ScenarioSpec, clause: Clause) -> bool:
    """A flight that watches something, be it a place."""
    return any(m.target is not None for m in spec.missions if m.id in clause.ids)


def _waits(spec: ScenarioSpec, clause: Clause) -> bool:
    standing = _STANDING - {BehaviorKind.STOP}
    return any(b.kind in standing for a in spec.agents if a.id in clause.ids for b in a.behaviors)


def _row(spec: ScenarioSpec, clause: Clause) -> bool:
    """Places of the bodies of a clause behind each other."""
    ids = {agent.id for agent in spec.agents}
    told = [a for a in spec.agents if a.id in clause.ids]
    return any(p.of in ids for a in told for p in a.placements) or any(
        b.target in ids for a in told for b in a.behaviors
    )


def _closed(spec: ScenarioSpec, clause: Clause) -> bool:
    """What says how many bodies there are, or forbids some, or how dense the traffic is."""
    return bool(spec.counts) or bool(spec.prohibitions) or 'world' in clause.ids


def _at_the_same_time(spec: ScenarioSpec, clause: Clause) -> bool:
    """Not a length but a moment: `at the same time`, which has a row of its own."""
    return re.search(r'\bat the same (?:moment|time)\b', clause.text.lower()) is not None


def _alone(spec: ScenarioSpec, clause: Clause) -> bool:
    """Nobody else could take a turn."""
    return len(spec.uavs) < 2 and len(spec.agents) < 2


def _earlier(spec: ScenarioSpec, clause: Clause) -> bool:
    """A phase like an earlier one of the same UAV."""
    told = [m for m in spec.missions if m.id in clause.ids]
    return any(_alike(m, n) for m in told for n in spec.missions[: spec.missions.index(m)])


def _first_phase(spec: ScenarioSpec, clause: Clause) -> bool:
    """No further phase of a UAV: `keeps 20 m from the car that it tracks` tells of one."""
    told = [m for m in spec.missions if m.id in clause.ids]
    return not any(m.uav == n.uav for m in told for n in spec.missions[: spec.missions.index(m)])


def _leads(spec: ScenarioSpec, clause: Clause) -> bool:
    """Something that comes after what a clause became, or the first of several phases."""
    own = set(clause.ids)
    after = {e.trigger.event for e in spec.events if isinstance(e.trigger, EventDoneTrigger)}
    after |= {order.first for order in spec.orders}
    flown = any(m.id in own for m in spec.missions) and _first_phase(spec, clause)
    return bool(own & after) or flown


def _behind_another(spec: ScenarioSpec, clause: Clause) -> bool:
    """Somebody who is ahead of or behind somebody else, or keeps behind."""
    placed = [p.relation for a in spec.agents for p in a.placements]
    kept = [b.kind for a in spec.agents for b in a.behaviors]
    row = {Relation.AHEAD, Relation.BEHIND} & set(placed)
    return bool(row or {BehaviorKind.FOLLOW, BehaviorKind.TAILGATE} & set(kept))


def _differing(spec: ScenarioSpec, clause: Clause) -> bool:
    """`at 30 m and 50 m respectively`: no two numbers of a unit that two elements share."""
    elements = (*spec.missions, *spec.agents, *spec.events)
    told = [(p.unit, p.span) for e in elements for p in parameters(e) if p.span is not None]
    shared = [unit for unit, _ in {one for one in told if told.count(one) > 1}]
    return len(shared) == len(set(shared))


def _alike(one: UavMission, other: UavMission) -> bool:
    return (one.uav, one.mode, one.target) == (other.uav, other.mode, other.target)


# Behaviours with a moment of their own: when that is nothing says but an event.
_ONCE = frozenset(
    {
        BehaviorKind.STOP,
        BehaviorKind.BRAKE,
        BehaviorKind.SLOW,
        BehaviorKind.TURN_LEFT,
        BehaviorKind.TURN_RIGHT,
        BehaviorKind.CHANGE_LANE,
        BehaviorKind.OVERTAKE,
        BehaviorKind.YIELD,
        BehaviorKind.CROSS,
    }
)


def _happens_once(behavior: Behavior) -> bool:
    """Whether a behaviour has a moment of its own; one is at a place once, too."""
    goes = behavior.kind is BehaviorKind.DRIVE and behavior.target is not None
    return behavior.kind in _ONCE or goes


# Actions of agents that are never to come before their triggers (semantics: "not before").
_NOT_BEFORE = frozenset({'start', 'cross', 'change_lane'})


def _no_event(spec: ScenarioSpec, clause: Clause) -> bool:
    """What goes on, and is no effect of something."""
    return not any(e.action is not None for e in spec.events if e.id in clause.ids)


def _mutual(spec: ScenarioSpec, clause: Clause) -> bool:
    """A distance between two, or places of bodies that are told from each other."""
    between = any(len(c.of) > 1 for c in spec.conditions if c.id in clause.ids)
    near = any(isinstance(e.trigger, DistanceTrigger) for e in spec.events)
    ids = {agent.id for agent in spec.agents}
    placed = any(p.of in ids for a in spec.agents if a.id in clause.ids for p in a.placements)
    return between or near or placed


def _within(spec: ScenarioSpec, clause: Clause) -> bool:
    """Two that follow each other in a stated time."""
    return any(o.within_s is not None for o in spec.orders if o.id in clause.ids)


def _several(spec: ScenarioSpec, clause: Clause) -> bool:
    """All that there are, where no traffic is about: two or more with the same part."""
    told = [e for e in spec.events if e.id in clause.ids]
    told_to = {e.action.receiver for e in told if isinstance(e.action, SendMessage)}
    acting = {e.action.agent for e in told if isinstance(e.action, AgentAction)}
    return spec.world.traffic_density is None and max(len(told_to), len(acting)) > 1


def _retries(spec: ScenarioSpec, clause: Clause) -> bool:
    """A link that sends again what was lost, or reports by itself, as often as is stated."""
    links = [link for link in spec.links if link.id in clause.ids]
    told = [p for link in links for p in (link.retransmissions, link.rate_hz) if p is not None]
    return any(p.provenance is Provenance.EXPLICIT for p in told)


def _relayed(spec: ScenarioSpec, clause: Clause) -> bool:
    """A message that is sent by whom another one has reached."""
    sent = [e for e in spec.events if isinstance(e.action, SendMessage)]
    return (
        any(
            isinstance(e.trigger, MessageTrigger)
            and isinstance(e.action, SendMessage)
            and e.trigger.by == e.action.sender
            for e in sent
        )
        and len(sent) > 1
    )


def _messaged(spec: ScenarioSpec, clause: Clause) -> bool:
    return any(isinstance(e.trigger, MessageTrigger) for e in spec.events)


def _no_wind(spec: ScenarioSpec, clause: Clause) -> bool:
    """A weather that has no wind of its own, and none that is told."""
    told = spec.world.wind_mps is not None or spec.world.wind is not None
    return not told and spec.world.weather in _WINDLESS


def _handed_over(spec: ScenarioSpec, clause: Clause) -> bool:
    """An order, where no UAV watches another one."""
    uavs = {uav.id for uav in spec.uavs}
    return _sequence(spec, clause) and not any(m.target in uavs for m in spec.missions)


def _not_done(spec: ScenarioSpec, clause: Clause) -> bool:
    """No deed of the clause that something waits for the end of; a message is sent at once."""
    triggers = [e.trigger for e in spec.events if isinstance(e.trigger, EventDoneTrigger)]
    awaited = {t.event for t in triggers if t.on == 'event_done'}
    deeds = [e for e in spec.events if not isinstance(e.action, SendMessage)]
    return not any(e.id in awaited for e in deeds if e.id in clause.ids)


def _drift(spec: ScenarioSpec, clause: Clause) -> bool:
    """A bound on the drift of a hover."""
    return any(c.quantity == QuantityName.HOVER_DRIFT for c in spec.conditions)


CARRIERS: dict[str, Callable[[ScenarioSpec, Clause], bool]] = {
    **OF_PLACES,
    'linked': _linked,
    'caused': _caused,
    'tied': _tied,
    'exclusive': _exclusive,
    'phases': _phases,
    'on_wheels': _on_wheels,
    'uav_event': _uav_event,
    'looks': _looks,
    'return_home': _return_home,
    'waits': _waits,
    'watches': _watches,
    'row': _row,
    'closed': _closed,
    'at_the_same_time': _at_the_same_time,
    'timed': _timed,
    'condition': _condition,
    'mission': _mission,
    'of_bodies': _of_bodies,
    'no_latency': _no_latency,
    'whole_run': _whole_run,
    'unbroken': _unbroken,
    'kept_distance': _kept_distance,
    'no_distance': _no_distance,
    'no_act': _no_act,
    'stood': _stood,
    'ground': _ground,
    'speed': _speed,
    'tailgate': _tailgate,
    'length': _length,
    'time_of_day': _time_of_day,
    'event': _event,
    'first_phase': _first_phase,
    'behind_another': _behind_another,
    'leads': _leads,
    'differing': _differing,
    'sequence': _sequence,
    'alone': _alone,
    'earlier': _earlier,
    'no_wind': _no_wind,
    'no_event': _no_event,
    'mutual': _mutual,
    'messaged': _messaged,
    'relayed': _relayed,
    'within': _within,
    'several': _several,
    'retries': _retries,
    'drift': _drift,
    'handed_over': _handed_over,
    'not_done': _not_done,
}


def stated(spec: ScenarioSpec) -> Iterator[Parameter]:
    """Yield the numbers that a request states."""
    return (p for p in parameters(spec) if p.provenance is Provenance.EXPLICIT)


def _inside(parameter: Parameter, clause: Clause) -> bool:
    span = parameter.span
    return span is not None and clause.span.start <= span.start and span.end <= clause.span.end
