# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What comes before what: phases of one UAV, and events."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.judging.build import Inputs, Source, Target, Underivable, number
from aurora_core.judging.mission import mission_arguments
from aurora_core.judging.quantities import event_and_phase, event_delay, mission_completed
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities.actions import CLIMBED_M
from aurora_core.spec.flight_order import begun_by, end_of
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    EventDoneTrigger,
    MissionDoneTrigger,
    Order,
    SendMessage,
    UavAction,
    UavMission,
)


def order_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all orders that can be carried out and judged."""
    for order in inputs.spec.orders:
        source = Source(
            ids=(order.id,), spans=(order.span,), provenance=Provenance.EXPLICIT, implied=False
        )
        phases = _phases(inputs, order)
        if phases:
            yield from (_phase(inputs, order, mission, source) for mission in phases)
        elif (event := _awaiting(inputs, order)) is not None or _of_events(inputs, order):
            yield from _events(inputs, order, source, event)
        elif (found := _mixed(inputs, order, source)) is not None:
            yield found
        else:
            what = f'that {order.first} comes before {order.then}'
            yield Underivable(element=order.id, what=what, span=order.span)


def _phases(inputs: Inputs, order: Order) -> tuple[UavMission, ...]:
    """Return the missions of one UAV that follow the first one, up to the second one.

    A UAV flies its missions in the order listed; the other way round nobody can.
    """
    if order.within_s is not None:
        return ()
    flown = {mission.id: mission.uav for mission in inputs.spec.missions}
    own = [m for m in inputs.spec.missions if m.uav == flown.get(order.first)]
    ids = [m.id for m in own]
    if order.then not in ids:
        return ()
    return tuple(own[ids.index(order.first) + 1 : ids.index(order.then) + 1])


def _phase(inputs: Inputs, order: Order, mission: UavMission, source: Source) -> Condition:
    return mission_completed.in_order(
        inputs,
        mission_arguments(inputs, mission),
        source,
        id=f'{order.id}.holds' + ('' if mission.id == order.then else f'.{mission.id}'),
        sentence=f'{mission.uav} flies {mission.id} after the phase before it',
    )


def _mixed(inputs: Inputs, order: Order, source: Source) -> Condition | None:
    """Return that a mission begins after an event, or that a UAV climbs after a mission."""
    events = {event.id: event for event in inputs.spec.events}
    missions = {mission.id: mission for mission in inputs.spec.missions}
    if order.within_s is not None:
        return None
    event, later = events.get(order.first), missions.get(order.then)
    if event is not None and later is not None and _acts_at_a_moment(event):
        return event_and_phase.event_first(inputs, order, mission_arguments(inputs, later), source)
    mission, climb = missions.get(order.first), events.get(order.then)
    action = None if climb is None else climb.action
    if mission is None or not isinstance(action, UavAction) or action.altitude_m is None:
        return None
    measured = mission_arguments(inputs, mission)
    goal_m = action.altitude_m.value
    # On its way up a UAV passes what is lower than that: nothing tells the two apart.
    lowest_m = measured.altitude_m + measured.altitude_tolerance_m + CLIMBED_M
    first_m = measured.first_altitude_m + measured.first_altitude_tolerance_m + CLIMBED_M
    if action.do != 'ascend' or action.uav != mission.uav or goal_m <= max(lowest_m, first_m):
        return None
    return event_and_phase.mission_first(inputs, order, measured, goal_m, source)


def _acts_at_a_moment(event: Event) -> bool:
    """Tell whether the record shows when a driver, a person or a message did what is told."""
    acts = isinstance(event.action, AgentAction | SendMessage)
    return acts and event.trigger is not None


def _of_events(inputs: Inputs, order: Order) -> bool:
    events = {event.id: event for event in inputs.spec.events}
    first, then = events.get(order.first), events.get(order.then)
    if first is None or then is None or not _has_a_moment(then):
        return False
    return _has_a_moment(first) or _waits_for(then, order.first)


def _waits_for(event: Event, other: str) -> bool:
    return isinstance(event.trigger, EventDoneTrigger) and event.trigger.event == other


def _awaiting(inputs: Inputs, order: Order) -> Event | None:
    """Return the event that waits for the end of a flight, or lets a UAV wait for an event.

    Climbs are left out: a UAV has climbed at its take-off, too.
    """
    if order.within_s is not None:
        return None
    spec = inputs.spec
    later = {e.id: e for e in spec.events}.get(order.then)
    for mission in spec.missions:
        if mission.id == order.then:
            later = begun_by(spec, mission)
    if later is None or later.trigger is None or later.trigger != end_of(spec, order.first):
        return None
    flies = isinstance(later.action, UavAction) and later.action.do != 'ascend'
    sends = isinstance(later.action, SendMessage)
    of_flight = isinstance(later.trigger, MissionDoneTrigger)
    changes = flies and later.id != order.then
    return later if changes or (of_flight and (flies or sends)) else None


def _has_a_moment(event: Event) -> bool:
    """Tell whether states and messages show when an event happened.

    Drivers slow down and speed up for many reasons: without a trigger nothing says which time it
    was that was meant, unless another event waits for it; then it is the first one.
    """
    if event.action is None or isinstance(event.action, AgentAction):
        return event.trigger is not None
    return True


def _events(
    inputs: Inputs, order: Order, source: Source, awaiting: Event | None
) -> Iterator[Condition]:
    not_before = Target(op='>=', threshold=0.0, unit='s')
    bounds = [('holds', f'{order.first} comes before {order.then}', not_before)]
    if order.within_s is not None:
        latest_s = order.within_s.value
        words = f'{order.then} comes within {number(latest_s)} s of {order.first}'
        bounds.append(('within', words, Target(op='<=', threshold=latest_s, unit='s')))
    for name, sentence, target in bounds:
        yield event_delay.in_order(inputs, order, name, sentence, target, source, awaiting)
