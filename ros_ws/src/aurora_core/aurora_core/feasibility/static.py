# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Static verification: whether the parts of a specification fit together.

The schema holds each part to its form, and references to what there is; here is what only their
meaning says. A finding is a fault of whoever wrote the specification, never a proof.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.feasibility.operands import members_fit
from aurora_core.outcomes.feasibility import StaticFinding
from aurora_core.spec.doing import doing
from aurora_core.spec.events import (
    AgentAction,
    BehaviorDoneTrigger,
    EventDoneTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    shows_its_beginning,
)
from aurora_core.spec.prohibitions import ForbiddenAgent, ForbiddenBehavior
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode

_NEEDS = {
    QuantityName.ALTITUDE.value: 'one UAV',
    QuantityName.HOVER_DRIFT.value: 'one UAV',
    QuantityName.WAYPOINTS_VISITED.value: 'one UAV',
    QuantityName.MISSION_COMPLETED.value: 'one UAV',
    QuantityName.LANDED.value: 'one UAV',
    QuantityName.BATTERY.value: 'one UAV',
    QuantityName.SPEED.value: 'one body',
    QuantityName.EVENT_TIME.value: 'one event',
    QuantityName.SEPARATION.value: 'several bodies, or one group',
    QuantityName.DISTANCE.value: 'two bodies, or a body and a place',
    QuantityName.HORIZONTAL_DISTANCE.value: 'two bodies, or a body and a place',
    QuantityName.VISIBLE_TIME.value: 'a body and what it sees',
    QuantityName.VISIBLE_FRACTION.value: 'a body and what it sees',
    QuantityName.TRACKED_FRACTION.value: 'a UAV and its target',
    QuantityName.CLEARANCE.value: 'a UAV and what it keeps away from',
}
_SHARES = (
    QuantityName.TRACKED_FRACTION,
    QuantityName.VISIBLE_FRACTION,
    QuantityName.DELIVERY_RATIO,
    QuantityName.BATTERY,
)


def check_static(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    """Yield what of a specification does not fit together, with what would mend it."""
    yield from _conditions(spec)
    yield from _messages(spec)
    yield from _beginnings(spec)
    yield from _behaviors(spec)
    yield from _missions(spec)
    yield from _scene(spec)


def _conditions(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    for condition in spec.conditions:
        base, quantity = f'conditions/{condition.id}', condition.quantity
        if not members_fit(spec, condition):
            needs = _NEEDS.get(quantity, 'a sender and a receiver')
            yield StaticFinding(
                field=f'{base}/of',
                relation=f'{quantity} is of {needs}, not of {", ".join(condition.of)}',
                mend=f'name {needs}, or another quantity',
                span=condition.span,
            )
        shares = [('fraction', condition.fraction)]
        shares += [('value', condition.value)] if quantity in _SHARES else []
        for name, share in shares:
            if share is not None and not 0.0 <= share.value <= 1.0:
                yield StaticFinding(
                    field=f'{base}/{name}',
                    relation=f'a share lies between 0 and 1, found {share.value:g}',
                    mend='write a percentage as its hundredth part',
                    span=share.span or condition.span,
                )


def _messages(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    linked = {(link.sender, link.receiver) for link in spec.links}
    sent = [e.action for e in spec.events if isinstance(e.action, SendMessage)]
    for event in spec.events:
        action, trigger = event.action, event.trigger
        if isinstance(action, SendMessage) and (action.sender, action.receiver) not in linked:
            yield StaticFinding(
                field=f'events/{event.id}/action',
                relation=f'no link leads from {action.sender} to {action.receiver}',
                mend='add the link',
                span=event.span,
            )
        if isinstance(trigger, MessageTrigger) and not any(
            a.receiver == trigger.by and trigger.sender in (None, a.sender) for a in sent
        ):
            yield StaticFinding(
                field=f'events/{event.id}/trigger',
                relation=f'{trigger.by} waits for a message that nobody sends',
                mend=f'add an event that sends one to {trigger.by}',
                span=event.span,
            )


def _beginnings(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    actions = {e.id: e.action for e in spec.events}
    for event in spec.events:
        trigger = event.trigger
        if not isinstance(trigger, EventDoneTrigger) or trigger.on != 'event_begun':
            continue
        if not shows_its_beginning(actions[trigger.event]):
            yield StaticFinding(
                field=f'events/{event.id}/trigger/event',
                relation=f'nobody sees when {trigger.event} begins',
                mend='wait until it is done (event_done)',
                span=event.span,
            )


def _behaviors(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    for event in spec.events:
        trigger = event.trigger
        if isinstance(trigger, BehaviorDoneTrigger) and doing(spec, trigger) is None:
            yield StaticFinding(
                field=f'events/{event.id}/trigger/behavior',
                relation=f'{trigger.who} is not to {trigger.behavior} for a stated time',
                mend='state for how long',
                span=event.span,
            )


def _missions(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    flown = {m.uav for m in spec.missions}
    listed = {m.id: k for k, m in enumerate(spec.missions)}
    uav_of = {m.id: m.uav for m in spec.missions}
    for mission in spec.missions:
        target = mission.target
        if mission.mode is MissionMode.TRACK and target is not None and is_place(target):
            yield StaticFinding(
                field=f'missions/{mission.id}/target',
                relation=f'who is tracked moves, and {target} is a place',
                mend='hover over it, or track a body',
                span=mission.span,
            )
    for event in spec.events:
        trigger = event.trigger
        if isinstance(trigger, MissionDoneTrigger) and trigger.uav not in flown:
            yield StaticFinding(
                field=f'events/{event.id}/trigger/uav',
                relation=f'{trigger.uav} has no mission that could be done',
                mend='give it a mission',
                span=event.span,
            )
    for order in spec.orders:
        first, then = order.first, order.then
        if uav_of.get(first) is None or uav_of.get(first) != uav_of.get(then):
            continue
        if listed[first] > listed[then]:
            yield StaticFinding(
                field=f'orders/{order.id}',
                relation=f'{first} is to come before {then}, and is listed after it',
                mend='list the missions of a UAV as they are flown',
                span=order.span,
            )


def _scene(spec: ScenarioSpec) -> Iterator[StaticFinding]:
    """What must not appear, and is there; what must not be done, and is asked for."""
    for part in spec.prohibitions:
        if isinstance(part, ForbiddenBehavior):
            yield from _done(spec, part)
        if not isinstance(part, ForbiddenAgent):
            continue
        there = [u.id for u in spec.uavs] if part.type == 'uav' else []
        there += [a.id for a in spec.agents if a.type.value == part.type]
        if there:
            yield StaticFinding(
                field=f'prohibitions/{part.id}',
                relation=f'none of the type {part.type} may appear, and {", ".join(there)} does',
                mend='leave out one of the two',
                span=part.span,
            )


def _done(spec: ScenarioSpec, part: ForbiddenBehavior) -> Iterator[StaticFinding]:
    """What somebody is to do, and must not do."""
    kind = part.kind
    does = [
        f'behaves so ({agent.id})'
        for agent in spec.agents
        for behavior in agent.behaviors
        if agent.id == part.agent and behavior.kind is kind and behavior.target == part.target
    ]
    does += [
        f'does so in {event.id}'
        for event in spec.events
        if isinstance(event.action, AgentAction)
        and (event.action.agent, event.action.do) == (part.agent, kind.value)
    ]
    if does:
        yield StaticFinding(
            field=f'prohibitions/{part.id}',
            relation=f'{part.agent} must not {kind.value.replace("_", " ")}, and {does[0]}',
            mend='leave out one of the two',
            span=part.span,
        )
