# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds on the times of events: their triggers, what happens then, and when that is done."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from itertools import chain

from aurora_core.outcomes.feasibility import BoundKind
from aurora_core.spec.events import reports_own_altitude
from aurora_core.spec.parameter import Bound
from aurora_core.spec.scenario import (
    AgentAction,
    AltitudeTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    TimeTrigger,
    VisibilityTrigger,
)
from aurora_core.spec.stated import is_stated, least
from aurora_core.temporal.flights import flown_by, over
from aurora_core.temporal.links import START, Basis, Link


def moment(event: str) -> str:
    """Return the point at which an event happens: its action shows, or its trigger holds."""
    return f'events/{event}'


def trigger(event: str) -> str:
    """Return the point at which the trigger of an event holds for the first time."""
    return f'events/{event}/trigger'


def done(event: str) -> str:
    """Return the point from which on other events may follow an event."""
    return f'events/{event}/done'


def event_links(basis: Basis) -> Iterator[Link]:
    """Yield the bounds on the times of all events."""
    for event in basis.spec.events:
        yield from chain(_cause(basis, event), _happening(basis, event), _aloft(basis, event))


def _happening(basis: Basis, event: Event) -> Iterator[Link]:
    of, slack = f'events/{event.id}', ('duration_s',)
    # What has no action happens with its trigger.
    delay = event.delay_s if event.action is not None else None
    least_s, most_s = basis.window_s(delay)
    wait = partial(Link, earlier=trigger(event.id), later=moment(event.id), of=of)
    stated = ((f'{of}/delay_s', delay),)
    yield wait(
        least_s=least_s,
        kind=BoundKind.DELAY,
        words=f'{event.id} waits after its trigger',
        stated=stated,
        tolerances=slack,
    )
    late_s = most_s
    if event.action is not None and (delay is None or delay.bound is not Bound.AT_MOST):
        late_s += basis.tolerances.event_delay_s
    if event.trigger is not None and not _is_free(event) and math.isfinite(late_s):
        yield wait(
            most_s=late_s,
            kind=BoundKind.SOON,
            words=f'{event.id} comes within {late_s:g} s of its trigger',
            stated=stated,
            tolerances=('duration_s', 'event_delay_s'),
        )
    yield Link(
        earlier=moment(event.id),
        later=done(event.id),
        least_s=0.0,
        kind=BoundKind.END,
        of=of,
        words=f'{event.id} ends after it began',
    )
    if event.action is None:
        yield Link(
            earlier=moment(event.id),
            later=done(event.id),
            most_s=0.0,
            kind=BoundKind.END,
            of=of,
            words=f'{event.id} is a moment',
        )


def _aloft(basis: Basis, event: Event) -> Iterator[Link]:
    """Yield that a UAV sends nothing before its ascent is over, but for an altitude of its own."""
    action = event.action
    if not isinstance(action, SendMessage) or reports_own_altitude(event):
        return
    if flown_by(basis, action.sender):
        yield Link(
            earlier=f'uavs/{action.sender}/up',
            later=moment(event.id),
            least_s=0.0,
            kind=BoundKind.ALOFT,
            of=f'events/{event.id}',
            words=f'{action.sender} sends once it is up',
            stated=((f'events/{event.id}/action/sender', action.sender),),
        )


def _is_free(event: Event) -> bool:
    """Tell whether an action waits for a place where it is possible."""
    return isinstance(event.action, AgentAction) and event.action.do == 'change_lane'


def _cause(basis: Basis, event: Event) -> Iterator[Link]:
    """Yield when the trigger of an event can hold."""
    of, at, cause = f'events/{event.id}', trigger(event.id), event.trigger
    flying = {m.uav for m in basis.spec.missions}
    yield Link(
        earlier=START,
        later=at,
        least_s=0.0,
        kind=BoundKind.START,
        of=of,
        words=f'{event.id} comes after the start',
    )
    if isinstance(cause, TimeTrigger):
        yield from _at_time(basis, event, cause)
    elif isinstance(cause, EventDoneTrigger):
        yield from _after(basis, event, cause)
    elif isinstance(cause, MessageTrigger):
        yield from _told(basis, event, cause)
    elif isinstance(cause, AltitudeTrigger):
        rate_mps, height_m = basis.limits.uav_climb_max_mps, least(cause.value_m, 0.0, 0.0)
        yield Link(
            earlier=f'uavs/{cause.uav}/takeoff',
            later=at,
            least_s=height_m / rate_mps,
            kind=BoundKind.CLIMB,
            of=of,
            words=f'{cause.uav} climbs {height_m:g} m at {rate_mps:g} m/s at most',
            stated=((f'{of}/trigger/value_m', cause.value_m),),
            limits=('uav_climb_max_mps',),
        )
    elif isinstance(cause, MissionDoneTrigger):
        yield from _flown(basis, event, cause)
    elif isinstance(cause, VisibilityTrigger) and cause.observer in flying:
        yield Link(
            earlier=f'uavs/{cause.observer}/up',
            later=at,
            least_s=0.0,
            kind=BoundKind.SIGHT,
            of=of,
            words=f'{cause.observer} looks out once it is up',
            stated=((f'{of}/trigger/observer', cause.observer),),
        )


