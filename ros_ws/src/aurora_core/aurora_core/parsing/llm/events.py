# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events and stated conditions of a reading as those of the specification."""

from __future__ import annotations

from typing import Any

from pydantic import TypeAdapter

from aurora_core.parsing.llm import operands
from aurora_core.parsing.llm.parts import Parts
from aurora_core.parsing.llm.places import is_place
from aurora_core.parsing.llm.reading import (
    ActionReading,
    ConditionReading,
    EventReading,
    OrderReading,
    TriggerReading,
)
from aurora_core.parsing.scene import EventDraft, LinkDraft
from aurora_core.parsing.values import default
from aurora_core.spec.events import BRAKING
from aurora_core.spec.parameter import Bound, Parameter, Provenance, Span, Unit
from aurora_core.spec.requirements import STATED_QUANTITIES
from aurora_core.spec.scenario import (
    EventAction,
    Order,
    SendMessage,
    StatedCondition,
    Trigger,
)

# What `subject`, `other` and `value` are called, and the line in `defaults.yaml` of the value.
_TRIGGERS: dict[str, tuple[str, str, str, str]] = {
    'distance_below': ('a', 'b', 'value_m', 'trigger_distance'),
    'distance_above': ('a', 'b', 'value_m', 'trigger_distance'),
    'headway_below': ('a', 'b', 'value_s', 'headway'),
    'ttc_below': ('a', 'b', 'value_s', 'headway'),
    'time': ('', '', 'at_s', 'trigger_time'),
    'altitude_reached': ('uav', '', 'value_m', 'altitude'),
    'visible': ('observer', 'target', '', 'delay'),
    'occluded': ('observer', 'target', '', 'delay'),
    'arrives': ('who', 'place', '', 'delay'),
    'message_received': ('by', 'sender', '', 'delay'),
    'speed_below': ('who', '', 'value_mps', 'trigger_speed'),
    'speed_above': ('who', '', 'value_mps', 'trigger_speed'),
    'event_done': ('', 'event', 'after_s', 'trigger_time'),
    'event_begun': ('', 'event', 'after_s', 'trigger_time'),
    'behavior_done': ('who', '', '', 'delay'),
    'mission_done': ('uav', '', '', 'delay'),
    'battery_below': ('uav', '', 'value', 'condition_ratio'),
}
# How near, far, slow or fast may be left open.
_OPEN = ('distance_below', 'distance_above', 'speed_below', 'speed_above')
_UAV_ACTIONS = ('land', 'return_home', 'ascend', 'change_mission')
_CONDITION_VALUES = {
    Unit.METRE: 'condition_distance',
    Unit.SECOND: 'condition_time',
    Unit.METRE_PER_SECOND: 'condition_speed',
    Unit.METRE_PER_SECOND_SQUARED: 'condition_deceleration',
    Unit.ONE: 'condition_ratio',
}

_TRIGGER: TypeAdapter[Trigger] = TypeAdapter(Trigger)
_ACTION: TypeAdapter[EventAction] = TypeAdapter(EventAction)


def add_event(said: EventReading, parts: Parts) -> None:
    """Add an event, and the link that its message needs.

    Raises:
        ValueError: A field is missing, or one is there that this cause or effect does not have.
    """
    span = parts.span(said.quote, said.id)
    if said.trigger is None and said.action is None:
        parts.complaints.append(f'{said.id}: an event has a trigger, an action or both')
    action = None if said.action is None else _action(said.id, said.action, parts)
    parts.scene.events.append(
        EventDraft(
            id=parts.ref(said.id),
            trigger=None if said.trigger is None else _trigger(said.id, said.trigger, parts),
            action=action,
            delay=parts.number('delay', said.delay_s, f'{said.id}.delay_s'),
            span=span,
        )
    )
    if isinstance(action, SendMessage):
        if action.sender == action.receiver:
            parts.complaints.append(f'{said.id}.action: sender and receiver are the same')
        _link_for(action, span, parts)


