# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which annotated fields of an event, an order or a condition hold, under a binding."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.fidelity.carriers import BEHAVIOR_OF_ACTION
from aurora_bench.fidelity.fields import Fields, Subject, best, size_counts
from aurora_bench.fidelity.numbers import NumberRule
from aurora_bench.prompts.format import (
    MISSION_FIELDS,
    Action,
    ConditionRequirement,
    EventRequirement,
    OrderRequirement,
    Trigger,
    stated_fields,
)
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    Event,
    EventAction,
    EventDoneTrigger,
    SendMessage,
    StatedCondition,
    UavAction,
)
from aurora_core.spec.scenario import Trigger as SpecTrigger

_APART = {'separation', 'distance'}


def event_names(r: EventRequirement) -> list[str]:
    """Return the annotated fields of an event."""
    names = []
    if r.trigger is not None:
        names += [f'trigger.{name}' for name in stated_fields(r.trigger)]
    if r.action is not None:
        names += [f'action.{name}' for name in stated_fields(r.action)]
    if r.within_s is not None:
        names.append('within_s')
    return names


def event_fields(r: EventRequirement, event: Event, subject: Subject, rule: NumberRule) -> Fields:
    """Compare an event; fields of another kind of trigger or action never count."""
    fields = dict.fromkeys(event_names(r), False)
    if r.trigger is not None and event.trigger is not None and event.trigger.on == r.trigger.on:
        fields |= trigger_fields(r.trigger, event.trigger, subject, rule, event.delay_s)
    if r.action is not None and event.action is not None and event.action.do == r.action.do:
        fields |= action_fields(r.action, event.action, subject, rule)
    if r.within_s is not None and event.deadline_s is not None:
        fields['within_s'] = rule.counts('within_s', r.within_s, event.delay_s)
    return fields


def implied_event_fields(
    r: EventRequirement, subject: Subject, rule: NumberRule
) -> Iterator[Fields]:
    """Return how far missions and behaviours imply an event of which one half is unstated."""
    names = event_names(r)
    if r.action is None and r.trigger is not None and r.trigger.on == 'altitude_reached':
        for mission in subject.spec.missions:
            yield {
                'trigger.on': True,
                'trigger.uav': r.trigger.uav is None
                or subject.binding.means(r.trigger.uav, mission.uav),
                'trigger.value_m': r.trigger.value_m is None
                or rule.counts('trigger.value_m', r.trigger.value_m, mission.altitude_m),
            }
    if r.trigger is None and r.action is not None:
        action = r.action
        kind = BEHAVIOR_OF_ACTION.get(action.do)
        for fact in subject.behaviors:
            if kind is fact.kind and action.agent is not None:
                held = {'action.do': True}
                held['action.agent'] = subject.binding.means(action.agent, fact.agent)
                if action.value_mps is not None:
                    held['action.value_mps'] = rule.counts(
                        'action.value_mps', action.value_mps, fact.speed_mps
                    )
                yield dict.fromkeys(names, False) | held
        if action.do == 'land' and action.uav is not None:
            for mission in subject.spec.missions:
                if not mission.ends_in_flight:
                    yield dict.fromkeys(names, False) | {
                        'action.do': True,
                        'action.uav': subject.binding.means(action.uav, mission.uav),
                    }


def trigger_fields(
    wanted: Trigger,
    found: SpecTrigger,
    subject: Subject,
    rule: NumberRule,
    delay_s: Parameter | None = None,
) -> Fields:
    """Compare a trigger with one of the same kind; `delay_s` is of the event that has it."""
    fields = {'trigger.on': True}
    stated = stated_fields(wanted)
    for name, value in stated.items():
        key = f'trigger.{name}'
        other = getattr(found, 'sender' if name == 'from' else name, None)
        if name == 'event':
            assert isinstance(found, EventDoneTrigger)
            fields[key] = subject.binding.moments.get(value) == found.event
        elif isinstance(value, float):
            # "5 s after e1" may be the trigger's delay or the event's.
            if name == 'after_s' and other is None:
                other = delay_s
            fields[key] = rule.counts(key, value, other)
        elif name == 'behavior':
            fields[key] = value == other
        elif name != 'on':
            fields[key] = isinstance(value, str) and subject.binding.means(value, other)
    if wanted.a is not None and wanted.b is not None:  # a distance has no direction
        a, b = getattr(found, 'a', None), getattr(found, 'b', None)
        if subject.binding.means(wanted.a, b) and subject.binding.means(wanted.b, a):
            fields['trigger.a'] = fields['trigger.b'] = True
    return fields


def action_fields(
    wanted: Action, found: EventAction, subject: Subject, rule: NumberRule
) -> Fields:
    """Compare an action with one of the same kind; a change of mission by its new mission."""
    fields = {'action.do': True}
    stated = stated_fields(wanted)
    carrier: object = found
    if isinstance(found, UavAction) and wanted.do == 'change_mission':
        carrier = next((m for m in subject.spec.missions if m.id == found.mission), None)
    for name, value in stated.items():
        key = f'action.{name}'
        place = carrier if wanted.do == 'change_mission' and name in MISSION_FIELDS else found
        other = getattr(place, name, None)
        if name == 'size_m':
            fields[key] = size_counts(value, other, rule, key)
        elif isinstance(value, float):
            fields[key] = rule.counts(key, value, other)
        elif name in ('mode', 'pattern', 'side', 'text'):
            fields[key] = other == value
        elif name != 'do':
            fields[key] = isinstance(value, str) and subject.binding.means(value, other)
    return fields