def _flown(basis: Basis, event: Event, cause: MissionDoneTrigger) -> Iterator[Link]:
    """Yield that an event waits for all missions of a UAV.

    Whom events give something else to do may mean a mission that is not its last one.
    """
    of, flown = f'events/{event.id}', flown_by(basis, cause.uav)
    if flown and cause.uav not in basis.redirected:
        yield Link(
            earlier=over(flown[-1].id),
            later=trigger(event.id),
            least_s=0.0,
            kind=BoundKind.DONE,
            of=of,
            words=f'{event.id} waits until {cause.uav} is done',
            stated=((f'{of}/trigger/uav', cause.uav),),
        )


def _at_time(basis: Basis, event: Event, cause: TimeTrigger) -> Iterator[Link]:
    of = f'events/{event.id}'
    least_s, most_s = basis.window_s(cause.at_s)
    _, delay_s = basis.window_s(event.delay_s)
    stated = ((f'{of}/trigger/at_s', cause.at_s), (f'{of}/delay_s', event.delay_s))
    yield Link(
        earlier=START,
        later=trigger(event.id),
        least_s=least_s,
        kind=BoundKind.TIME,
        of=of,
        words=f'{event.id} is set to {cause.at_s.value:g} s',
        stated=stated[:1],
        tolerances=('duration_s',),
    )
    if is_stated(cause.at_s) and math.isfinite(most_s + delay_s):
        yield Link(
            earlier=START,
            later=moment(event.id),
            most_s=most_s + delay_s,
            kind=BoundKind.TIME,
            of=of,
            words=f'{event.id} is set to {cause.at_s.value:g} s',
            stated=stated,
            tolerances=('duration_s',),
        )


def _after(basis: Basis, event: Event, cause: EventDoneTrigger) -> Iterator[Link]:
    of = f'events/{event.id}'
    least_s, most_s = basis.window_s(cause.after_s)
    begun = cause.on == 'event_begun'
    first = moment(cause.event) if begun else done(cause.event)
    awaits = partial(Link, earlier=first, later=trigger(event.id), kind=BoundKind.CAUSE, of=of)
    stated = ((f'{of}/trigger/event', cause.event), (f'{of}/trigger/after_s', cause.after_s))
    yield awaits(
        least_s=least_s,
        words=f'{event.id} waits for {cause.event}',
        stated=stated,
        tolerances=('duration_s',),
    )
    # A walk to the kerb shows before the crossing has begun: no latest time follows from that.
    if math.isfinite(most_s) and not begun:
        yield awaits(
            most_s=most_s,
            words=f'{event.id} is triggered within {most_s:g} s of the end of {cause.event}',
            stated=stated,
            tolerances=('duration_s',),
        )


def _told(basis: Basis, event: Event, cause: MessageTrigger) -> Iterator[Link]:
    """Yield that a message is received after it was sent, when there is one that it can be.

    The message that an event itself sends is not the one that it waits for.
    """
    sent = [
        e
        for e in basis.spec.events
        if e is not event
        and isinstance(e.action, SendMessage)
        and e.action.receiver == cause.by
        and cause.sender in (None, e.action.sender)
    ]
    if len(sent) == 1:
        yield Link(
            earlier=moment(sent[0].id),
            later=trigger(event.id),
            least_s=0.0,
            kind=BoundKind.MESSAGE,
            of=f'events/{event.id}',
            words=f'{event.id} waits for the message of {sent[0].id}',
            stated=((f'events/{event.id}/trigger/by', cause.by),),
        )
