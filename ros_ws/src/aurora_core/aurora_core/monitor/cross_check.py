# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Claims of the record against recomputation: events, messages, sight, phases, motion."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from aurora_core.judging.evaluation import Context
from aurora_core.judging.quantities.mission_completed import PhaseOrder
from aurora_core.monitor.claim_check import claim_findings
from aurora_core.monitor.motion_check import motion_findings
from aurora_core.outcomes.verdict import Finding
from aurora_core.quantities.kernels import distance_3d
from aurora_core.quantities.ledger import ledger_disagreements
from aurora_core.quantities.ticks import first_tick, whole_ticks
from aurora_core.spec.own_events import own_events
from aurora_core.spec.scenario import (
    ArrivalTrigger,
    Event,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    bodies_of,
)
from aurora_core.trace.layout import UavColumn, UavCommandColumn, UavMode
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind

# The executor learns of receipts, finished missions and finished actions a tick or two later
# than the record shows them, or earlier than the states do.
_SLOW_TRIGGERS = (EventDoneTrigger, MessageTrigger, MissionDoneTrigger)
_SLOW_TICKS = 2
# Ranges in claims are those that the kernel gives.
_RANGE_GUARD_M = 1e-6


def cross_check(context: Context) -> tuple[Finding, ...]:
    """Return every claim that the states do not bear out, in order of time."""
    findings = [
        *_events(context),
        *_actions(context),
        *_ledger(context),
        *_sights(context),
        *_phases(context),
        *claim_findings(context),
        *motion_findings(context),
    ]
    return tuple(sorted(findings, key=lambda f: (f.tick, f.kind, f.subject, f.text)))


def _finding(context: Context, kind: str, subject: str, tick: int, text: str) -> Finding:
    return Finding(kind=kind, subject=subject, tick=tick, time_s=context.time_s(tick), text=text)


def _claims(context: Context, kind: ScenarioEventKind, subject: str) -> list[int]:
    return [
        record.tick
        for record in context.view.trace.events
        if record.kind is kind and record.subject == subject
    ]


def _checkable(context: Context, event: Event) -> bool:
    if not all(context.view.has(name) for name in bodies_of(event)):
        return False  # an agent that could not be placed: its clause is incomplete
    if isinstance(event.trigger, ArrivalTrigger):
        return context.view.geometry.place_point(event.trigger.place) is not None
    return event.trigger is not None


def _events(context: Context) -> Iterator[Finding]:
    known = {event.id for event in (*context.spec.events, *own_events(context.spec))}
    for record in context.view.trace.events:
        about_events = record.kind in (ScenarioEventKind.TRIGGERED, ScenarioEventKind.ACTION)
        if about_events and record.subject not in known:
            text = f'{record.kind.name} claimed for an event that the request does not have'
            yield _finding(context, 'event', record.subject, record.tick, text)
    for event in context.spec.events:
        if not _checkable(context, event):
            continue
        claimed = _claims(context, ScenarioEventKind.TRIGGERED, event.id)
        real = context.events.trigger_tick(event.id)
        claim = claimed[0] if claimed else None
        allowed = _SLOW_TICKS if isinstance(event.trigger, _SLOW_TRIGGERS) else 0
        if claim is None and real is None:
            continue
        if claim is not None and real is not None and abs(claim - real) <= allowed:
            continue
        if claim is None and real is not None and real + allowed >= context.view.ticks:
            continue  # the record ends before the claim was due
        tick = real if claim is None else claim
        assert tick is not None  # not both are None
        text = f'trigger claimed at tick {claim}, the states give tick {real}'
        yield _finding(context, 'event', event.id, tick, text)


def _actions(context: Context) -> Iterator[Finding]:
    for event in context.spec.events:
        if not isinstance(event.action, SendMessage):
            continue
        claimed = _claims(context, ScenarioEventKind.ACTION, event.id)
        sent = [
            record.tick
            for record in context.view.trace.links
            if record.event == event.id and record.kind is LinkEventKind.SENT
        ]
        if claimed != sent:
            tick = (claimed + sent)[0]
            text = f'action claimed at ticks {claimed}, the ledger has it sent at ticks {sent}'
            yield _finding(context, 'event', event.id, tick, text)