def order_fields(r: OrderRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare an order with what the specification fixes."""
    first = subject.binding.moments.get(r.first)
    then = subject.binding.moments.get(r.then)
    fields = {'then': first is not None and then is not None and (first, then) in subject.before}
    if r.within_s is not None:
        own = [e for e in subject.spec.events if e.id == then]
        orders = [o for o in subject.spec.orders if (o.first, o.then) == (first, then)]
        given = [
            number for e in own for number in (e.delay_s, getattr(e.trigger, 'after_s', None))
        ]
        given += [order.within_s for order in orders]
        fields['within_s'] = fields['then'] and any(
            rule.counts('within_s', r.within_s, number) for number in given
        )
    return fields


def condition_fields(r: ConditionRequirement, subject: Subject, rule: NumberRule) -> Fields:
    """Compare a condition with the stated ones, and with what every run implies."""
    optional = [n for n in ('hold_s', 'by_s', 'fraction') if getattr(r, n) is not None]
    names = ['quantity', 'of', 'op', 'value', *optional]

    def compare(found: StatedCondition) -> Fields:
        fields = dict.fromkeys(names, False)
        wanted, given = _bodies(r, subject), {of.casefold() for of in found.of}
        # Of two bodies, separation and distance are one; what keeps all apart keeps some apart.
        is_pair = len(wanted) == 2 and {r.quantity, found.quantity} == _APART
        if found.quantity != r.quantity and not is_pair:
            return fields
        is_part = r.quantity == 'separation' and len(wanted) > 1 and wanted <= given
        fields |= {
            'quantity': True,
            'of': wanted == given or is_part,
            'op': _same_op(r.quantity, r.op, found.op),
            'value': rule.counts('value', float(r.value), found.value),
        }
        for name in optional:
            fields[name] = rule.counts(name, getattr(r, name), getattr(found, name))
        return fields

    if not optional and _is_implied(r, subject, rule):
        return dict.fromkeys(names, True)
    found = [compare(stated) for stated in subject.spec.conditions]
    return best([*found, *_bounds(r, names, subject, rule)], names)


def _same_op(quantity: str, wanted: str, found: str) -> bool:
    """Whether two comparisons ask for the same; no run tells `<` from `<=`."""
    if quantity == 'waypoints_visited' and {wanted, found} <= {'>=', '=='}:
        return True
    return wanted[0] == found[0]


def _bounds(
    r: ConditionRequirement, names: list[str], subject: Subject, rule: NumberRule
) -> Iterator[Fields]:
    """Return how far one-sided numbers of missions and behaviours ("at least 40 m") say it."""
    bodies = _bodies(r, subject)
    missions = [(m, {m.uav}) for m in subject.spec.missions]
    numbers: dict[str, list[tuple[Parameter | None, set[str]]]] = {
        'altitude': [(m.altitude_m, of) for m, of in missions],
        'speed': [
            *((m.speed_mps, of) for m, of in missions),
            *((b.speed_mps, {b.agent}) for b in subject.behaviors),
        ],
        'horizontal_distance': [
            (m.standoff_m, {m.uav, m.target.casefold()}) for m, _ in missions if m.target
        ],
    }
    for number, of in numbers.get(r.quantity, []):
        if number is not None and number.bound is not Bound.EXACTLY and of == bodies:
            op = '>=' if number.bound is Bound.AT_LEAST else '<='
            yield dict.fromkeys(names, False) | {
                'quantity': True,
                'of': True,
                'op': _same_op(r.quantity, r.op, op),
                'value': rule.counts('value', float(r.value), number),
            }


def _bodies(r: ConditionRequirement, subject: Subject) -> set[str]:
    if r.quantity == 'event_time':
        return {subject.binding.moments.get(name, '') for name in r.of}
    return {item.casefold() for name in r.of for item in subject.binding.of(name)}


def _is_implied(r: ConditionRequirement, subject: Subject, rule: NumberRule) -> bool:
    """Whether missions and messages imply it: completed, landed, delivered, all waypoints."""
    bodies = _bodies(r, subject)
    missions = [m for m in subject.spec.missions if m.uav in bodies]
    if r.quantity in ('landed', 'mission_completed') and r.value is True:
        return bool(missions) and not missions[-1].ends_in_flight
    if r.quantity == 'waypoints_visited' and r.op in ('>=', '=='):
        return any(rule.counts('value', float(r.value), m.waypoint_count) for m in missions)
    if r.quantity == 'delivered' and r.value is True:
        return any(
            isinstance(e.action, SendMessage) and {e.action.sender, e.action.receiver} == bodies
            for e in subject.spec.events
        )
    return False