def _trigger(name: str, given: TriggerReading, parts: Parts) -> Trigger:
    subject, other, value, parameter = _TRIGGERS[given.on]
    fields: dict[str, Any] = {'on': given.on}
    where = f'{name}.trigger'
    if given.subject is not None and subject:
        parts.actor(given.subject, f'{where}.subject')
    _put(fields, subject, parts.ref_or_none(given.subject), f'{where}.subject')
    _put(fields, other, parts.ref_or_none(given.other), f'{where}.other')
    lasts = 'behavior' if given.on == 'behavior_done' else ''
    _put(fields, lasts, given.behavior, f'{where}.behavior')
    known = parts.number(parameter, given.value, f'{where}.value')
    if known is None and given.on in _OPEN:
        known = default(parameter)
    _put(fields, value, known, f'{where}.value')
    return _TRIGGER.validate_python(fields)


def _action(name: str, given: ActionReading, parts: Parts) -> EventAction:
    where = f'{name}.action'
    message, flies = given.do == 'send_message', given.do in _UAV_ACTIONS
    parts.actor(given.subject, f'{where}.subject', flies=None if message else flies)
    if given.receiver is not None:
        parts.actor(given.receiver, f'{where}.receiver')
    mission = parts.ref_or_none(given.mission)
    if mission is not None and all(m.id != mission for m in parts.scene.missions):
        parts.complaints.append(f'{where}.mission: {given.mission!r} is no mission of the answer')
    fields: dict[str, Any] = {'do': given.do}
    fields['sender' if message else 'uav' if flies else 'agent'] = parts.ref(given.subject)
    receiver = parts.ref_or_none(given.receiver)
    _put(fields, 'receiver' if message else '', receiver, f'{where}.receiver')
    if given.text and not parts.facts.spans(given.text):
        parts.complaints.append(f'{where}.text: {given.text!r} is not in the prompt')
    _put(fields, 'text' if message else '', given.text or None, f'{where}.text')
    _put(fields, 'mission' if flies else '', mission, f'{where}.mission')
    _put(fields, 'side' if given.do == 'change_lane' else '', given.side, f'{where}.side')
    hard = parts.number('deceleration', given.deceleration_mps2, f'{where}.deceleration_mps2')
    _put(
        fields,
        'deceleration_mps2' if given.do in BRAKING else '',
        hard,
        f'{where}.deceleration_mps2',
    )
    rate = parts.number('vertical_speed', given.vertical_mps, f'{where}.vertical_mps')
    climbs = given.do == 'ascend'
    _put(fields, 'vertical_mps' if climbs else '', rate, f'{where}.vertical_mps')
    parameter = 'altitude' if flies else 'ground_speed'
    value = parts.number(parameter, given.value, f'{where}.value')
    _put(fields, '' if message else 'altitude_m' if flies else 'value_mps', value, where)
    return _ACTION.validate_python(fields)


def _put(fields: dict[str, Any], name: str, value: object, where: str) -> None:
    if value is None:
        return
    if not name:
        raise ValueError(f'{where}: expected null for {fields.get("on") or fields.get("do")}')
    fields[name] = value


def _link_for(message: SendMessage, span: Span, parts: Parts) -> None:
    """A message needs a link; one that the prompt does not describe has the defaults."""
    scene = parts.scene
    ends = (message.sender, message.receiver)
    if all((link.sender, link.receiver) != ends for link in scene.links):
        scene.links.append(
            LinkDraft(id=scene.new_id('link'), sender=ends[0], receiver=ends[1], span=span)
        )