def _ledger(context: Context) -> Iterator[Finding]:
    tolerances = (condition.arguments.event_tolerances for condition in context.conditions)
    statistics_from = max((t.statistics_from for t in tolerances if t is not None), default=0)
    for item in ledger_disagreements(context.view, context.links, max(1, statistics_from)):
        yield _finding(context, 'message', item.subject, item.tick, item.text)


def _sights(context: Context) -> Iterator[Finding]:
    for record in context.view.trace.sights:
        subject = f'{record.observer} of {record.target}'
        if not context.view.has(record.observer) or not 0 <= record.tick < context.view.ticks:
            text = 'sight claimed by an unknown observer or outside the recorded ticks'
            yield _finding(context, 'sight', subject, record.tick, text)
            continue
        known = context.view.has(record.target)
        if not known and context.view.geometry.place_point(record.target) is None:
            continue  # a place whose position the world does not hold cannot be checked
        sight = context.sight(record.observer, record.target)
        seen = bool(sight.visible[record.tick])
        slant = float(sight.slant_range_m[record.tick])
        if seen is not record.visible:
            text = f'claimed visible: {record.visible}, the states and buildings give {seen}'
            yield _finding(context, 'sight', subject, record.tick, text)
        elif abs(slant - record.slant_range_m) > _RANGE_GUARD_M:
            text = f'claimed at {record.slant_range_m} m, the states give {slant} m'
            yield _finding(context, 'sight', subject, record.tick, text)


def _phases(context: Context) -> Iterator[Finding]:
    """Check that the states show each commanded change of phase in time."""
    orders = {
        condition.arguments.mission.uav: condition.arguments
        for condition in reversed(context.conditions)
        if isinstance(condition.arguments, PhaseOrder)
    }
    for uav in sorted(orders):
        yield from _changes(context, uav, orders[uav])


def _changes(context: Context, uav: str, asked: PhaseOrder) -> Iterator[Finding]:
    view = context.view
    body = view.body(uav)
    commands, states = view.commands(body), view.rows(body)
    wait = whole_ticks(asked.phase_change_s, view.dt_s)
    phase, mode = commands[:, UavCommandColumn.PHASE], commands[:, UavCommandColumn.MODE]
    reported = states[:, UavColumn.MODE]
    changed = (phase[1:] != phase[:-1]) | (mode[1:] != mode[:-1])
    for tick in (np.flatnonzero(changed) + 1).tolist():
        begins_mode = mode[tick] != mode[tick - 1] and mode[tick] != UavMode.IDLE
        begins_phase = phase[tick] != phase[tick - 1]
        if not (begins_mode or begins_phase) or tick + wait >= view.ticks:
            continue
        if begins_mode and first_tick(reported == mode[tick], tick, tick + wait + 1) is None:
            text = (
                f'mode {UavMode(int(mode[tick])).name} commanded, the states do not report it '
                f'within {asked.phase_change_s} s'
            )
            yield _finding(context, 'phase', uav, tick, text)
        elif begins_phase and mode[tick] == UavMode.OFFBOARD:
            off = _off_setpoint(context, uav, tick + wait)
            still = mode[tick + wait] == UavMode.OFFBOARD
            if still and off > asked.phase_follow_m:
                text = (
                    f'phase {int(phase[tick])} commanded, {off:.2f} m off its set-point '
                    f'{asked.phase_change_s} s later'
                )
                yield _finding(context, 'phase', uav, tick, text)


def _off_setpoint(context: Context, uav: str, tick: int) -> float:
    body = context.view.body(uav)
    state = context.view.rows(body)[tick]
    command = context.view.commands(body)[tick]
    return float(
        distance_3d(
            float(state[UavColumn.X] - command[UavCommandColumn.X]),
            float(state[UavColumn.Y] - command[UavCommandColumn.Y]),
            float(state[UavColumn.Z] - command[UavCommandColumn.Z]),
        )
    )
