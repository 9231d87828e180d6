# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scenario events against commands and record: phases, actions, releases, the end."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.verdict import Finding
from aurora_core.quantities.view import Body
from aurora_core.spec.own_events import own_events
from aurora_core.spec.scenario import AgentAction, SendMessage
from aurora_core.trace.layout import UavCommandColumn, UavPhase
from aurora_core.trace.records import EventRecord, ScenarioEventKind

# What agents are told by a command; other actions are not carried out yet.
_COMMANDED = frozenset({'brake', 'stop', 'yield', 'slow', 'accelerate', 'start', 'change_lane'})
# The end is claimed as one of these.
_HORIZON = 'horizon'
_OUTCOMES = ('finished', _HORIZON)


def claim_findings(context: Context) -> Iterator[Finding]:
    """Yield every claim that the commands and the record itself do not bear out."""
    yield from _phases(context)
    yield from _actions(context)
    yield from _releases(context)
    yield from _senders(context)
    yield from _end(context)


def _finding(context: Context, kind: str, subject: str, tick: int, text: str) -> Finding:
    return Finding(kind=kind, subject=subject, tick=tick, time_s=context.time_s(tick), text=text)


def _records(context: Context, kind: ScenarioEventKind) -> list[EventRecord]:
    return [record for record in context.view.trace.events if record.kind is kind]


def _phases(context: Context) -> Iterator[Finding]:
    """A phase is claimed at the tick before its first command, and only then."""
    view = context.view
    uavs = {uav.body_id: uav for uav in view.uavs}
    claimed: dict[tuple[str, int], str] = {}
    for record in _records(context, ScenarioEventKind.PHASE):
        if record.subject not in uavs:
            text = f'{record.detail} claimed for a UAV that does not take part'
            yield _finding(context, 'phase', record.subject, record.tick, text)
        elif (record.subject, record.tick) in claimed:
            text = 'two phases claimed at one tick'
            yield _finding(context, 'phase', record.subject, record.tick, text)
        elif record.tick < view.ticks - 1:  # of the last tick no command is recorded
            claimed[(record.subject, record.tick)] = record.detail
    commanded = {
        (name, tick): phase
        for name, uav in uavs.items()
        for tick, phase in _commanded(context, uav)
    }
    for name, tick in sorted({*claimed, *commanded}, key=lambda pair: (pair[1], pair[0])):
        claim, command = claimed.get((name, tick)), commanded.get((name, tick))
        if claim != command:
            text = f'phase claimed: {claim}, the commands begin: {command}'
            yield _finding(context, 'phase', name, tick, text)


def _commanded(context: Context, uav: Body) -> Iterator[tuple[int, str]]:
    """Yield the changes of phase as claims should tell them: tick and name."""
    missions = [m.id for m in context.spec.missions if m.uav == uav.body_id]
    phase = context.view.commands(uav)[:, UavCommandColumn.PHASE]
    for tick in np.flatnonzero(phase[1:] != phase[:-1]).tolist():
        number = int(phase[tick + 1])
        index = number - UavPhase.MISSION
        if 0 <= index < len(missions):
            yield tick, missions[index]
        elif number in tuple(UavPhase):
            yield tick, UavPhase(number).name.lower()
        else:
            yield tick, f'phase {number}'


def _actions(context: Context) -> Iterator[Finding]:
    """Triggers and actions happen once; what an agent is told to do is commanded with the next."""
    view = context.view
    events = (*context.spec.events, *own_events(context.spec))
    actions = {event.id: event.action for event in events}
    for kind in (ScenarioEventKind.TRIGGERED, ScenarioEventKind.ACTION):
        seen = set()
        for record in _records(context, kind):
            if record.subject in seen:
                text = f'{kind.name} claimed a second time'
                yield _finding(context, 'event', record.subject, record.tick, text)
            seen.add(record.subject)
    for record in _records(context, ScenarioEventKind.ACTION):
        action = actions.get(record.subject)
        if not isinstance(action, AgentAction) or action.do not in _COMMANDED:
            continue
        if not _told(context, action.agent, record.tick):
            text = f'action claimed, but nothing was commanded to {action.agent}'
            yield _finding(context, 'event', record.subject, record.tick, text)
    acted = {record.subject for record in _records(context, ScenarioEventKind.ACTION)}
    waiting = {order.then for order in context.spec.orders if order.first in actions}
    for event in events:
        # A message may wait for sight, a change of lane for another lane, and an event for what is
        # ordered before it; nothing else waits for more than its delay.
        if isinstance(event.action, SendMessage) or event.action is None or event.id in acted:
            continue
        if event.id in waiting or getattr(event.action, 'do', '') == 'change_lane':
            continue
        claims = [
            r for r in _records(context, ScenarioEventKind.TRIGGERED) if r.subject == event.id
        ]
        delay_s = event.waits_s
        if claims and context.time_s(view.ticks - 1 - claims[0].tick) > delay_s + view.dt_s:
            text = f'trigger claimed, but no action {delay_s:g} s later'
            yield _finding(context, 'event', event.id, claims[0].tick, text)