def add_order(said: OrderReading, parts: Parts) -> None:
    """Add what comes before what."""
    known = {e.id for e in parts.scene.events} | {m.id for m in parts.scene.missions}
    ends = parts.ref(said.first), parts.ref(said.then)
    for given, end in zip((said.first, said.then), ends, strict=True):
        if end not in known:
            parts.complaints.append(f'{said.id}: {given!r} is no event or mission of the answer')
    if ends[0] == ends[1]:
        parts.complaints.append(f'{said.id}: {said.first!r} cannot come before itself')
        return
    parts.scene.orders.append(
        Order(
            id=parts.ref(said.id),
            first=ends[0],
            then=ends[1],
            within_s=parts.number('delay', said.within_s, f'{said.id}.within_s'),
            span=parts.span(said.quote, said.id),
        )
    )


def add_condition(said: ConditionReading, parts: Parts) -> None:
    """Add a condition that the prompt states."""
    where = said.id
    for one in said.of:
        if one not in parts.ids and not is_place(one):
            parts.complaints.append(f'{where}.of: {one!r} is not in the answer')
    if len(set(said.of)) < len(said.of):
        parts.complaints.append(f'{where}.of: the same one twice')
    wrong = operands.objection(said.quantity, [_kind(one, parts) for one in said.of])
    if wrong is not None:
        parts.complaints.append(f'{where}: {wrong}, found [{", ".join(said.of)}]')
    value = _value(said, parts)
    if value is None:
        return
    opposite = {Bound.AT_LEAST: ('<', '<='), Bound.AT_MOST: ('>', '>=')}.get(value.bound, ())
    if said.op in opposite:
        parts.complaints.append(f'{where}.op: the prompt says {value.bound.value}, not {said.op}')
    parts.scene.conditions.append(
        StatedCondition(
            id=parts.ref(said.id),
            quantity=said.quantity,
            of=tuple(parts.ref(one) for one in said.of),
            op=said.op or '>=',
            value=value,
            hold_s=parts.number('condition_time', said.hold_s, f'{where}.hold_s'),
            by_s=parts.number('condition_time', said.by_s, f'{where}.by_s'),
            fraction=parts.number('condition_ratio', said.fraction, f'{where}.fraction'),
            span=parts.span(said.quote, where),
        )
    )


def _value(said: ConditionReading, parts: Parts) -> Parameter | None:
    """Return what a quantity is compared with; what is done or not is to be done."""
    done = operands.is_done(said.quantity)
    if said.value is None or (done and said.value.provenance == 'inferred'):
        if not done or (said.value is not None and said.value.value not in (0.0, 1.0)):
            parts.complaints.append(f'{said.id}: {said.quantity} needs op and a value of its own')
            return None
        denied = said.value is not None and said.value.value == 0.0
        if denied and said.op not in ('==', '<='):
            parts.complaints.append(f'{said.id}.op: a value of 0 goes with ==')
        return _yes_or_no(yes=not denied)
    if said.op is None:
        parts.complaints.append(f'{said.id}: a value needs an op')
    name = _CONDITION_VALUES.get(said.value.unit)
    unit = STATED_QUANTITIES[said.quantity]
    if name is None or said.value.unit is not unit:
        parts.complaints.append(
            f'{said.id}.value: {said.quantity} is in {unit.value!r}, found '
            f'{said.value.unit.value!r}'
        )
        return None
    if said.quantity == 'waypoints_visited':
        name = 'waypoint_count'
    return parts.numbers.parameter(name, said.value, f'{said.id}.value')


def _yes_or_no(*, yes: bool) -> Parameter:
    return Parameter(
        value=1.0 if yes else 0.0,
        unit=Unit.ONE,
        low=0.0,
        high=1.0,
        provenance=Provenance.INFERRED,
    )


def _kind(given: str, parts: Parts) -> str | None:
    """Return what an operand is, None where it is nothing that a quantity is of."""
    if is_place(given):
        return operands.PLACE
    entity = parts.scene.by_id(parts.ref(given))
    if entity is not None:
        return operands.UAV if entity.is_uav else operands.BODY
    events = {event.id for event in parts.scene.events}
    return operands.EVENT if parts.ref(given) in events else None
