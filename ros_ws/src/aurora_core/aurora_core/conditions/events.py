# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by events, alerts and links."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.actions import action_conditions, earliest_s
from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    Underivable,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.conditions.links import (
    delivery_deadline_s,
    is_needed,
    link_between,
    loses_messages,
    model_conditions,
    ratio_condition,
)
from aurora_core.conditions.missions import mission_arguments
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.spec.events import actor_of, sets_off
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    Link,
    SendMessage,
    TimeTrigger,
    UavAction,
)
from aurora_core.spec.vocabulary import MissionMode

# What an agent may not have done before it is asked to.
_NOT_BEFORE = frozenset({'start', 'cross', 'change_lane'})


def _binds_before(inputs: Inputs, event: Event) -> bool:
    """Tell whether what an agent did before the trigger would be the action itself, too early.

    Who is to start again has driven before.
    """
    action = event.action
    if not isinstance(action, AgentAction) or action.do not in _NOT_BEFORE:
        return False
    return action.do != 'start' or sets_off(inputs.spec.events, action.agent) == event


def event_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all events and of the messages that they send."""
    used: set[str] = set()
    for event in inputs.spec.events:
        if event.trigger is None and event.action is None:
            what = 'an event without trigger and action'
            yield Underivable(element=event.id, what=what, span=event.span)
            continue
        source = Source(ids=(event.id,), spans=(event.span,))
        yield from _moment(inputs, event, source)
        if isinstance(event.action, AgentAction):
            yield from action_conditions(inputs, event, event.action, source)
        if isinstance(event.action, UavAction) and event.action.altitude_m is not None:
            yield _climb(inputs, event.action, event.action.altitude_m, event, source)
        if isinstance(event.action, SendMessage):
            link = link_between(inputs.spec, event.action.sender, event.action.receiver)
            if link is None:
                yield Underivable(
                    element=event.id,
                    what=f'message from {event.action.sender} to {event.action.receiver}: no link',
                    span=event.span,
                )
                continue
            if link.id not in used:
                if loses_messages(link):
                    yield ratio_condition(inputs, link)
                yield from model_conditions(inputs, link)
            used.add(link.id)
            yield from _alert(inputs, event, event.action, source)
            yield from _message(inputs, event, link)
    for link in inputs.spec.links:
        if link.id not in used:
            yield Underivable(element=link.id, what='a link without a message', span=link.span)


def _moment(inputs: Inputs, event: Event, source: Source) -> Iterator[Condition]:
    if event.trigger is None or event.action is None:
        part = 'action' if event.trigger is None else 'trigger'
        horizon = inputs.facts.horizon_s
        yield condition(
            id=f'{event.id}.happens',
            sentence=f'{event.id} happens by {number(horizon)} s',
            quantity=QuantityName.EVENT_TIME,
            of=(event.id,),
            target=Target(op='<=', threshold=horizon, unit='s'),
            arguments=inputs.arguments(Window.MOMENT, aspect=part, event=event.id),
            source=source,
            every_sample=False,
        )
        return
    delay_s, provenance = 0.0, Provenance.DEFAULT
    first_s = earliest_s(inputs, event)
    if event.delay_s is not None:
        delay_s, provenance = event.waits_s, event.delay_s.provenance
    latest_s = delay_s + inputs.tolerances.event_delay_s
    if event.delay_s is not None and event.delay_s.bound is Bound.AT_MOST:
        latest_s = event.delay_s.value
    source = Source(ids=source.ids, spans=source.spans, provenance=provenance)
    after = 'its trigger' if first_s == 0.0 else f'{number(first_s)} s after its trigger'
    bounds = [
        ('within', f'within {number(latest_s)} s of its trigger', _at_most(latest_s)),
        ('not_before', f'not before {after}', _at_least(first_s)),
    ]
    climbs = isinstance(event.action, UavAction) and event.action.do == 'ascend'
    drives = isinstance(event.action, AgentAction) and not _binds_before(inputs, event)
    if drives or climbs:
        # Drivers slow down and speed up for many reasons, and a UAV has climbed at its take-off:
        # what was before says nothing. What they do before a stated delay is over neither.
        bounds.pop()
    for name, words, target in bounds:
        yield condition(
            id=f'{event.id}.{name}',
            sentence=f'{event.id} happens {words}',
            quantity=QuantityName.EVENT_DELAY,
            of=(event.id,),
            target=target,
            arguments=inputs.arguments(
                Window.MOMENT,
                aspect=name,
                event=event.id,
                after_s=first_s if drives else 0.0,
            ),
            source=source,
            every_sample=False,
        )
    if isinstance(event.trigger, TimeTrigger):
        at = event.trigger.at_s
        if at.provenance is Provenance.EXPLICIT:
            wanted = at.value + delay_s
            slack = inputs.tolerances.duration_s.of(wanted, approximate=at.approximate)
            yield condition(
                id=f'{event.id}.time',
                sentence=f'{event.id} happens at {number(wanted)} s',
                quantity=QuantityName.EVENT_TIME,
                of=(event.id,),
                target=Target(op='==', threshold=wanted, unit='s', tolerance=slack),
                arguments=inputs.arguments(Window.MOMENT, aspect='action', event=event.id),
                source=Source(ids=source.ids, spans=(at.span,), provenance=at.provenance),
                every_sample=False,
            )


def _climb(
    inputs: Inputs, action: UavAction, altitude: Parameter, event: Event, source: Source
) -> Condition:
    """Return that a UAV reaches the altitude that it is to climb to."""
    if altitude.provenance is Provenance.EXPLICIT:
        source = stated_by(source, altitude)
    return condition(
        id=f'{event.id}.altitude',
        sentence=f'{action.uav} reaches {bound_words(altitude)} {number(altitude.value)} m',
        quantity=QuantityName.ALTITUDE,
        of=(action.uav,),
        target=number_target(altitude, inputs.tolerances.altitude_m),
        arguments=inputs.arguments(Window.RUN, event=event.id),
        source=source,
        by_s=inputs.facts.horizon_s,
    )


def _at_most(seconds: float) -> Target:
    return Target(op='<=', threshold=seconds, unit='s')


def _at_least(seconds: float) -> Target:
    return Target(op='>=', threshold=seconds, unit='s')


def _sender_missions(inputs: Inputs, uav: str) -> tuple[MissionArguments, ...]:
    return tuple(
        mission_arguments(inputs, mission)
        for mission in inputs.spec.missions
        if mission.uav == uav
    )


def _alert(
    inputs: Inputs, event: Event, action: SendMessage, source: Source
) -> Iterator[Condition]:
    """Yield the conditions of an alert by a UAV: after ascent or capture, actor in sight."""
    missions = _sender_missions(inputs, action.sender)
    if not missions:
        return
    tracks = any(mission.mode is MissionMode.TRACK for mission in missions)
    after = 'capture' if tracks else 'ascent'
    yield condition(
        id=f'{event.id}.after_{after}',
        sentence=f'{action.sender} sends {event.id} only after its {after}',
        quantity=QuantityName.SENT_AFTER_CAPTURE,
        signal=f'sent_after_{after}({event.id})',
        of=(action.sender,),
        target=Target(op='>=', threshold=0.0, unit='s'),
        arguments=inputs.arguments(Window.MOMENT, aspect=after, event=event.id, missions=missions),
        source=source,
        every_sample=False,
    )
    actor = actor_of(event)
    if actor is not None and actor != action.sender:
        yield condition(
            id=f'{event.id}.actor_visible',
            sentence=f'{action.sender} sees {actor} when it sends {event.id}',
            quantity=QuantityName.VISIBLE_AT_SEND,
            signal=f'sight_margin({action.sender},{actor})',
            of=(action.sender, actor),
            target=Target(op='>', threshold=0.0, unit='m'),
            arguments=inputs.arguments(Window.MOMENT, event=event.id),
            source=source,
        )


def _message(inputs: Inputs, event: Event, link: Link) -> Iterator[Condition]:
    of = (link.sender, link.receiver)
    realised_s = link.latency_s.value
    if is_needed(inputs.spec, link) or not loses_messages(link):
        yield condition(
            id=f'{event.id}.delivered',
            sentence=f'the message of {event.id} reaches {link.receiver}',
            quantity=QuantityName.DELIVERED,
            signal=f'delivery_time({event.id})',
            of=of,
            target=Target(op='<=', threshold=delivery_deadline_s(inputs, link), unit='s'),
            arguments=inputs.arguments(
                Window.MOMENT, aspect='delivered', event=event.id, link=link.id
            ),
            source=Source(
                ids=(event.id, link.id),
                spans=(event.span, link.span),
                provenance=link.latency_s.provenance,
            ),
        )
    if link.latency_s.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{event.id}.latency',
            sentence=(
                f'what passes the link to {link.receiver} takes {number(realised_s)} s '
                f'(within {inputs.tolerances.latency_steps} steps)'
            ),
            quantity=QuantityName.DELIVERY_LATENCY,
            signal=f'excess_latency({link.id})',
            of=of,
            target=Target(op='<=', threshold=float(inputs.tolerances.latency_steps), unit='1'),
            arguments=inputs.arguments(
                Window.MOMENT, aspect='steps', event=event.id, link=link.id, wanted=realised_s
            ),
            source=Source(
                ids=(link.id,), spans=(link.latency_s.span,), provenance=Provenance.EXPLICIT
            ),
        )