def _told(context: Context, agent: str, tick: int) -> bool:
    """Whether a command to an agent is recorded for the next tick, or cannot be."""
    view = context.view
    if not view.has(agent) or not 0 <= tick < view.ticks - 1 or not view.present(agent)[tick]:
        return True
    row = view.body(agent).row
    return any(command.agent == row for command in view.trace.ground_commands[tick + 1])


def _releases(context: Context) -> Iterator[Finding]:
    seen = set()
    for record in _records(context, ScenarioEventKind.RELEASED):
        known = context.view.has(record.subject) and not context.view.body(record.subject).is_uav
        if not known or record.subject in seen:
            what = 'a second time' if known else 'of an agent that does not take part'
            text = f'release claimed {what}'
            yield _finding(context, 'event', record.subject, record.tick, text)
        elif not _told(context, record.subject, record.tick):
            text = 'release claimed, but nothing was commanded'
            yield _finding(context, 'event', record.subject, record.tick, text)
        seen.add(record.subject)


def _senders(context: Context) -> Iterator[Finding]:
    """A message belongs to an event, and goes over the link of that event's action.

    What is reported by itself belongs to its link.
    """
    pairs = {link.id: (link.sender, link.receiver) for link in context.spec.links}
    reporting = {link.id for link in context.spec.links if link.rate_hz is not None}
    events = (*context.spec.events, *own_events(context.spec))
    actions = {event.id: event.action for event in events}
    told = set()
    for record in context.view.trace.links:
        action = actions.get(record.event)
        wanted = (action.sender, action.receiver) if isinstance(action, SendMessage) else None
        key = (record.message, record.event, record.link)
        reported = record.event == record.link and record.link in reporting
        if record.link not in pairs or reported or wanted == pairs[record.link] or key in told:
            continue
        told.add(key)
        text = (
            f'of event {record.event}, which sends no message over this link'
            if wanted is not None
            else f'of {record.event}, which is no event that sends a message'
        )
        subject = f'message {record.message} on {record.link}'
        yield _finding(context, 'message', subject, record.tick, text)


def _end(context: Context) -> Iterator[Finding]:
    """The end is claimed once, at the last tick, and by what has really come to an end."""
    view = context.view
    ends = _records(context, ScenarioEventKind.FINISHED)
    for record in ends[1:]:
        yield _finding(context, 'end', 'run', record.tick, 'the end is claimed a second time')
    if not ends:
        return
    end = ends[0]
    horizon_s = max((c.arguments.horizon_s for c in context.conditions), default=0.0)
    early = context.time_s(end.tick) < horizon_s - view.dt_s / 2.0
    if end.tick != view.ticks - 1:
        text = f'the end is claimed at tick {end.tick}, the record goes to {view.ticks - 1}'
        yield _finding(context, 'end', 'run', end.tick, text)
    elif end.detail not in _OUTCOMES:
        yield _finding(context, 'end', 'run', end.tick, f'unknown outcome {end.detail!r}')
    elif early and (end.detail == _HORIZON or context.spec.world.duration_s is not None):
        text = f'{end.detail} claimed at {context.time_s(end.tick):.2f} s of {horizon_s:g} s'
        yield _finding(context, 'end', 'run', end.tick, text)
    elif early and not _over(context):
        text = 'finished claimed, but the flight of a UAV was not over yet'
        yield _finding(context, 'end', 'run', end.tick, text)


def _over(context: Context) -> bool:
    """Tell whether every UAV has landed, or is not to land and has flown its missions."""
    touchdown_m = context.conditions[0].arguments.touchdown_m if context.conditions else 0.0
    stays_up = {m.uav: m.ends_in_flight for m in context.spec.missions}  # of the last one
    flights = [(m.uav, context.flight(m, touchdown_m)) for m in context.mission_arguments]
    return all(
        flight.landed_tick is not None or (stays_up[uav] and flight.over_tick is not None)
        for uav, flight in flights
    )
